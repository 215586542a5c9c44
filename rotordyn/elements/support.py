"""What holds a node: linear supports and bearings as 6×6 matrices in the spindle's frame."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rotordyn.elements.node import position
from rotordyn.machine.support import LinearSupport, Value

Array = NDArray[np.float64]

ALIKE = 1e-9  # of an entry: below that its difference between the planes is rounding
BEARING_FREEDOMS = ("x", "y", "z", "thy", "thz")
_HALF_TURN_ABOUT_Y = np.array([-1.0, 1.0, -1.0, 1.0, -1.0])
_QUARTER_TURN = np.zeros((6, 6))
for _row, _column, _sign in ((0, 0, 1), (1, 2, -1), (2, 1, 1), (3, 3, 1), (4, 5, -1), (5, 4, 1)):
    _QUARTER_TURN[_row, _column] = _sign
_PLACES = np.array([position(freedom) for freedom in BEARING_FREEDOMS])


def node_matrix(entries: Mapping[tuple[str, str], Value]) -> Array:
    """Matrix (6, 6) of a linear support's entries by pair of freedoms; nothing is symmetrised.

    Raises
    ------
    ValueError : a name is none of x, y, z, thx, thy, thz, or an entry is a table over speed
    """
    matrix = np.zeros((6, 6))
    for (row, column), value in entries.items():
        matrix[position(row), position(column)] = value
    return matrix


def support_matrices(support: LinearSupport, which: str, speed: Array) -> Array:
    """``"stiffness"`` or ``"damping"`` of a support at every ``speed`` [rad/s], (speeds, 6, 6).

    Raises
    ------
    InvalidInput : its table does not reach one of the speeds
    """
    if not support.speeds:
        one = node_matrix(getattr(support, which))
        return np.broadcast_to(one, (len(speed), 6, 6))
    held = [node_matrix(getattr(support.at(float(each)), which)) for each in speed]
    return np.array(held).reshape(-1, 6, 6)


def along_and_about(support: LinearSupport, which: str) -> Array:
    """Rows and columns x and thx of a support's matrix (6, 6), all else zero: no table has them."""
    entries: Mapping[tuple[str, str], Value] = getattr(support, which)
    return node_matrix({pair: k for pair, k in entries.items() if {"x", "thx"} & set(pair)})


def answers_alike(matrix: Array) -> bool:
    """True where a node's (…, 6, 6) matrix is the same in all directions about the axis.

    It must not change under a quarter turn about x: y → z, z → −y, and tilts likewise.
    """
    turned = _QUARTER_TURN @ matrix @ _QUARTER_TURN.T
    size = np.maximum(np.abs(matrix), np.abs(turned))
    return bool((np.abs(matrix - turned) <= ALIKE * size).all())


def turn(matrix: ArrayLike, thrust: int) -> Array:
    """A bearing's matrix (…, 5, 5) in its own frame, as (…, 6, 6) in the spindle's.

    ``thrust`` −1 means that the bearing's own x is −x of the spindle: a half turn about y,
    R = diag(−1, 1, −1, 1, −1) and K → R K R, so that K[y, thz] and K[z, thy] change sign.
    The bearing does not resist spin: row and column thx are zero.
    """
    own = np.asarray(matrix, dtype=np.float64)
    signs = _HALF_TURN_ABOUT_Y if thrust < 0 else np.ones(5)
    turned = np.zeros((*own.shape[:-2], 6, 6))
    turned[..., _PLACES[:, None], _PLACES] = signs[:, None] * own * signs
    return turned
