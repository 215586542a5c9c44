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
    """Speeds [rad/s] (n,) from the first to the last usable one, and ``values`` (n, …) there.

    ``values`` of a scene: arrays over its usable speeds, NaN in others. ``amplitude`` of them (n,
    curves): every peak of it is sampled to its top, and where its logarithm bends. ``centres`` and
    half ``widths`` (k,) [rad/s]: of peaks that are expected. A speed at which stops close is a
    sample of NaN between its two sides, so that a line drawn through the samples breaks there.
    """
    given = scene.speed[scene.usable]
    low, high = float(given[0]), float(given[-1])
    if low == high:
        return given, list(values(scene))

    like = values(scene)

    def solve(speed: Array) -> Arrays:
        other = scene.at(speed)
        if all(other.outcome):
            return [np.full((len(speed), *each.shape[1:]), np.nan, each.dtype) for each in like]
        return [other.scattered(each) for each in values(other)]

    inside = (centres > low) & (centres < high)
    about = spread_between(centres[inside], widths[inside], low, high, least=LEAST)
    beside = np.abs(about[:, None] - given).min(axis=1) > CLOSEST * high  # else the same speed
    start = np.sort(np.concatenate([given, about[beside]]))
    start, gaps = _jumps(scene, start)
    speed, curves = sampled(start, solve, amplitude)
    for gap in gaps:
        speed, curves = _broken(speed, curves, gap)
    return speed, curves


def _jumps(scene: Scene, speed: Array) -> tuple[Array, list[float]]:
    """With both sides of every speed at which a stop opens or closes, and what lies between."""
    if not scene.spindle.sleeves:
        return speed, []
    held = _stops(scene.at(speed))
    gaps: list[tuple[float, float]] = []
    for row in np.flatnonzero((held[1:] != held[:-1]).any(axis=1)):
        low, high, before = float(speed[row]), float(speed[row + 1]), held[row]
        for _ in range(HALVINGS):
            if high - low <= CLOSEST * float(speed[-1]):
                break
            middle = 0.5 * (low + high)
            same = bool((_stops(scene.at(np.array([middle])))[0] == before).all())
            low, high = (middle, high) if same else (low, middle)
        gaps += [(low, high)]
    return (
        np.unique(np.concatenate([speed, *gaps])),
        [0.5 * (low + high) for low, high in gaps],
    )


def _stops(scene: Scene) -> Flags:
    """Which stops are closed at every speed (n, sleeves); none where there is no equilibrium."""
    if all(scene.outcome):
        return np.zeros((len(scene.speed), len(scene.spindle.sleeves)), dtype=bool)
    return scene.scattered(scene.stopped)


def _broken(speed: Array, curves: Arrays, gap: float) -> tuple[Array, list[NDArray[Any]]]:
    """With a sample without values."""
    place = int(np.searchsorted(speed, gap))
    return np.insert(speed, place, gap), [np.insert(each, place, np.nan, axis=0) for each in curves]
