"""Loads of the bearings over time, and where they are largest."""

from __future__ import annotations

import numpy as np

from rotordyn.analyses.time_response.bearings import Bearings
from rotordyn.analyses.time_response.march import Path
from rotordyn.analyses.time_response.spec import DIRECTIONS
from rotordyn.arrays import Array, Flags
from rotordyn.equation.seat import HALF_TURN_ABOUT_Y
from rotordyn.scene.scene import Scene

TOGETHER = 4096  # states of bearings that are solved at once, for memory


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
        names = ["peak_load", "peak_time", "peak_pressure", "pressure_time"]
        names += ["peak_idle", "unloaded_time"]
        return {"bearing_load": np.zeros((*shape, 3)), **dict.fromkeys(names, none)}
    load = bearings.loads(path.rings, path.force)
    thrust = np.array([seat.thrust for seat in seats])
    turn = np.where(thrust[:, None] < 0, HALF_TURN_ABOUT_Y, 1.0)[:, : len(DIRECTIONS)]
    along = load[..., : len(DIRECTIONS)] * turn
    when_largest, size = longest(along, time)
    pressure, idle, unloaded = _balls(path.rings.reshape(*shape, 5), bearings)
    return {
        "bearing_load": along,
        "peak_load": size,
        "peak_time": when_largest,
        "peak_pressure": pressure.max(axis=1),
        "pressure_time": time[pressure.argmax(axis=1)],
        "peak_idle": idle.max(axis=1),
        "unloaded_time": unloaded.sum(axis=1) * (time[1] - time[0]),
    }


def _balls(moved: Array, bearings: Bearings) -> tuple[Array, Array, Flags]:
    """Of rings displaced by ``moved`` (s, t, seats, 5): largest contact pressures [Pa], counts of
    balls without inner load, and where no ball has any (s, t, seats); zero past the end."""
    states, instants, seats, _ = moved.shape
    there = np.isfinite(moved).all(axis=-1)
    share = max(1, TOGETHER // max(1, states * seats))
    pressure, idle = np.zeros((2, *there.shape))
    unloaded = np.zeros(there.shape, dtype=bool)
    for first in range(0, instants, share):
        some = slice(first, first + share)
        found = bearings.balls_at(np.nan_to_num(moved[:, some].swapaxes(1, 2)))
        pressure[:, some], idle[:, some], unloaded[:, some] = (x.swapaxes(1, 2) for x in found)
    pressure = np.nan_to_num(pressure, posinf=np.inf)  # one without a state is no largest
    return np.where(there, pressure, 0.0), np.where(there, idle, 0.0), there & unloaded
