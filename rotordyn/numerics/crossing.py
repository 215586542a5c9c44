"""Zero crossings of a sampled curve, the ranges in which it is positive, and bisection."""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce

import numpy as np

from rotordyn.arrays import Array

SAME = 1e-12  # of x: samples this close to each other count as one


def zero_crossings(x: Array, y: Array) -> list[float]:
    """Return the zeros of y(x) between neighbouring samples of opposite sign, on the local cubic.

    Samples that are not finite interrupt the curve.
    """
    zero = y == 0.0
    side = np.append(np.where(np.isfinite(y), np.sign(y), 0.0), 0.0)
    crosses = side[:-1] * side[1:] < 0.0
    return [
        float(x[k]) if zero[k] else _zero(x, y, k) for k in np.flatnonzero(zero | crosses).tolist()
    ]


def above_zero(x: Array, y: Array) -> Array:
    """Return first and last x (r, 2) of the ranges in which y(x) is positive, up to the last finite
    sample next to others.

    >>> above_zero(np.arange(5.0), np.array([-1.0, 1.0, 3.0, 5.0, np.nan])).round(9).tolist()
    [[0.5, 3.0]]
    """
    ends = []
    for k in np.flatnonzero(np.diff(np.pad(y > 0.0, 1).astype(int))).tolist():
        finite = [i for i in (k - 1, k) if 0 <= i < len(y) and np.isfinite(y[i])]
        ends.append(_zero(x, y, k - 1) if len(finite) > 1 else float(x[finite[0]]))
    return np.array(ends).reshape(-1, 2)


def _zero(x: Array, y: Array, k: int) -> float:
    """Bisect the polynomial through up to four distinct samples around the interval k."""
    middle, width = 0.5 * (x[k] + x[k + 1]), x[k + 1] - x[k]
    same = SAME * np.abs(x[k : k + 2]).max()
    if width <= same:
        return float(middle)
    distinct = np.abs(x[:, None] - x[k : k + 2]).min(axis=1) > same
    before, after = np.flatnonzero(distinct[:k])[-1:], k + 2 + np.flatnonzero(distinct[k + 2 :])[:1]
    near = np.concatenate([before, [k, k + 1], after])
    near = near[np.isfinite(y[near])]
    fitted = np.polynomial.polynomial.polyfit((x[near] - middle) / width, y[near], len(near) - 1)
    descending, positive = fitted[::-1].tolist(), bool(y[k] > 0.0)

    def before_zero(at: float) -> bool:
        return (reduce(lambda sum_, c: sum_ * at + c, descending) > 0.0) == positive

    low, high = boundary(before_zero, -0.5, 0.5, halvings=60)  # down to rounding
    return float(middle + width * 0.5 * (low + high))


def boundary(
    holds: Callable[[float], bool], low: float, high: float, halvings: int = 30
) -> tuple[float, float]:
    """Return both sides of a place between ``low``, where something ``holds``, and ``high``, where
    it does not, by ``halvings`` of the interval."""
    for _ in range(halvings):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if holds(middle) else (low, middle)
    return low, high
