"""Axial laws of a bearing: load F(d) [N] of a deflection d [m], and its slope [N/m].

No law decreases. One for thrust in one direction is F = 0 up to its first kink and rises beyond,
one for both directions is odd; between two kinks they are smooth.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Protocol, cast

from scipy.optimize import brentq

FURTHEST = 1.0  # m, beyond any deflection of a bearing


class AxialLaw(Protocol):
    """Function of deflection that returns F and dF/dd; ``kinks`` [m], ascending: there is no load
    up to the first, and the slope jumps at all others."""

    @property
    def kinks(self) -> tuple[float, ...]: ...
    def __call__(self, d: float) -> tuple[float, float]: ...


@dataclass(frozen=True, slots=True)
class Power:
    """F = k d^p; p = 1 is the linear bearing."""

    k: float
    p: float
    kinks: tuple[float, ...] = (0.0,)

    def __call__(self, d: float) -> tuple[float, float]:
        """F [N] and its slope [N/m]."""
        if d <= 0.0:
            return 0.0, 0.0
        force = self.k * d**self.p
        return force, self.p * force / d


@dataclass(frozen=True, slots=True)
class RestBall:
    """Angular-contact bearing at rest: ``balls`` of stiffness ``k`` [N/m^1.5] over both contacts.

    ``distance``: of the groove centres, unloaded [m]; ``angle``: free contact angle [rad];
    ``growth``: radial, of the inner groove centre at rest [m].
    """

    balls: int
    k: float
    distance: float
    angle: float
    growth: float = 0.0
    kinks: tuple[float, ...] = (0.0,)

    def __call__(self, d: float) -> tuple[float, float]:
        """F [N] and its slope [N/m]."""
        bd = self.distance
        radial = bd * math.cos(self.angle) + self.growth
        free = math.sqrt(bd * bd - radial * radial)
        if d <= 0.0:
            return 0.0, 0.0
        axial = free + d
        length = math.hypot(radial, axial)
        pressed = d * (free + axial) / (length + bd)  # length - bd loses all digits of a small d
        share, load = axial / length, self.k * pressed**1.5
        steep = 1.5 * self.k * math.sqrt(pressed) * share**2
        return self.balls * load * share, self.balls * (steep + load * (1.0 - share**2) / length)


@dataclass(frozen=True, slots=True)
class Table:
    """Cubic pieces between ``breakpoints`` [m], each (d³, d², d, 1) from its left breakpoint.

    Beyond the last breakpoint the last slope continues; before the first one the first slope, down
    to zero load, or further where the load at that breakpoint is negative.
    """

    breakpoints: Sequence[float]
    pieces: Sequence[tuple[float, float, float, float]]
    kinks: tuple[float, ...]

    def __call__(self, d: float) -> tuple[float, float]:
        """F [N] and its slope [N/m]."""
        first, last = self.breakpoints[0], self.breakpoints[-1]
        if d < first:
            _, _, slope, start = self.pieces[0]
            force = start + slope * (d - first)
            return (force, slope) if force > 0.0 or start < 0.0 else (0.0, 0.0)
        if d >= last:
            force, slope = self._piece(len(self.pieces) - 1, last)
            return force + slope * (d - last), slope
        return self._piece(bisect_right(self.breakpoints, d) - 1, d)

    def _piece(self, k: int, d: float) -> tuple[float, float]:
        a, b, c, e = self.pieces[k]
        h = d - self.breakpoints[k]
        return ((a * h + b) * h + c) * h + e, (3.0 * a * h + 2.0 * b) * h + c


def table(d: Sequence[float], force: Sequence[float], *, cubic: bool = False) -> Table:
    """Build a law through points: straight lines, or a cubic spline (not-a-knot)."""
    from scipy.interpolate import CubicSpline

    if cubic:
        pieces = CubicSpline(d, force).c.T.tolist()
    else:
        ends = zip(d[:-1], d[1:], force[:-1], force[1:], strict=True)
        pieces = [(0.0, 0.0, (after - f) / (right - left), f) for left, right, f, after in ends]
    free = _free(d, force, pieces[0][2])
    inner = zip(d[1:-1], pairwise(pieces), strict=True)
    bent = [] if cubic else [at for at, (a, b) in inner if not math.isclose(a[2], b[2])]
    kinks = (free, *(at for at in bent if at > free))
    return Table(tuple(d), tuple(map(tuple, pieces)), kinks)


def sloped_table(d: Sequence[float], force: Sequence[float], slope: Sequence[float]) -> Table:
    """Build a law through points with given slopes, by cubic Hermite pieces."""
    from scipy.interpolate import CubicHermiteSpline

    pieces = CubicHermiteSpline(d, force, slope).c.T.tolist()
    return Table(tuple(d), tuple(map(tuple, pieces)), (_free(d, force, slope[0]),))


def _free(d: Sequence[float], force: Sequence[float], slope: float) -> float:
    """Deflection where load begins: the last point without load, or the zero of its first slope."""
    unloaded = [at for at, load in zip(d, force, strict=True) if load <= 0.0]
    if unloaded:
        return unloaded[-1]
    return d[0] - force[0] / slope if slope > 0.0 else -math.inf


@dataclass(frozen=True, slots=True)
class Blend:
    """Weighted sum of two laws: (1 − share) of ``old`` and ``share`` of ``new``."""

    old: AxialLaw
    new: AxialLaw
    share: float

    @property
    def kinks(self) -> tuple[float, ...]:
        """Kinks of both laws [m]."""
        return tuple(sorted({*self.old.kinks, *self.new.kinks}))

    def __call__(self, d: float) -> tuple[float, float]:
        """F [N] and its slope [N/m]."""
        (force, slope), (new_force, new_slope) = self.old(d), self.new(d)
        share = self.share
        return (1.0 - share) * force + share * new_force, (1.0 - share) * slope + share * new_slope


def deflection(law: AxialLaw, load: float) -> float:
    """Deflection [m] under ``load`` [N]; NaN where the law has no such load."""
    if isinstance(law, Power):
        return cast(float, (load / law.k) ** (1.0 / law.p))
    low = max(law.kinks[0], -FURTHEST)
    if law(low)[0] > load:
        return math.nan
    if load == 0.0:
        return low
    high = low + 1e-6
    while law(high)[0] < load:
        high = low + 2.0 * (high - low)
        if high - low > FURTHEST:
            return math.nan
    return cast(float, brentq(lambda d: law(d)[0] - load, low, high, xtol=1e-20, rtol=1e-15))
