"""What counts as a miss."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tests.oracles.ball_equations import Balls

Array = NDArray[np.float64]
UNEQUAL = 1e-9  # of the largest load: a balance off by more is wrong, if rounding cannot do it


def rounding(balls: Balls, load: Array) -> Array:
    """Force [N] that 24 roundings of the lengths make under ``load``; the solver allows 16."""
    stiff = max(balls.inner.k, balls.outer.k)
    slope = 1.5 * (stiff**2 * np.maximum(load, 0.0)) ** (1.0 / 3.0)
    return 24.0 * np.finfo(float).eps * (balls.li + balls.lo) * slope
