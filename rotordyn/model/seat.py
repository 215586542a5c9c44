"""Bearings at their seats: tangents and dampers between the shaft and what the outer ring is in."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rotordyn.elements.support import turn
from rotordyn.machine.support import BearingSeat
from rotordyn.model.term import LinkMatrices, State

NOISE = 1e-12  # of what two directions resist by themselves: less coupling is rounding


def seat_matrices(seat: BearingSeat, place: int) -> Callable[[State], LinkMatrices]:
    """Of the bearing number ``place``: its tangent in the spindle's frame (s, 6, 6), its dampers."""
    damping = np.diag([seat.axial_damping, *[seat.radial_damping] * 2, 0.0, 0.0, 0.0])

    def matrices(state: State) -> LinkMatrices:
        stiffness = turn(state.tangents[:, place], seat.thrust)
        size = np.sqrt(np.abs(np.diagonal(stiffness, axis1=1, axis2=2)))
        noise = np.abs(stiffness) < NOISE * size[:, :, None] * size[:, None, :]
        return LinkMatrices(np.where(noise, 0.0, stiffness), damping[None])

    return matrices
