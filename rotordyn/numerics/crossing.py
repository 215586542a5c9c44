"""Where a sampled curve crosses zero."""

from __future__ import annotations

from functools import reduce

import numpy as np

from rotordyn.arrays import Array


def zero_crossings(x: Array, y: Array) -> list[float]:
    """Zeros of y(x) between neighbouring samples of opposite sign, on the local cubic.

    Samples that are not finite interrupt the curve.
    """
    met = y == 0.0
    side = np.append(np.where(np.isfinite(y), np.sign(y), 0.0), 0.0)
    passed = side[:-1] * side[1:] < 0.0
    return [
        float(x[k]) if met[k] else _zero(x, y, k) for k in np.flatnonzero(met | passed).tolist()
    ]


def _zero(x: Array, y: Array, k: int) -> float:
    """Bisection on the polynomial through up to four samples around the interval k."""
    near = np.arange(max(k - 1, 0), min(k + 3, len(x)))
    near = near[np.isfinite(y[near])]
    middle, width = 0.5 * (x[k] + x[k + 1]), x[k + 1] - x[k]
    fitted = np.polynomial.polynomial.polyfit((x[near] - middle) / width, y[near], len(near) - 1)
    descending, positive = fitted[::-1].tolist(), bool(y[k] > 0.0)
    low, high = -0.5, 0.5
    for _ in range(60):
        centre = 0.5 * (low + high)
        if (reduce(lambda sum_, each: sum_ * centre + each, descending) > 0.0) == positive:
            low = centre
        else:
            high = centre
    return float(middle + width * 0.5 * (low + high))
