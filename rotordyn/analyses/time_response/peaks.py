"""Loads of the bearings over time, and where they are largest."""

from __future__ import annotations

import numpy as np

from rotordyn.analyses.time_response.bearings import Bearings
from rotordyn.analyses.time_response.march import Path
from rotordyn.analyses.time_response.spec import DIRECTIONS
from rotordyn.arrays import Array, Indices
from rotordyn.equation.seat import HALF_TURN_ABOUT_Y
from rotordyn.scene.scene import Scene

LOOKED_AT = 8  # highest peaks of the load at which contact pressures are computed


def longest(vectors: Array, time: Array) -> tuple[Array, Array]:
    """When vectors (s, t, n, 3) at ``time`` (t,) are longest (s, n), and how long they are.

    Between instants squares of lengths are on the parabola of the largest one and its neighbours:
    a wave of 20 instants in a period is 1 % higher than the highest of these.
    """
    square = (vectors**2).sum(axis=-1)
    at = np.nan_to_num(square, nan=-1.0).argmax(axis=1)[:, None]
    middle = np.clip(at, 1, len(time) - 2)
    before, here, after = (np.take_along_axis(square, middle + k, 1)[:, 0] for k in (-1, 0, 1))
    slope, bend = 0.5 * (after - before), after - 2.0 * here + before
    peaked = (at == middle)[:, 0] & (bend < 0.0)  # False where a neighbour is none
    share = np.where(peaked, -slope / np.where(peaked, bend, 1.0), 0.0)
    largest = np.where(peaked, here + 0.5 * slope * share, np.take_along_axis(square, at, 1)[:, 0])
    when = time[at[:, 0]] + share * (time[1] - time[0])
    return when, np.sqrt(np.nan_to_num(largest))


def loads_and_peaks(
    scene: Scene, path: Path, time: Array, bearings: Bearings | None
) -> dict[str, Array]:
    """The fields of the result about bearings, at the usable speeds."""
    seats = scene.spindle.seats
    shape = (*path.points.shape[:2], len(seats))
    if bearings is None:
        none = np.zeros((shape[0], 0))
        names = ("peak_load", "peak_time", "peak_pressure", "pressure_time", "peak_idle")
        return {"bearing_load": np.zeros((*shape, 3)), **dict.fromkeys(names, none)}
    load = bearings.loads(path.rings, path.force)
    thrust = np.array([seat.thrust for seat in seats])
    turn = np.where(thrust[:, None] < 0, HALF_TURN_ABOUT_Y, 1.0)[:, : len(DIRECTIONS)]
    along = load[..., : len(DIRECTIONS)] * turn
    when_largest, size = longest(along, time)
    looked = _peaks(np.nan_to_num(load / bearings.lever.reshape(-1, 5)))
    moved = np.take_along_axis(path.rings.reshape(*shape, 5), looked[..., None], axis=1)
    pressure, idle = bearings.balls_at(np.nan_to_num(moved.swapaxes(1, 2)))
    highest = pressure.argmax(axis=2)[..., None]
    when = np.take_along_axis(looked.swapaxes(1, 2), highest, axis=2)[..., 0]
    return {
        "bearing_load": along,
        "peak_load": size,
        "peak_time": when_largest,
        "peak_pressure": pressure.max(axis=2),
        "pressure_time": time[when],
        "peak_idle": idle.max(axis=2),
    }


def _peaks(load: Array) -> Indices:
    """Instants (s, k, seats) of the highest peaks of loads (s, t, seats, 5), moments as forces at
    the pitch circle."""
    size = np.linalg.norm(load, axis=-1)
    beside = np.pad(size, ((0, 0), (1, 1), (0, 0)), constant_values=-1.0)
    peak = np.where((size >= beside[:, :-2]) & (size >= beside[:, 2:]), size, -1.0)
    return np.argsort(-peak, axis=1, kind="stable")[:, :LOOKED_AT]
