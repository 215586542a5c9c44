"""Pockets: maxima of the stable depth over speed, and how far the speed may be off."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.signal import find_peaks

Array = NDArray[np.float64]
MOST = 8  # pockets
PROMINENT = 0.05  # of the deepest, by which a pocket is deeper than what is around it
KEPT = 0.8  # of the depth of a pocket, which its margin keeps


class Pockets(NamedTuple):
    """The deepest first: place among the speeds, and ``low`` and ``high``: between them the limit
    is above ``KEPT`` of the depth [rad/s]."""

    place: NDArray[np.intp]
    low: Array
    high: Array


def pockets(speed: Array, depth: Array) -> Pockets:
    """Of a limit (s,) over speed (s,); where no depth is unstable there is no pocket."""
    finite = np.where(np.isfinite(depth), depth, 0.0)
    tops, _ = find_peaks(finite, prominence=PROMINENT * finite.max(initial=0.0) or None)
    place = np.asarray(tops[np.argsort(-finite[tops])][:MOST], dtype=np.intp)
    ends = [_ends(speed, finite, at) for at in place.tolist()]
    low, high = np.array(ends, dtype=float).reshape(-1, 2).T
    return Pockets(place, low, high)


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
