"""What the axial force N in a shaft does to its bending: ∫ N v′ w′ dx in each plane."""

from __future__ import annotations

import numpy as np

from rotordyn.model.elements.polynomials import points
from rotordyn.model.mesh import Mesh
from rotordyn.model.shaft import Rows, Shaft
from rotordyn.model.term import Array

GAUSS = 7  # degree up to which the work of the axial force is integrated exactly
NOTHING = 1e-15  # of the largest: fields of force that are rounding of the others


def slope_rows(shaft: Shaft, shown: Mesh, way: str) -> tuple[list[Rows], int]:
    """Slopes of a plane at Gauss points in every element of the mesh ``shown``, times the root of
    the length that each stands for, and how many."""
    xi, weight = points(GAUSS)
    x = shown.middle[:, None] + shown.length[:, None] / 2.0 * xi
    root = np.sqrt(weight * (shown.length[:, None] / 2.0))
    return shaft.sloped(way, x.ravel(), root.ravel()), x.size


def geometric_stiffness(slopes: Array, force: Array) -> Array:
    """(s, m, m) of coordinates with ``slopes`` (places, m) under the axial ``force`` (s, elements)
    [N], tension positive, by the few fields that forces are made of; NaN where it is not known."""
    known = np.isfinite(force).all(axis=1)
    states, size, fields = np.linalg.svd(force[known], full_matrices=False)
    clear = size > NOTHING * size[0] if size.size else size > 0.0
    each = np.repeat(fields[clear], len(slopes) // force.shape[1], axis=1)
    own = np.array([slopes.T @ (one[:, None] * slopes) for one in each])
    own = own.reshape(len(each), slopes.shape[1], slopes.shape[1])
    found = np.full((len(force), *own.shape[1:]), np.nan)
    found[known] = np.tensordot(states[:, clear] * size[clear], own, 1)
    return found
