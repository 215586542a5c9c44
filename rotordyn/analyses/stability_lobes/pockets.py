"""Pockets: maxima of the stable depth over speed, and how far the speed may be off."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
MOST = 8  # pockets
PROMINENT = 0.05  # of the deepest, by which a pocket is deeper than what is around it
ENDLESS = 2.0  # times the deepest limit: what stands for none
KEPT = 0.8  # of the depth of a pocket, which its margin keeps


class Pockets(NamedTuple):
    """The deepest first: place among the speeds, and ``low`` and ``high``: between them the limit
    is above ``KEPT`` of the depth [rad/s]."""

    place: NDArray[np.intp]
    low: Array
    high: Array


def pockets(speed: Array, depth: Array) -> Pockets:
    """Of a limit (s,) over speed (s,). Where no depth is unstable, and on the way there, there is
    no pocket. What lies between ``low`` and ``high`` of a deeper one belongs to it."""
    finite = np.where(np.isfinite(depth), depth, 0.0)
    top = finite.max(initial=0.0)
    finite[np.isposinf(depth)] = ENDLESS * top
    tops = [k for k in _tops(finite) if np.isfinite(depth[k])]
    tops = [k for k in tops if _prominence(finite, k) >= PROMINENT * top]
    found: dict[int, tuple[float, float]] = {}
    for at in sorted(tops, key=lambda k: -finite[k]):
        if not any(low <= speed[at] <= high for low, high in found.values()):
            found[at] = _ends(speed, finite, at)
    ends = np.array([*found.values()][:MOST], dtype=float).reshape(-1, 2)
    return Pockets(np.array([*found][:MOST], dtype=np.intp), *ends.T)


def _tops(depth: Array) -> list[int]:
    """Places that are higher than what is before and behind them; the middle one of equal ones."""
    first = np.flatnonzero(np.diff(depth, prepend=np.nan) != 0.0)
    last = np.append(first[1:], len(depth)) - 1
    level = depth[first]
    inner = np.flatnonzero((level[1:-1] > level[:-2]) & (level[1:-1] > level[2:])) + 1
    return [*((first[inner] + last[inner]) // 2).tolist()]


def _prominence(depth: Array, at: int) -> float:
    """Height of a top above the higher of the lowest places on its two sides, each as far as
    nothing is higher."""
    lowest = []
    for side in (depth[at::-1], depth[at:]):
        higher = np.flatnonzero(side > depth[at])
        lowest.append(side[: higher[0] if higher.size else None].min())
    return float(depth[at] - max(lowest))


def _ends(speed: Array, depth: Array, at: int) -> tuple[float, float]:
    """Speeds below and above a pocket to which ``KEPT`` of its depth holds."""
    level = KEPT * depth[at]
    return _until(speed[at::-1], depth[at::-1], level), _until(speed[at:], depth[at:], level)


def _until(speed: Array, depth: Array, level: float) -> float:
    """The speed at which the depth first comes down to a level, the last one where it does not."""
    below = np.flatnonzero(depth < level)
    if not below.size:
        return float(speed[-1])
    k = below[0]
    share = (depth[k - 1] - level) / (depth[k - 1] - depth[k])
    return float(speed[k - 1] + share * (speed[k] - speed[k - 1]))
