"""Loads of the bearings over time, and their largest values."""

from __future__ import annotations

import numpy as np

from rotordyn.analyses.time_response.bearings import Bearings
from rotordyn.analyses.time_response.march import Path
from rotordyn.analyses.time_response.spec import DIRECTIONS
from rotordyn.arrays import Array, Flags
from rotordyn.equation.seat import HALF_TURN_ABOUT_Y
from rotordyn.scene.scene import Scene

TOGETHER = 4096  # states of bearings solved at once, to limit memory


def longest(vectors: Array, time: Array) -> tuple[Array, Array]:
    """Return the times at which vectors (s, t, n, 3) at ``time`` (t,) are longest (s, n), and
    their lengths there.

    Between instants squares of lengths lie on the parabola of the largest one and its neighbours:
    a wave of 20 instants in a period is up to 1 % higher than the highest of these.
    """
    square = (vectors**2).sum(axis=-1)
    at = np.nan_to_num(square, nan=-1.0).argmax(axis=1)[:, None]
    middle = np.clip(at, 1, len(time) - 2)
    before, centre, after = (np.take_along_axis(square, middle + k, 1)[:, 0] for k in (-1, 0, 1))
    slope, curvature = 0.5 * (after - before), after - 2.0 * centre + before
    inner = (at == middle)[:, 0] & (curvature < 0.0)  # False where a neighbour is NaN
    share = np.where(inner, -slope / np.where(inner, curvature, 1.0), 0.0)
    largest = np.where(inner, centre + 0.5 * slope * share, np.take_along_axis(square, at, 1)[:, 0])
    when = time[at[:, 0]] + share * (time[1] - time[0])
    return when, np.sqrt(np.nan_to_num(largest))


def loads_and_peaks(
    scene: Scene, path: Path, time: Array, bearings: Bearings | None
) -> dict[str, Array]:
    """Return the fields of the result about bearings, at the usable speeds."""
    seats = scene.spindle.seats
    shape = (*path.points.shape[:2], len(seats))
    if bearings is None:
        none = np.zeros((shape[0], 0))
        names = ["peak_load", "peak_time", "peak_pressure", "pressure_time"]
        names += ["peak_idle", "unloaded_time"]
        return {"bearing_load": np.zeros((*shape, 3)), **dict.fromkeys(names, none)}
    load = bearings.loads(path.rings, path.force)
    thrust = np.array([seat.thrust for seat in seats])
    sign = np.where(thrust[:, None] < 0, HALF_TURN_ABOUT_Y, 1.0)[:, : len(DIRECTIONS)]
    in_axes = load[..., : len(DIRECTIONS)] * sign
    when_largest, size = longest(in_axes, time)
    pressure, idle, unloaded = _balls(path.rings.reshape(*shape, 5), bearings)
    return {
        "bearing_load": in_axes,
        "peak_load": size,
        "peak_time": when_largest,
        "peak_pressure": pressure.max(axis=1),
        "pressure_time": time[pressure.argmax(axis=1)],
        "peak_idle": idle.max(axis=1),
        "unloaded_time": unloaded.sum(axis=1) * (time[1] - time[0]),
    }


def _balls(moved: Array, bearings: Bearings) -> tuple[Array, Array, Flags]:
    """Return, of rings displaced by ``moved`` (s, t, seats, 5): largest contact pressures [Pa],
    numbers of balls unloaded at the inner race, and flags of no loaded ball (s, t, seats); zero
    past the end."""
    states, instants, seats, _ = moved.shape
    exists = np.isfinite(moved).all(axis=-1)
    share = max(1, TOGETHER // max(1, states * seats))
    pressure, idle = np.zeros((2, *exists.shape))
    unloaded = np.zeros(exists.shape, dtype=bool)
    for first in range(0, instants, share):
        part = slice(first, first + share)
        values = bearings.balls_at(np.nan_to_num(moved[:, part].swapaxes(1, 2)))
        pressure[:, part], idle[:, part], unloaded[:, part] = (x.swapaxes(1, 2) for x in values)
    pressure = np.nan_to_num(pressure, posinf=np.inf)  # NaN without a state
    return np.where(exists, pressure, 0.0), np.where(exists, idle, 0.0), exists & unloaded
