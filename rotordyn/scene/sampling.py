"""Responses over speed, sampled where they need it: about critical speeds, at every peak, where
curves bend, and on both sides of a speed at which a stop closes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Flags
from rotordyn.numerics.peaks import sampled, spread_between
from rotordyn.scene.scene import Scene

Arrays = Sequence[NDArray[Any]]
LEAST = 40  # speeds, evenly from the first to the last
CLOSEST = 1e-7  # of the highest speed, between two samples and the two sides of a jump
HALVINGS = 30


def over_speed(
    scene: Scene,
    values: Callable[[Scene], Arrays],
    amplitude: Callable[[Arrays], Array],
    centres: Array,
    widths: Array,
) -> tuple[Array, list[NDArray[Any]]]:
    """Sample speeds [rad/s] (n,) from the first to the last usable one, and ``values`` (n, …)
    there.

    ``values`` of a scene: arrays over its usable speeds, NaN in others. ``amplitude`` of them (n,
    curves): every peak of it is sampled to its top, and where its logarithm bends. ``centres`` and
    half ``widths`` (k,) [rad/s]: of peaks that are expected. A speed at which stops close is a
    sample of NaN between its two sides, so that a line drawn through the samples breaks there.
    """
    speeds = scene.speed[scene.usable]
    low, high = float(speeds[0]), float(speeds[-1])
    if low == high:
        return speeds, list(values(scene))

    like = values(scene)

    def solve(speed: Array) -> Arrays:
        other = scene.at(speed)
        if all(other.outcome):
            return [np.full((len(speed), *each.shape[1:]), np.nan, each.dtype) for each in like]
        return [other.scattered(each) for each in values(other)]

    inside = (centres > low) & (centres < high)
    expected = spread_between(centres[inside], widths[inside], low, high, least=LEAST)
    new = np.abs(expected[:, None] - speeds).min(axis=1) > CLOSEST * high  # else the same speed
    start = np.sort(np.concatenate([speeds, expected[new]]))
    start, gaps = _with_stop_speeds(scene, start)
    speed, curves = sampled(start, solve, amplitude)
    for gap in gaps:
        speed, curves = _with_gap(speed, curves, gap)
    return speed, curves


def _with_stop_speeds(scene: Scene, speed: Array) -> tuple[Array, list[float]]:
    """Insert both sides of every speed at which a stop opens or closes; return the speeds, and the
    midpoint of each pair."""
    if not scene.spindle.sleeves:
        return speed, []
    closed = _closed_stops(scene.at(speed))
    gaps: list[tuple[float, float]] = []
    for row in np.flatnonzero((closed[1:] != closed[:-1]).any(axis=1)):
        low, high, closed_below = float(speed[row]), float(speed[row + 1]), closed[row]
        for _ in range(HALVINGS):
            if high - low <= CLOSEST * float(speed[-1]):
                break
            middle = 0.5 * (low + high)
            same = bool((_closed_stops(scene.at(np.array([middle])))[0] == closed_below).all())
            low, high = (middle, high) if same else (low, middle)
        gaps += [(low, high)]
    return (np.unique(np.concatenate([speed, *gaps])), [0.5 * (low + high) for low, high in gaps])


def _closed_stops(scene: Scene) -> Flags:
    """Return which stops are closed at every speed (n, sleeves), none without equilibrium."""
    if all(scene.outcome):
        return np.zeros((len(scene.speed), len(scene.spindle.sleeves)), dtype=bool)
    return scene.scattered(scene.stopped)


def _with_gap(speed: Array, curves: Arrays, gap: float) -> tuple[Array, list[NDArray[Any]]]:
    """Insert a NaN sample at the speed ``gap``."""
    row = int(np.searchsorted(speed, gap))
    return np.insert(speed, row, gap), [np.insert(curve, row, np.nan, axis=0) for curve in curves]
