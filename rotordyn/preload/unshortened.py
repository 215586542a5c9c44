"""Axial loads that shortening of the shaft with speed would add where it is not modelled."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rotordyn.arrays import Array
from rotordyn.machine.growth import ComputedShortening
from rotordyn.preload.shortening import seat_shifts, support_shift
from rotordyn.preload.state import PreloadState


def shortening_load(state: PreloadState, row: int) -> Array:
    """Return the axial load of every bearing in its own frame (seats,) [N] that computed shortening
    adds, to first order.

    Springs, bearings by their tangents, and supports respond to the shift of the shaft at their
    stations; sleeves that are locked, at a stop or held by friction stay.
    """
    spindle, speed = state.spindle, state.speed[[row]]
    seats, sleeves = spindle.seats, spindle.sleeves
    computed = replace(spindle, shortening=ComputedShortening(seats[0].x))
    shift = seat_shifts(computed, speed)[0]
    stiffness = state.seat_stiffness()[row, :, 0, 0]
    support_stiffness = sum(support.along for support in spindle.supports)
    springs = np.array([support_stiffness, *(sleeve.spring.stiffness for sleeve in sleeves)])
    free = np.isfinite(springs) & ~np.concatenate([[False], (state.stopped | state.stuck)[row]])
    on_sleeve = np.zeros((len(seats), len(springs)))
    for body, sleeve in enumerate(sleeves, start=1):
        on_sleeve[:, body] = [seat.name in sleeve.bearings for seat in seats]
    motion = (np.eye(len(springs))[0] - on_sleeve)[:, free]  # of the shaft, then of sleeves
    matrix = motion.T @ (stiffness[:, None] * motion) + np.diag(springs[free])
    of_supports = np.zeros(len(springs))
    of_supports[0] = support_stiffness * support_shift(computed, speed, None)[0]
    force = -motion.T @ (stiffness * shift) - of_supports[free]
    displacement = np.linalg.lstsq(matrix, force, rcond=None)[0]
    return np.array([seat.thrust for seat in seats]) * stiffness * (motion @ displacement + shift)
