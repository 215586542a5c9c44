"""Effect of the axial force N in a shaft on its bending: ∫ N v′ w′ dx in each plane.

Theory: docs/theory/axial_force.md.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Indices
from rotordyn.equation.elements.polynomials import points
from rotordyn.equation.mesh import Mesh
from rotordyn.equation.shaft import Rows, Shaft

GAUSS = 7  # degree up to which the work of the axial force is integrated exactly
NOTHING = 1e-15  # of the largest: a smaller field of force is rounding of the others


class Slopes(NamedTuple):
    """Weighted slopes in a plane: ``rows`` (places, …) and the shown ``element`` of each place."""

    rows: Array
    element: Indices


def slope_rows(shaft: Shaft, shown: Mesh, way: str) -> tuple[list[Rows], Indices]:
    """Return slopes in a plane at Gauss points of every element of the mesh ``shown``, times the
    root of the length that each represents, and the element of each; slopes jump at nodes of the
    shaft, so that none of its elements shares a Gauss rule with the next."""
    xi, weight = points(GAUSS)
    ends = np.unique(np.concatenate([shown.x, shaft.mesh.x]))
    middle, length = (ends[1:] + ends[:-1]) / 2.0, np.diff(ends)
    x = middle[:, None] + length[:, None] / 2.0 * xi
    root = np.sqrt(weight * (length[:, None] / 2.0))
    element = np.clip(np.searchsorted(shown.x, middle) - 1, 0, len(shown.length) - 1)
    rows = weighted(shaft.sloped(way, x.ravel()), root.ravel())
    return rows, np.repeat(element, len(xi))


def weighted(rows: list[Rows], weight: Array) -> list[Rows]:
    """Return rows of one to a place times the ``weight`` (places,)."""
    return [(at, dofs, shapes * weight[at][:, :, None]) for at, dofs, shapes in rows]


def geometric_stiffness(slopes: Slopes, force: Array) -> Array:
    """Return the stiffness (s, m, m) of coordinates with ``slopes`` (places, m) by the axial
    ``force`` (s, elements) [N], tension positive, from its few fields; NaN where it is unknown."""
    finite = np.isfinite(force).all(axis=1)
    states, size, fields = np.linalg.svd(force[finite], full_matrices=False)
    clear = size > NOTHING * size[0] if size.size else size > 0.0
    rows, at_places = slopes.rows, fields[clear][:, slopes.element]
    unit = np.array([rows.T @ (field[:, None] * rows) for field in at_places])
    unit = unit.reshape(len(at_places), rows.shape[1], rows.shape[1])
    total = np.full((len(force), *unit.shape[1:]), np.nan)
    total[finite] = np.tensordot(states[:, clear] * size[clear], unit, 1)
    return total
