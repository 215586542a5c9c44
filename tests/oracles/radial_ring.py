"""A radially loaded ring ball by ball: every ball centre balanced by bisection, then summed.

Dimensionless: forces over the centrifugal force Fc of a ball, lengths over δc = ke Fc^(2/3), so
ke = 1 and ki is the ratio of compliances. Nothing is shared with the approximation.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

Array = NDArray[np.float64]


def ball_load(approach: ArrayLike, ratio: float) -> Array:
    """Load on the inner race of balls pressed by ``approach`` δ/δc: Qe = Qi + Fc, by bisection."""
    approach = np.asarray(approach, float)
    low, high = np.ones_like(approach), np.maximum(approach, 1.0)  # of the ball centre's way out
    for _ in range(60):
        middle = 0.5 * (low + high)
        inner = (np.maximum(approach - middle, 0.0) / ratio) ** 1.5
        outwards = middle**1.5 < inner + 1.0
        low, high = np.where(outwards, middle, low), np.where(outwards, high, middle)
    return np.maximum(low**1.5 - 1.0, 0.0)


def positions(balls: int, between: bool = False) -> Array:
    """Angles of the balls from the load: one ball under it, or the middle of a gap."""
    return 2.0 * np.pi * (np.arange(balls) + 0.5 * between) / balls


def radial_load(displacement: float, ratio: float, angles: Array, half_clearance: float = 0.0) -> float:
    """Sum of the balls' loads along the displacement δr/δc."""
    approach = displacement * np.cos(angles) - half_clearance
    return float(np.sum(ball_load(approach, ratio) * np.cos(angles)))


def displacement(load: float, ratio: float, angles: Array) -> float:
    """δr/δc of a ring under ``load`` Fr/Fc."""
    high = 2.0
    while radial_load(high, ratio, angles) < load:
        high *= 2.0
    return float(brentq(lambda d: radial_load(d, ratio, angles) - load, 1.0, high, xtol=1e-13))
