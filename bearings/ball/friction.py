"""How much gyroscopic moment the races of a ball hold by friction.

A race holds λ Mg only up to μ D Q. Where a hypothesis asks for more, the ball pivots on the race
that slips: its moment is what the races hold, and its axis is taken to yield in the same ratio
(tan β falls with Mg). A ball whose inner share does not vanish with its load then fades out of
contact instead of being thrown off. Plain expressions of floats or arrays, which compile as they
stand.
"""

from __future__ import annotations

from bearings.ball.plane import Polar, combined, times, where
from bearings.ball.race import Contact

FAR = 1e300  # N·m: a race without a share of the moment never slips


def limited(
    moment: Polar, attitude: Polar, share: Polar, inner: Contact, outer: Contact, limit: float
) -> tuple[Polar, Polar]:
    """Moment and tan β with which neither race carries more than ``limit`` · Q of the moment.

    ``moment``, ``attitude``: as the hypothesis has them; ``share``: λi; ``limit`` μ D [m].
    """
    hold = _held(share, inner, outer, limit)
    side = where(moment.value < 0.0, -1.0, 1.0)
    slips = side * moment.value > hold.value
    wanted = where(slips, side * moment.value, 1.0)
    part = where(slips, hold.value / wanted, 1.0)
    one = where(slips, 1.0, 0.0) / wanted
    held = Polar(part, combined(one, hold.by, -one * part * side, moment.by))
    return times(held, moment), times(held, attitude)


def _held(share: Polar, inner: Contact, outer: Contact, limit: float) -> Polar:
    """Largest moment that both races hold, min(μ D Qi/λi, μ D Qo/λo)."""
    li, lo = share.value, 2.0 - share.value
    one_i, one_o = where(li > 0.0, li, 1.0), where(lo > 0.0, lo, 1.0)
    can_i, can_o = limit * inner.load / one_i, limit * outer.load / one_o
    first = where(li > 0.0, can_i, FAR) < where(lo > 0.0, can_o, FAR)
    can = where(first, can_i, can_o)
    change = where(first, -1.0 / one_i, 1.0 / one_o) * can
    by_inner = where(first, limit * inner.slope / one_i, 0.0) + change * share.by[1]
    by_outer = where(first, 0.0, limit * outer.slope / one_o) + change * share.by[3]
    return Polar(can, (0.0, by_inner, 0.0, by_outer))
