"""Pockets: maxima of the stable depth over speed, and the tolerance of their speed."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Indices

MOST = 8  # pockets
PROMINENT = 0.05  # of the deepest limit: least prominence of a pocket
ENDLESS = 2.0  # times the deepest finite limit: stand-in for an infinite one
KEPT = 0.8  # of the depth of a pocket: least limit over its range of speeds


class Pockets(NamedTuple):
    """Pockets, the deepest first: ``place`` among the speeds; between ``low`` and ``high`` [rad/s]
    the limit is above ``KEPT`` of the depth."""

    place: Indices
    low: Array
    high: Array


def pockets(speed: Array, depth: Array) -> Pockets:
    """Return the pockets of a limit (s,) over speed (s,). Where no depth is unstable, and next to
    that, there is none. A maximum between ``low`` and ``high`` of a deeper one belongs to it."""
    finite = np.where(np.isfinite(depth), depth, 0.0)
    top = finite.max(initial=0.0)
    finite[np.isposinf(depth)] = ENDLESS * top
    maxima = [k for k in _maxima(finite) if np.isfinite(depth[k])]
    maxima = [k for k in maxima if _prominence(finite, k) >= PROMINENT * top]
    ranges: dict[int, tuple[float, float]] = {}
    for place in sorted(maxima, key=lambda k: -finite[k]):
        if not any(low <= speed[place] <= high for low, high in ranges.values()):
            ranges[place] = _range(speed, finite, place)
    ends = np.array([*ranges.values()][:MOST], dtype=float).reshape(-1, 2)
    return Pockets(np.array([*ranges][:MOST], dtype=np.intp), *ends.T)


def _maxima(depth: Array) -> list[int]:
    """Return indices of the local maxima; of a plateau, the middle one."""
    first = np.flatnonzero(np.diff(depth, prepend=np.nan) != 0.0)
    last = np.append(first[1:], len(depth)) - 1
    level = depth[first]
    inner = np.flatnonzero((level[1:-1] > level[:-2]) & (level[1:-1] > level[2:])) + 1
    return [*((first[inner] + last[inner]) // 2).tolist()]


def _prominence(depth: Array, at: int) -> float:
    """Return the prominence of a maximum: its height above the higher of the minima on both sides,
    each taken up to the next higher value."""
    lowest = []
    for side in (depth[at::-1], depth[at:]):
        higher = np.flatnonzero(side > depth[at])
        lowest.append(side[: higher[0] if higher.size else None].min())
    return float(depth[at] - max(lowest))


def _range(speed: Array, depth: Array, at: int) -> tuple[float, float]:
    """Return the speeds below and above a pocket up to which ``KEPT`` of its depth holds."""
    level = KEPT * depth[at]
    return _falls(speed[at::-1], depth[at::-1], level), _falls(speed[at:], depth[at:], level)


def _falls(speed: Array, depth: Array, level: float) -> float:
    """Return the speed at which the depth first falls to a level; the last one if it does not."""
    below = np.flatnonzero(depth < level)
    if not below.size:
        return float(speed[-1])
    k = below[0]
    share = (depth[k - 1] - level) / (depth[k - 1] - depth[k])
    return float(speed[k - 1] + share * (speed[k] - speed[k - 1]))
