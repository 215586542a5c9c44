"""Range over tolerances, from the effect of each of them alone.

Every tolerance has a curve of its own through the values that were solved: a parabola through three
of them, cubics that do not overshoot through more. The sum of all is taken at many points drawn
evenly within the tolerances (a Sobol sequence, the same again each time).
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
COVERED = 95.0  # % of machines within the range
POINTS = 4096
EDGE = 0.02  # share so near to an end that the nominal value is that end
CHUNK = 512  # numbers at once


class Effect(NamedTuple):
    """Changes of numbers along one tolerance.

    ``share`` (k,): of the way from its lowest to its highest value, ascending from 0 to 1, the
    nominal one among them; ``change`` (k, numbers), 0 at the nominal one, NaN where there is no
    number. ``nominal``: its share; ``levels``: how many values there are, 0: any in between.
    """

    share: Array
    change: Array
    nominal: float
    levels: int = 0

    def of(self, rows: slice) -> Effect:
        """The same of some of the numbers."""
        return self._replace(change=self.change[:, rows])

    def at(self, share: Array) -> Array:
        """Changes (points, numbers) at shares (points,)."""
        from scipy.interpolate import PchipInterpolator

        if self.levels:
            share = np.minimum((share * self.levels).astype(int), self.levels - 1)
            share = share / max(self.levels - 1, 1)
        change = np.nan_to_num(self.change)
        if len(self.share) > 3:
            return np.asarray(PchipInterpolator(self.share, change)(share))
        low, high = _weights(share, self.nominal)
        return low[:, None] * change[0] + high[:, None] * change[-1]


def _weights(share: Array, nominal: float) -> tuple[Array, Array]:
    """Weights (points,) of the change at the lowest and at the highest value: those of a parabola
    that is zero at the nominal value, of a straight line where that is an end."""
    if nominal < EDGE:
        return np.zeros_like(share), share
    if nominal > 1.0 - EDGE:
        return 1.0 - share, np.zeros_like(share)
    low = (share - nominal) * (share - 1.0) / nominal
    return low, share * (share - nominal) / (1.0 - nominal)


def spread(effects: Sequence[Effect]) -> Array:
    """Ends of the range (numbers, 2) of sums of effects, of one at least."""
    shares, count = _points(len(effects)), effects[0].change.shape[1]
    ends = np.empty((count, 2))
    tails = (50.0 - COVERED / 2.0, 50.0 + COVERED / 2.0)
    for first in range(0, count, CHUNK):
        rows = slice(first, first + CHUNK)
        each = (one.of(rows).at(share) for one, share in zip(effects, shares.T, strict=True))
        ends[rows] = np.percentile(sum(each), tails, axis=0).T
    return ends


def worst(effects: Sequence[Effect]) -> Array:
    """The sum of the largest changes either way (numbers, 2), of one effect at least."""
    changes = [np.nan_to_num(each.change) for each in effects]
    down = sum(np.minimum(each.min(axis=0), 0.0) for each in changes)
    up = sum(np.maximum(each.max(axis=0), 0.0) for each in changes)
    return np.stack([down, up], axis=1)


def _points(count: int) -> Array:
    from scipy.stats import qmc

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        return np.asarray(qmc.Sobol(count, rng=0).random(POINTS))
