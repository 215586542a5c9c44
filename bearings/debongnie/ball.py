"""One ball between both races under its centrifugal force, and Debongnie's power law for it.

x = δ/δc − 1 and y = Qi/Fc: δ approach of the rings at the ball, Qi load on the inner race, Fc
centrifugal force, δc = ke Fc^(2/3) the approach at which the ball just meets the inner race. The
compliances ki, ke are those of δ = k Q^(2/3).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
LOWEST, HIGHEST = 1e-2, 1e2  # x for which A and n are meant


class PowerLaw(NamedTuple):
    """Factor A and exponent n of y = A xⁿ."""

    factor: Array | float
    exponent: Array | float

    def __call__(self, x: ArrayLike) -> Array:
        """y at x, 0 where x ≤ 0."""
        return np.asarray(self.factor * np.maximum(x, 0.0) ** self.exponent)


def deflection(y: ArrayLike, ratio: ArrayLike) -> Array:
    """x of a ball that carries ``y`` ≥ 0, exact (6); ``ratio`` is ki/ke. Broadcasts."""
    return _deflection(np.cbrt(np.asarray(y, float)) ** 2, np.asarray(ratio, float))


def load(x: ArrayLike, ratio: ArrayLike) -> Array:
    """y of a ball pressed by ``x``, the inverse of ``deflection``; 0 where x ≤ 0. Broadcasts."""
    from scipy.optimize import elementwise

    wanted, k = np.broadcast_arrays(np.maximum(np.asarray(x, float), 0.0), np.asarray(ratio, float))
    top = wanted / k * (1.0 + 1e-12)  # y^(2/3) if the outer race were rigid, beyond rounding
    found = elementwise.find_root(
        lambda t, x, k: _deflection(t, k) - x, (np.zeros_like(top), top), args=(wanted, k)
    )
    return np.asarray(found.x) ** 1.5


def _deflection(t: Array, ratio: Array) -> Array:
    """x at t = y^(2/3)."""
    return np.asarray(ratio * t + np.expm1(np.log1p(t**1.5) * (2.0 / 3.0)))


def power_law(ratio: ArrayLike) -> PowerLaw:
    """A and n for ki/ke = ``ratio`` in closed form (12 to 14)."""
    b = np.asarray(ratio, float) + 0.537
    n = 1.0 / (2.0 / 3.0 + 0.08904 / b)
    return PowerLaw(b**-n, n)


def fitted_power_law(ratio: float, low: float = LOWEST, high: float = HIGHEST) -> PowerLaw:
    """A and n of ln y = ln A + n ln x, by least squares for x from ``low`` to ``high``."""
    x = np.geomspace(low, high, 201)
    n, intercept = np.polyfit(np.log(x), np.log(load(x, ratio)), 1)
    return PowerLaw(math.exp(intercept), float(n))
