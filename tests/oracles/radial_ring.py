"""A radially loaded ring ball by ball: every ball centre balanced by bisection, then summed.

Dimensionless: forces over the centrifugal force Fc of a ball, lengths over δc = ke Fc^(2/3), so
ke = 1 and ki is the ratio of compliances. Nothing is shared with the approximation.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import elementwise

Array = NDArray[np.float64]


def positions(balls: int, between: bool = False) -> Array:
    """Angles of the balls from the load: one ball under it, or the middle of a gap."""
    return 2.0 * np.pi * (np.arange(balls) + 0.5 * between) / balls


def ball_load(approach: ArrayLike, ratio: ArrayLike) -> Array:
    """Load Qi on the inner race of balls pressed by ``approach`` δ: Qe = Qi + 1, by bisection."""
    approach, ratio = np.asarray(approach, float), np.asarray(ratio, float)
    low, high = np.ones_like(approach), np.maximum(approach, 1.0)  # the ball centre's way outwards
    for _ in range(55):
        middle = 0.5 * (low + high)
        outwards = middle**1.5 < (np.maximum(approach - middle, 0.0) / ratio) ** 1.5 + 1.0
        low, high = np.where(outwards, middle, low), np.where(outwards, high, middle)
    return low**1.5 - 1.0


def ball_loads(
    displacement: ArrayLike, ratio: ArrayLike, angles: Array, half_clearance: float = 0.0
) -> Array:
    """Loads Qi of all balls at a ring displacement δr (…), shape (…, balls)."""
    approach = np.asarray(displacement, float)[..., None] * np.cos(angles) - half_clearance
    return ball_load(approach, np.asarray(ratio, float)[..., None])


def radial_load(
    displacement: ArrayLike, ratio: ArrayLike, angles: Array, half_clearance: float = 0.0
) -> Array:
    """Fr (…) along the displacement δr (…)."""
    loads = ball_loads(displacement, ratio, angles, half_clearance)
    return np.asarray(np.sum(loads * np.cos(angles), axis=-1))


def displacement(load: ArrayLike, ratio: ArrayLike, angles: Array) -> Array:
    """δr (…) under a load Fr (…), without clearance; it lies below that of one ball alone."""
    load, ratio = np.broadcast_arrays(np.asarray(load, float), np.asarray(ratio, float))
    along = np.max(np.cos(angles))
    one = load / along
    most = (ratio * one ** (2.0 / 3.0) + (1.0 + one) ** (2.0 / 3.0)) / along
    found = elementwise.find_root(
        lambda d, f, k: radial_load(d, k, angles) / f - 1.0,
        (np.ones_like(load), most * (1.0 + 1e-9)),
        args=(load, ratio),
    )
    assert found.success.all()
    return np.asarray(found.x)
