"""Geometric stiffness: what the axial force in the shaft does between two sets of vectors.

N ∫ v′ w′ dx of every element of the mesh, N the force in it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.bubbles import points
from rotordyn.system.mesh import Mesh

Array = NDArray[np.float64]
GAUSS = 7  # degree up to which the work of the axial force is integrated exactly
NOTHING = 1e-15  # of the largest: fields of force that are rounding of the others


@dataclass(frozen=True, eq=False, slots=True)
class GeometricStiffness:
    """Stiffness (a, b) between a vectors and b others, linear in the axial force of every element.

    Slopes ``left`` (places, a) and ``right`` (places, b) times the root of the length that each of
    the places stands for, as many places in every element. ``before``, ``rows``, ``columns``: as
    many further vectors on which it does not act.
    """

    left: Array
    right: Array
    before: int = 0
    rows: int = 0
    columns: int = 0

    def under(self, force: Array) -> Array:
        """(states, a, b) of ``force`` (states, elements) [N]."""
        states, fields = _fields(force)
        found = [self._of(field) for field in fields]
        shape = self.left.shape[1], self.right.shape[1]
        own = np.tensordot(states, np.array(found).reshape(len(found), *shape), 1)
        return np.pad(own, ((0, 0), (self.before, self.rows), (0, self.columns)))

    def _of(self, force: Array) -> Array:
        each = np.repeat(force, len(self.left) // len(force))[:, None]
        return np.asarray(self.left.T @ (each * self.right))

    def padded(self, before: int = 0, rows: int = 0, columns: int = 0) -> GeometricStiffness:
        """With further vectors, on which it does not act: ``before`` the a and ``rows`` behind
        them, ``columns`` behind the b."""
        return GeometricStiffness(
            self.left,
            self.right,
            self.before + before,
            self.rows + rows,
            self.columns + columns,
        )


def gauss_points(mesh: Mesh) -> tuple[Array, Array]:
    """Stations (elements, points) at which the work in every element is summed up, and their
    weights (points,), per half the length of an element."""
    xi, weight = points(GAUSS)
    return mesh.middle[:, None] + mesh.length[:, None] / 2.0 * xi, weight


def _fields(force: Array) -> tuple[Array, Array]:
    """Forces (states, elements) as sums (states, k) of few fields (k, elements)."""
    states, size, fields = np.linalg.svd(force, full_matrices=False)
    known = size > NOTHING * size[0] if size.size else size > 0.0
    return states[:, known] * size[known], fields[known]
