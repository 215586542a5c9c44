"""Range of numbers over tolerances, from the effect of each tolerance alone.

The effect of a tolerance is a curve through the solved values: a parabola through three of them,
monotone cubics (PCHIP) through more. The effects are summed at many points distributed evenly
within the tolerances (a Sobol sequence with a fixed seed).

What is summed is a power of a number, or its logarithm: loads of a rigid preload go with the power
3/2 of displacements, which add up, frequencies with the root of stiffnesses. The power is the one
that agrees best with two corners, machines with all tolerances off at once.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Indices

COVERED = 95.0  # % of machines within the usual range
POINTS = 4096
EDGE = 0.02  # share within which the nominal value counts as an end of the tolerance
CHUNK = 512  # numbers summed at once, to limit memory
POWERS = (1.0, 2.0 / 3.0, 1.0 / 3.0, 0.0)  # 0: the logarithm
# Half width of the 95 % range of a sum of n uniform distributions, over that of one times √n.
HALF_RANGE = 1.96 / math.sqrt(3.0)


class Effect(NamedTuple):
    """Changes of numbers along one tolerance.

    ``share`` (k,): positions between its lowest (0) and highest value (1), ascending, the nominal
    one included; ``change`` (k, numbers): 0 at the nominal one, NaN where there is no number.
    ``nominal``: share of the nominal value; ``levels``: number of discrete values, 0 if continuous.
    """

    share: Array
    change: Array
    nominal: float
    levels: int = 0

    @property
    def _without_gaps(self) -> Array:
        """Changes; missing ones on a straight line fitted through the nominal value."""
        distance = (self.share - self.nominal)[:, None]
        known, change = ~np.isnan(self.change), np.nan_to_num(self.change)
        slope = (distance * change).sum(axis=0) / np.maximum(
            (known * distance**2).sum(axis=0), 1e-300
        )
        return np.where(known, change, distance * slope)

    def at(self, share: Array) -> Array:
        """Interpolate the changes (points, numbers) at shares (points,)."""
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
    """Weights (points,) of the changes at the lowest and the highest value, of a parabola that is
    zero at the nominal value; of a straight line if the nominal value is an end."""
    if nominal < EDGE:
        return np.zeros_like(share), share
    if nominal > 1.0 - EDGE:
        return 1.0 - share, np.zeros_like(share)
    low = (share - nominal) * (share - 1.0) / nominal
    return low, share * (share - nominal) / (1.0 - nominal)


class Corners(NamedTuple):
    """Machines with all tolerances off at once: ``share`` (corners, sources) of each tolerance, and
    ``change`` (corners, numbers) from the nominal machine."""

    share: Array
    change: Array


class Ranges(NamedTuple):
    """Lowest and highest changes (numbers, 2): ``usual`` of 95 % of machines, ``worst`` of all;
    ``interaction`` (numbers,): difference of corners and sums, over the width of the usual range.
    """

    usual: Array
    worst: Array
    interaction: Array


@dataclass(frozen=True, slots=True)
class _Power:
    """Transformation of values to what adds up: a power of them, or their logarithm (0)."""

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
    """Ranges of numbers with nominal ``value`` (numbers,) under at least one effect. The changes
    themselves are summed where the value is NaN."""
    value, count = np.nan_to_num(value), len(value)
    result = Ranges(np.zeros((count, 2)), np.zeros((count, 2)), np.full(count, np.nan))
    errors = np.array([_error(_Power(p), value, effects, corners) for p in POWERS])
    chosen = np.argmin(errors, axis=0)
    points = _points(len(effects))
    for index, power in enumerate(map(_Power, POWERS)):
        rows = np.flatnonzero(chosen == index)
        for part in np.array_split(rows, max(-(-len(rows) // CHUNK), 1)):
            base = power.of(value[part])
            scaled = [_scaled(power, value, each, part) for each in effects]
            sums = sum(e.at(s) for e, s in zip(scaled, points.T, strict=True))
            tails = (50.0 - COVERED / 2.0, 50.0 + COVERED / 2.0)
            ends = np.percentile(base + sums, tails, axis=0).T
            result.usual[part] = power.back(ends) - value[part, None]
            worst = base[:, None] + _worst(scaled)
            result.worst[part] = power.back(worst) - value[part, None]
    if corners is not None:
        width = np.ptp(result.usual, axis=1)
        error = errors[chosen, np.arange(count)]
        result.interaction[:] = np.where(np.isfinite(error), error, np.nan)
        result.interaction[:] /= np.where(width > 0.0, width, np.inf)
    return result


def _scaled(power: _Power, value: Array, effect: Effect, rows: Indices) -> Effect:
    """Effect on the numbers ``rows``, as changes of the transformed values."""
    nominal = value[rows]
    return effect._replace(change=power.of(nominal + effect.change[:, rows]) - power.of(nominal))


def _error(
    power: _Power, value: Array, effects: Sequence[Effect], corners: Corners | None
) -> Array:
    """Difference of corners from sums under a ``power`` (numbers,); infinite where the power of a
    number does not exist, or a corner has no number."""
    rows = np.arange(len(value))
    if corners is None:
        return np.full(len(value), 0.0 if power.power == 1.0 else np.inf)
    scaled = [_scaled(power, value, each, rows) for each in effects]
    undefined = [
        np.isnan(s.change) & ~np.isnan(e.change) for s, e in zip(scaled, effects, strict=True)
    ]
    sums = sum(e.at(s) for e, s in zip(scaled, corners.share.T, strict=True))
    error = np.abs(power.back(power.of(value) + sums) - value - corners.change)
    error = np.where(np.isnan(corners.change).all(axis=0), 0.0, np.fmax.reduce(error, axis=0))
    usable = ~np.any([each.any(axis=0) for each in undefined], axis=0) & np.isfinite(error)
    return np.where(usable, error, np.inf)


def _worst(effects: Sequence[Effect]) -> Array:
    """Sums of the largest decreases and of the largest increases (numbers, 2)."""
    changes = [np.nan_to_num(each.change) for each in effects]
    down = sum(np.minimum(each.min(axis=0), 0.0) for each in changes)
    up = sum(np.maximum(each.max(axis=0), 0.0) for each in changes)
    return np.stack([down, up], axis=1)


def corner_shares(slopes: Array, nominal: Array) -> Array:
    """Shares (2, sources) of two opposite corners, in the direction in which most numbers change
    together; as far out as the 95 % range of equally important tolerances.

    ``slopes`` (numbers, sources): change from end to end, over the largest change of a number.
    """
    direction = np.ones(slopes.shape[1])
    if len(slopes):
        direction = np.linalg.svd(slopes, full_matrices=False)[2][0]
    offset = min(1.0, HALF_RANGE / math.sqrt(slopes.shape[1])) * np.where(
        direction >= 0.0, 1.0, -1.0
    )
    return np.array([_off(nominal, sign * offset) for sign in (1.0, -1.0)])


def _off(nominal: Array, offset: Array) -> Array:
    return np.where(offset > 0.0, nominal + offset * (1.0 - nominal), nominal * (1.0 + offset))


def _points(count: int) -> Array:
    """Quasi-random shares (POINTS, count) of a Sobol sequence, always the same."""
    from scipy.stats import qmc

    return np.asarray(qmc.Sobol(count, rng=0).random(POINTS))
