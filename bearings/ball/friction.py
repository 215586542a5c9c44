"""Gyroscopic moment that the races of a ball can hold by friction.

A race holds λ Mg only up to μ D Q. Where a hypothesis requires more, the ball pivots on the race
that slips: its moment is the one that the races hold, and tan β is reduced in the same ratio
(tan β falls with Mg). A ball whose inner share does not vanish with its load then fades out of
contact instead of being thrown off. Plain expressions of floats or arrays, which compile as they
are.
"""

from __future__ import annotations

from bearings.ball.plane import Polar, combined, times, where
from bearings.ball.race import Contact

FAR = 1e300  # N·m: a race without a share of the moment never slips


def limited(
    moment: Polar, attitude: Polar, share: Polar, inner: Contact, outer: Contact, limit: float
) -> tuple[Polar, Polar]:
    """Limit moment and tan β so that neither race carries more than ``limit`` · Q of the moment.

    ``moment``, ``attitude``: those of the hypothesis; ``share``: λi; ``limit`` μ D [m].
    """
    capacity = _capacity(share, inner, outer, limit)
    side = where(moment.value < 0.0, -1.0, 1.0)
    slips = side * moment.value > capacity.value
    required = where(slips, side * moment.value, 1.0)
    fraction = where(slips, capacity.value / required, 1.0)
    inverse = where(slips, 1.0, 0.0) / required
    ratio = Polar(fraction, combined(inverse, capacity.by, -inverse * fraction * side, moment.by))
    return times(ratio, moment), times(ratio, attitude)


def _capacity(share: Polar, inner: Contact, outer: Contact, limit: float) -> Polar:
    """Largest moment that both races hold, min(μ D Qi/λi, μ D Qo/λo)."""
    li, lo = share.value, 2.0 - share.value
    share_i, share_o = where(li > 0.0, li, 1.0), where(lo > 0.0, lo, 1.0)
    capacity_i, capacity_o = limit * inner.load / share_i, limit * outer.load / share_o
    first = where(li > 0.0, capacity_i, FAR) < where(lo > 0.0, capacity_o, FAR)
    capacity = where(first, capacity_i, capacity_o)
    change = where(first, -1.0 / share_i, 1.0 / share_o) * capacity
    by_inner = where(first, limit * inner.slope / share_i, 0.0) + change * share.by[1]
    by_outer = where(first, 0.0, limit * outer.slope / share_o) + change * share.by[3]
    return Polar(capacity, (0.0, by_inner, 0.0, by_outer))
