"""Range over tolerances, from the effect of each of them alone.

Every tolerance has a curve of its own through the values that were solved: a parabola through three
of them, cubics that do not overshoot through more. The effects are summed at many points drawn
evenly within the tolerances (a Sobol sequence, the same again each time).

What is summed is a power of a number, or its logarithm: loads of a rigid preload go with the power
3/2 of displacements that add up, frequencies with a root of stiffnesses. Which power is decided by
two corners, machines of which all tolerances are off at once.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.results.kinds import Array

COVERED = 95.0  # % of machines within the range
POINTS = 4096
EDGE = 0.02  # share so near to an end that the nominal value is that end
CHUNK = 512  # numbers at once, for the memory of their sums
POWERS = (1.0, 2.0 / 3.0, 1.0 / 3.0, 0.0)  # 0: the logarithm
# Of a sum of n even distributions: half width of its 95 % range, over theirs times √n.
HALF_RANGE = 1.96 / math.sqrt(3.0)


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

    @property
    def _without_gaps(self) -> Array:
        """Changes, on a straight line through the nominal value where there is no number."""
        way = (self.share - self.nominal)[:, None]
        known, change = ~np.isnan(self.change), np.nan_to_num(self.change)
        slope = (way * change).sum(axis=0) / np.maximum((known * way**2).sum(axis=0), 1e-300)
        return np.where(known, change, way * slope)

    def at(self, share: Array) -> Array:
        """Changes (points, numbers) at shares (points,)."""
        from scipy.interpolate import PchipInterpolator

        if self.levels:
            share = np.minimum((share * self.levels).astype(int), self.levels - 1)
            share = share / max(self.levels - 1, 1)
        change = self._without_gaps
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


class Corners(NamedTuple):
    """Machines of which all tolerances are off at once: ``share`` (corners, sources) of their ways,
    and what that changes (corners, numbers)."""

    share: Array
    change: Array


class Ranges(NamedTuple):
    """Changes (numbers, 2) from the lowest to the highest: of 95 % of machines, and the ``worst``;
    ``interaction`` (numbers,): what the corners differ from the sum, over the width of the range.
    """

    usual: Array
    worst: Array
    interaction: Array


@dataclass(frozen=True, slots=True)
class _Power:
    """Values as what adds up: a power of them, or their logarithm."""

    power: float

    def of(self, values: Array) -> Array:
        if self.power == 1.0:
            return values
        with np.errstate(divide="ignore", invalid="ignore"):
            known = np.where(values > 0.0, values, np.nan)
            return np.log(known) if self.power == 0.0 else known**self.power

    def back(self, sums: Array) -> Array:
        if self.power == 1.0:
            return sums
        if self.power == 0.0:
            return np.exp(np.minimum(sums, 700.0))
        return np.maximum(sums, 0.0) ** (1.0 / self.power)


def ranges(value: Array, effects: Sequence[Effect], corners: Corners | None = None) -> Ranges:
    """Ranges of numbers of nominal ``value`` (numbers,) under ``effects``, one at least; NaN: of
    changes that just add up."""
    value, count = np.nan_to_num(value), len(value)
    found = Ranges(np.zeros((count, 2)), np.zeros((count, 2)), np.full(count, np.nan))
    errors = np.array([_error(_Power(p), value, effects, corners) for p in POWERS])
    chosen = np.argmin(errors, axis=0)
    points = _points(len(effects))
    for place, power in enumerate(map(_Power, POWERS)):
        rows = np.flatnonzero(chosen == place)
        for part in np.array_split(rows, max(-(-len(rows) // CHUNK), 1)):
            base = power.of(value[part])
            scaled = [_scaled(power, value, each, part) for each in effects]
            sums = sum(e.at(s) for e, s in zip(scaled, points.T, strict=True))
            tails = (50.0 - COVERED / 2.0, 50.0 + COVERED / 2.0)
            ends = np.percentile(base + sums, tails, axis=0).T
            found.usual[part] = power.back(ends) - value[part, None]
            worst = base[:, None] + _worst(scaled)
            found.worst[part] = power.back(worst) - value[part, None]
    if corners is not None:
        width = np.ptp(found.usual, axis=1)
        error = errors[chosen, np.arange(count)]
        found.interaction[:] = np.where(np.isfinite(error), error, np.nan)
        found.interaction[:] /= np.where(width > 0.0, width, np.inf)
    return found


def _scaled(power: _Power, value: Array, effect: Effect, rows: NDArray[np.intp]) -> Effect:
    """An effect on some numbers, as changes of what adds up."""
    own = value[rows]
    return effect._replace(change=power.of(own + effect.change[:, rows]) - power.of(own))


def _error(
    power: _Power, value: Array, effects: Sequence[Effect], corners: Corners | None
) -> Array:
    """What the corners differ from sums of such a power (numbers,); infinite where a number has no
    such power, or is none at a corner."""
    rows = np.arange(len(value))
    if corners is None:
        return np.full(len(value), 0.0 if power.power == 1.0 else np.inf)
    scaled = [_scaled(power, value, each, rows) for each in effects]
    none = [np.isnan(s.change) & ~np.isnan(e.change) for s, e in zip(scaled, effects, strict=True)]
    sums = sum(e.at(s) for e, s in zip(scaled, corners.share.T, strict=True))
    error = np.abs(power.back(power.of(value) + sums) - value - corners.change)
    error = np.where(np.isnan(corners.change).all(axis=0), 0.0, np.fmax.reduce(error, axis=0))
    usable = ~np.any([each.any(axis=0) for each in none], axis=0) & np.isfinite(error)
    return np.where(usable, error, np.inf)


def _worst(effects: Sequence[Effect]) -> Array:
    """The sum of the largest changes either way (numbers, 2)."""
    changes = [np.nan_to_num(each.change) for each in effects]
    down = sum(np.minimum(each.min(axis=0), 0.0) for each in changes)
    up = sum(np.maximum(each.max(axis=0), 0.0) for each in changes)
    return np.stack([down, up], axis=1)


def corner_shares(slopes: Array, nominal: Array) -> Array:
    """Shares (2, sources) of the corners towards which most numbers change together, so far out
    as the range goes where all tolerances matter alike.

    ``slopes`` (numbers, sources): change from end to end, over the largest change of a number.
    """
    towards = np.ones(slopes.shape[1])
    if len(slopes):
        towards = np.linalg.svd(slopes, full_matrices=False)[2][0]
    way = min(1.0, HALF_RANGE / math.sqrt(slopes.shape[1])) * np.where(towards >= 0.0, 1.0, -1.0)
    return np.array([_off(nominal, sign * way) for sign in (1.0, -1.0)])


def _off(nominal: Array, way: Array) -> Array:
    return np.where(way > 0.0, nominal + way * (1.0 - nominal), nominal * (1.0 + way))


def _points(count: int) -> Array:
    """Shares (POINTS, count) spread evenly, the same again each time."""
    from scipy.stats import qmc

    return np.asarray(qmc.Sobol(count, rng=0).random(POINTS))
