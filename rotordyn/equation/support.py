"""Linear supports: 6×6 matrices, some of them tables over speed.

Theory: docs/theory/supports.md#linear-supports.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from rotordyn.arrays import Array
from rotordyn.equation.dofs import position
from rotordyn.equation.term import LinkLaw, LinkMatrices, State
from rotordyn.machine.matrix import Value
from rotordyn.machine.support import LinearSupport

ALIKE = 1e-9  # of an entry: a smaller difference between the planes is rounding
_QUARTER_TURN = np.zeros((6, 6))
for _row, _column, _sign in ((0, 0, 1), (1, 2, -1), (2, 1, 1), (3, 3, 1), (4, 5, -1), (5, 4, 1)):
    _QUARTER_TURN[_row, _column] = _sign


def support_law(support: LinearSupport) -> LinkLaw:
    """Return stiffness and damping over the six directions (s or 1, 6, 6) between its ends.

    Raises
    ------
    InvalidInput : its table does not reach one of the speeds
    """

    def matrices(state: State) -> LinkMatrices:
        speed = state.speed if support.speeds else state.speed[:1]
        return LinkMatrices(
            support_matrices(support, "stiffness", speed),
            support_matrices(support, "damping", speed),
        )

    acts = {name for pair in (*support.stiffness, *support.damping) for name in pair}
    rigid = tuple(position(direction) for direction in support.rigid)
    return LinkLaw(matrices, acts | {*support.rigid}, support.ends, support.loss_factor, rigid)


def node_matrix(entries: Mapping[tuple[str, str], Value]) -> Array:
    """Return the matrix (6, 6) of a linear support's entries by pair of directions, as given.

    Raises
    ------
    ValueError : a name is none of x, y, z, thx, thy, thz, or an entry is a table over speed
    """
    matrix = np.zeros((6, 6))
    for (row, column), value in entries.items():
        matrix[position(row), position(column)] = value
    return matrix


def support_matrices(support: LinearSupport, which: str, speed: Array) -> Array:
    """Return ``"stiffness"`` or ``"damping"`` (speeds, 6, 6) of a support at ``speed`` [rad/s].

    Raises
    ------
    InvalidInput : its table does not reach one of the speeds
    """
    if not support.speeds:
        matrix = node_matrix(getattr(support, which))
        return np.broadcast_to(matrix, (len(speed), 6, 6))
    matrices = [node_matrix(getattr(support.at(float(omega)), which)) for omega in speed]
    return np.array(matrices).reshape(-1, 6, 6)


def is_isotropic(matrix: Array) -> bool:
    """True if a node's (…, 6, 6) matrix is the same in all directions about the axis.

    It must not change under a quarter turn about x: y → z, z → −y, and tilts likewise.
    """
    rotated = _QUARTER_TURN @ matrix @ _QUARTER_TURN.T
    size = np.maximum(np.abs(matrix), np.abs(rotated))
    return bool((np.abs(matrix - rotated) <= ALIKE * size).all())
