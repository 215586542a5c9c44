"""Range over tolerances, from the effect of each of them alone.

Every tolerance has a curve of its own through its lowest, nominal and highest value; their sum is
taken at many points drawn evenly within all tolerances (a Sobol sequence, the same again each
time).
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
COVERED = 95.0  # % of machines within the range
POINTS = 4096
EDGE = 0.02  # share so near to an end that the nominal value is that end
CHUNK = 512  # numbers at once


def spread(low: Array, high: Array, shares: Sequence[float]) -> Array:
    """Ends of the range (numbers, 2) of sums of effects.

    ``low`` and ``high`` (numbers, sources): change when a source goes to its end, NaN where it
    leads to no number: such a source is left out. ``shares`` (sources,): of the way from lowest to
    highest at which it is nominal.
    """
    count = low.shape[1]
    if not count:
        return np.zeros((len(low), 2))
    basis_low, basis_high = _bases(_points(count), np.asarray(shares))
    low, high = np.nan_to_num(low), np.nan_to_num(high)
    ends = np.empty((len(low), 2))
    tails = (50.0 - COVERED / 2.0, 50.0 + COVERED / 2.0)
    for first in range(0, len(low), CHUNK):
        rows = slice(first, first + CHUNK)
        sums = low[rows] @ basis_low.T + high[rows] @ basis_high.T
        ends[rows] = np.percentile(sums, tails, axis=1).T
    return ends


def worst(low: Array, high: Array) -> Array:
    """The sum of the largest changes either way (numbers, 2)."""
    both = np.nan_to_num(np.stack([low, high]))
    down, up = np.minimum(both.min(axis=0), 0.0), np.maximum(both.max(axis=0), 0.0)
    return np.stack([down.sum(axis=1), up.sum(axis=1)], axis=1)


def _points(count: int) -> Array:
    from scipy.stats import qmc

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        return np.asarray(qmc.Sobol(count, rng=0).random(POINTS))


def _bases(share: Array, nominal: Array) -> tuple[Array, Array]:
    """Weights (points, sources) of the effect at the lowest and at the highest value: those of the
    parabola through both and zero at the nominal value, of a straight line where that is an end."""
    inner = np.clip(nominal, EDGE, 1.0 - EDGE)
    low = (share - inner) * (share - 1.0) / inner
    high = share * (share - inner) / (1.0 - inner)
    low = np.where(nominal < EDGE, 0.0, low)
    high = np.where(nominal > 1.0 - EDGE, 0.0, high)
    low = np.where(nominal > 1.0 - EDGE, 1.0 - share, low)
    high = np.where(nominal < EDGE, share, high)
    return low, high
