"""Bearings at their seats: tangents and dampers between the shaft and the outer ring's support.

Theory: docs/theory/supports.md#bearings-at-their-seats.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from rotordyn.arrays import Array, Indices
from rotordyn.equation.dofs import position
from rotordyn.equation.term import LinkLaw, LinkMatrices
from rotordyn.machine.seat import BearingSeat

BEARING_DIRECTIONS = ("x", "y", "z", "thy", "thz")
HALF_TURN_ABOUT_Y = np.array([-1.0, 1.0, -1.0, 1.0, -1.0])
_PLACES = np.array([position(name) for name in BEARING_DIRECTIONS])
NOISE = 1e-12  # of the direct stiffness of two directions: less coupling is rounding


def seat_law(seat: BearingSeat, place: int) -> LinkLaw:
    """Return tangent (s, 6, 6) in the spindle's frame of bearing number ``place``, and dampers."""
    damping = np.diag([seat.axial_damping, *[seat.radial_damping] * 2, 0.0, 0.0, 0.0])
    return LinkLaw(
        lambda state: LinkMatrices(state.tangents[:, place], damping[None]), BEARING_DIRECTIONS
    )


def in_spindle_frame(seats: Sequence[BearingSeat], tangents: Array) -> Array:
    """Return tangents (s, seats, 6, 6) in the spindle's frame from those of bearings in their own
    (s, seats, 5, 5); coupling below ``NOISE`` is zero."""
    stiffness = turn(tangents, np.array([seat.thrust for seat in seats], dtype=np.intp))
    size = np.sqrt(np.abs(np.diagonal(stiffness, axis1=-2, axis2=-1)))
    noise = np.abs(stiffness) < NOISE * size[..., :, None] * size[..., None, :]
    return np.where(noise, 0.0, stiffness)


def turn(matrix: ArrayLike, thrust: int | Indices) -> Array:
    """Return a bearing's matrix (…, 5, 5) in its own frame as (…, 6, 6) in the spindle's.

    ``thrust`` −1, of all or of each (…,), means that the bearing's own x is −x of the spindle: a
    half turn about y, R = diag(−1, 1, −1, 1, −1) and K → R K R, so that K[y, thz] and K[z, thy]
    change sign. The bearing does not resist spin: row and column thx are zero.
    """
    values = np.asarray(matrix, dtype=np.float64)
    signs = np.where(np.asarray(thrust)[..., None] < 0, HALF_TURN_ABOUT_Y, 1.0)
    rotated = np.zeros((*values.shape[:-2], 6, 6))
    rotated[..., _PLACES[:, None], _PLACES] = signs[..., :, None] * values * signs[..., None, :]
    return rotated
