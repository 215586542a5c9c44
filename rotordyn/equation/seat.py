"""Bearings at their seats: tangents and dampers between the shaft and what the outer ring is in.

Theory: docs/theory/supports.md#bearings-at-their-seats.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rotordyn.arrays import Array
from rotordyn.equation.dofs import position
from rotordyn.equation.term import AtState, LinkMatrices, State
from rotordyn.machine.seat import BearingSeat

BEARING_DIRECTIONS = ("x", "y", "z", "thy", "thz")
HALF_TURN_ABOUT_Y = np.array([-1.0, 1.0, -1.0, 1.0, -1.0])
_PLACES = np.array([position(name) for name in BEARING_DIRECTIONS])
NOISE = 1e-12  # of what two directions resist by themselves: less coupling is rounding


def seat_matrices(seat: BearingSeat, place: int) -> AtState:
    """Of bearing number ``place``: its tangent in the spindle's frame (s, 6, 6), its dampers."""
    damping = np.diag([seat.axial_damping, *[seat.radial_damping] * 2, 0.0, 0.0, 0.0])

    def matrices(state: State) -> LinkMatrices:
        stiffness = turn(state.tangents[:, place], seat.thrust)
        size = np.sqrt(np.abs(np.diagonal(stiffness, axis1=1, axis2=2)))
        noise = np.abs(stiffness) < NOISE * size[:, :, None] * size[:, None, :]
        return LinkMatrices(np.where(noise, 0.0, stiffness), damping[None])

    return matrices


def turn(matrix: ArrayLike, thrust: int) -> Array:
    """A bearing's matrix (…, 5, 5) in its own frame, as (…, 6, 6) in the spindle's.

    ``thrust`` −1 means that the bearing's own x is −x of the spindle: a half turn about y,
    R = diag(−1, 1, −1, 1, −1) and K → R K R, so that K[y, thz] and K[z, thy] change sign.
    The bearing does not resist spin: row and column thx are zero.
    """
    values = np.asarray(matrix, dtype=np.float64)
    signs = HALF_TURN_ABOUT_Y if thrust < 0 else np.ones(5)
    turned = np.zeros((*values.shape[:-2], 6, 6))
    turned[..., _PLACES[:, None], _PLACES] = signs[:, None] * values * signs
    return turned
