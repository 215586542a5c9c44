"""Axial loads that shifts of the shaft would add where they are not modelled.

To first order, of shifts by speed, by forces along the axis, and by a housing that expands
otherwise.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from rotordyn.arrays import Array
from rotordyn.machine.growth import ComputedShortening
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.axial_force import compliance
from rotordyn.preload.shortening import shortened
from rotordyn.preload.state import PreloadState

ShiftAt = Callable[[list[float]], Array]  # of stations (k,) [m], towards +x (k,) [m]


def shortening_load(state: PreloadState, row: int) -> Array:
    """Return the axial load of every bearing in its own frame (seats,) [N] that computed shortening
    adds."""
    start = ComputedShortening(state.spindle.seats[0].x)
    spindle, speed = replace(state.spindle, shortening=start), state.speed[[row]]
    return shift_load(state, row, lambda stations: shortened(spindle, speed, stations)[0])


def shift_load(state: PreloadState, row: int, shift_at: ShiftAt) -> Array:
    """Return the axial load of every bearing in its own frame (seats,) [N] that a shift of the
    shaft against the housing adds.

    Springs, bearings by their tangents, and supports respond to the shift at their stations;
    sleeves that are locked, at a stop or held by friction stay.
    """
    spindle = state.spindle
    seats, sleeves, supports = spindle.seats, spindle.sleeves, spindle.supports
    shift = shift_at([seat.x for seat in seats])
    stiffness = state.seat_stiffness()[row, :, 0, 0]
    along = np.array([support.along for support in supports])
    springs = np.array([along.sum(), *(sleeve.spring.stiffness for sleeve in sleeves)])
    free = np.isfinite(springs) & ~np.concatenate([[False], (state.stopped | state.stuck)[row]])
    on_sleeve = np.zeros((len(seats), len(springs)))
    for body, sleeve in enumerate(sleeves, start=1):
        on_sleeve[:, body] = [seat.name in sleeve.bearings for seat in seats]
    motion = (np.eye(len(springs))[0] - on_sleeve)[:, free]  # of the shaft, then of sleeves
    matrix = motion.T @ (stiffness[:, None] * motion) + np.diag(springs[free])
    of_supports = np.zeros(len(springs))
    of_supports[0] = along @ shift_at([support.x for support in supports])
    force = -motion.T @ (stiffness * shift) - of_supports[free]
    displacement = np.linalg.lstsq(matrix, force, rcond=None)[0]
    return np.array([seat.thrust for seat in seats]) * stiffness * (motion @ displacement + shift)


def stretch(spindle: Spindle, tension: float, stations: list[float]) -> Array:
    """Return the shift of the shaft at ``stations`` by the ``tension`` [N] at its ends and by the
    drawbar, which presses it together, relative to the first bearing (stations,) [m]."""
    start, bar = spindle.seats[0].x, spindle.drawbar
    shift = tension * np.array([compliance(spindle, start, x) for x in stations])
    if bar is not None:
        low, high = bar.start, bar.end
        within = np.clip([start, *stations], low, high).tolist()
        shift -= bar.force * np.array([compliance(spindle, within[0], x) for x in within[1:]])
    return shift
