"""What a shaft that shortens with speed would do to the axial loads of a machine in which it does
not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rotordyn.arrays import Array
from rotordyn.machine.growth import ComputedShortening
from rotordyn.preload.shortening import seat_shifts, support_shift
from rotordyn.preload.state import PreloadState


def shortening_load(state: PreloadState, row: int) -> Array:
    """Axial load of every bearing in its own frame (seats,) [N] that computed shortening adds, of
    first order.

    Springs, bearings by their tangents, and supports answer the shift of the shaft at their
    stations; sleeves that are locked, at a stop or held by friction stay.
    """
    spindle, speed = state.spindle, state.speed[[row]]
    seats, sleeves = spindle.seats, spindle.sleeves
    computed = replace(spindle, shortening=ComputedShortening(seats[0].x))
    shift = seat_shifts(computed, speed)[0]
    stiffness = state.seat_stiffness()[row, :, 0, 0]
    held = sum(support.along for support in spindle.supports)
    springs = np.array([held, *(sleeve.spring.stiffness for sleeve in sleeves)])
    free = np.isfinite(springs) & ~np.concatenate([[False], (state.stopped | state.stuck)[row]])
    carried = np.zeros((len(seats), len(springs)))
    for body, sleeve in enumerate(sleeves, start=1):
        carried[:, body] = [seat.name in sleeve.bearings for seat in seats]
    motion = (np.eye(len(springs))[0] - carried)[:, free]  # of the shaft, then of sleeves
    whole = motion.T @ (stiffness[:, None] * motion) + np.diag(springs[free])
    of_supports = np.zeros(len(springs))
    of_supports[0] = held * support_shift(computed, speed, None)[0]
    pull = -motion.T @ (stiffness * shift) - of_supports[free]
    moved = np.linalg.lstsq(whole, pull, rcond=None)[0]
    return np.array([seat.thrust for seat in seats]) * stiffness * (motion @ moved + shift)
