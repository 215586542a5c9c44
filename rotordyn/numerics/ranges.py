"""Ranges of a coordinate in which something holds."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array


def above_zero(at: Array, values: Array) -> Array:
    """First and last (r, 2) of the ranges in which ``values`` (n,), linear between ascending ``at``
    (n,), are above zero.

    >>> above_zero(np.arange(5.0), np.array([-1.0, 1.0, 3.0, -3.0, 2.0])).tolist()
    [[0.5, 2.5], [3.6, 4.0]]
    """
    changes = np.flatnonzero(np.diff(np.pad(values > 0.0, 1).astype(int)))
    return np.array([_zero(at, values, int(k)) for k in changes]).reshape(-1, 2)


def _zero(at: Array, values: Array, k: int) -> float:
    """Where values pass zero on the way to ``k``; the last known place beside an end or NaN."""
    if k in (0, len(at)):
        return float(at[max(k - 1, 0)])
    before, after = values[k - 1 : k + 1].tolist()
    if np.isnan([before, after]).any():
        return float(at[k] if after > 0.0 else at[k - 1])
    return float(at[k - 1] + (at[k] - at[k - 1]) * before / (before - after))
