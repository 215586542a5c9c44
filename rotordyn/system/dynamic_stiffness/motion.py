"""Motion of nodes under unit forces: of whirl by itself, or of both planes side by side.

A matrix A + iB on y + iz is [[A, −B], [B, A]] on (y, z).
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from rotordyn.numerics.dense_solve import solutions
from rotordyn.system.dynamic_stiffness.coordinates import Array, Coordinates, Dynamic, Values
from rotordyn.system.dynamic_stiffness.end import End
from rotordyn.system.dynamic_stiffness.supports import Supported
from rotordyn.system.whirl_in_planes import planes_of_whirl, whirl_of

Moved = dict[tuple[int, int], Values]  # (2, forces, f) by plane and node


@dataclass(frozen=True, eq=False, slots=True)
class Equation:
    """Rotors, sleeves and drawbar by n coordinates, and the ``supports`` between their ``rows``
    (c, 2, n), at ``omega`` (f,).

    ``matrix`` (n, n, f or 2f): of whirl at ω, and where the supports do not whirl, then at −ω;
    ``coordinates`` and ``dynamic`` of the rotors, the first of the n.
    """

    coordinates: Coordinates
    dynamic: Dynamic
    matrix: Values
    rows: Array
    supports: Supported
    omega: Array

    def load(self, force: End) -> Array:
        """A unit force on the coordinates (n,)."""
        load = np.zeros(len(self.matrix))
        own = self.coordinates.rows(force.node)[force.place]
        load[: self.coordinates.size] = force.sign * own
        return load

    def nodes(self, moved: Values, wanted: Collection[int]) -> dict[int, Values]:
        """Motion of nodes by that of the coordinates (n, forces, …)."""
        return self.dynamic.motion(moved[: self.coordinates.size], wanted)


def motion(equation: Equation, forces: Sequence[End], wanted: Collection[int]) -> Moved:
    """Of the nodes ``wanted`` under each of the ``forces``; of whirl the same in either plane."""
    return (_whirl if equation.supports.whirling else _in_planes)(equation, forces, wanted)


def _whirl(equation: Equation, forces: Sequence[End], wanted: Collection[int]) -> Moved:
    matrix = equation.supports.added(equation.matrix, equation.rows, equation.omega)
    right = np.stack([equation.load(force) for force in forces], axis=1)
    found = equation.nodes(solutions(matrix, right), wanted)
    return {(plane, node): moved for node, moved in found.items() for plane in (0, 1)}


def _in_planes(equation: Equation, forces: Sequence[End], wanted: Collection[int]) -> Moved:
    n = len(equation.matrix)
    matrix = equation.supports.added(
        _of_both(equation.matrix), _rows_of_both(equation.rows), equation.omega
    )
    right = np.zeros((2, n, len(forces)))
    for k, force in enumerate(forces):
        right[force.plane, :, k] = equation.load(force)
    y, z = solutions(matrix, right.reshape(2 * n, -1)).reshape(2, n, len(forces), -1)
    found: Moved = {}
    for node, whirl in equation.nodes(whirl_of(y, z), wanted).items():
        found[0, node], found[1, node] = planes_of_whirl(whirl)
    return found


def _of_both(matrix: Values) -> Values:
    """Of both planes (2n, 2n, f) from that of whirl (n, n, 2f)."""
    n = len(matrix)
    # before its parts, whose pages are then used again
    whole = np.empty((2 * n, 2 * n, matrix.shape[-1] // 2), dtype=complex)
    same, across = planes_of_whirl(matrix)
    whole[:n, :n] = whole[n:, n:] = same
    whole[n:, :n] = across
    np.negative(across, out=whole[:n, n:])
    return whole


def _rows_of_both(rows: Array) -> Array:
    """(c, 4, 2n) from those of a plane (c, 2, n)."""
    n = rows.shape[-1]
    both = np.zeros((len(rows), 4, 2 * n))
    both[:, :2, :n], both[:, 2:, n:] = rows, rows
    return both
