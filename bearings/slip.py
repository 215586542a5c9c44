"""How far friction lets a ball's axis follow the hypothesis of its kinematics.

A race holds the gyroscopic moment only by friction: λ Mg ≤ μ D Q. Where a hypothesis asks for more,
the ball pivots on the race that slips, and its axis yields (tan β falls) until its moment is what
the races hold. Plain expressions of floats or arrays, which compile as they stand.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from bearings.kinematics import Angles, orbit_and_spin
from bearings.plane import where

FAR = 1e300  # a race without a share of the moment never slips


class Polar(NamedTuple):
    """A value with its derivatives by αi, ℓi, αo and ℓo."""

    value: Any
    by_inner_angle: Any
    by_inner_length: Any
    by_outer_angle: Any
    by_outer_length: Any


class Contact(NamedTuple):
    """Load of a contact and its slope by the distance of the centres."""

    load: Any
    slope: Any


def limited(
    a: Angles, tilt: Polar, share: Polar, inner: Contact, outer: Contact, moment: Any, limit: float
) -> Polar:
    """tan β with which neither race carries more than ``limit`` · Q of the moment.

    ``share``: λi; ``moment``: Mg over the spin of ``orbit_and_spin`` [N·m]; ``limit`` μ D [m].
    """
    hold = _held(share, inner, outer, limit)
    wanted = moment * orbit_and_spin(a, tilt.value)[1].value
    slips = np.abs(wanted) > hold.value
    side = where(wanted < 0.0, -1.0, 1.0)
    part = where(slips, side, 0.0) / where(slips, moment, 1.0)
    t = side * tilt_of(a, side, hold.value * np.abs(part))
    rate = orbit_and_spin(a, t)[1]
    below = where(slips, rate.by_tilt, 1.0)
    return Polar(
        where(slips, t, tilt.value),
        where(slips, -rate.by_inner / below, tilt.by_inner_angle),
        where(slips, part * hold.by_inner_length / below, tilt.by_inner_length),
        where(slips, -rate.by_outer / below, tilt.by_outer_angle),
        where(slips, part * hold.by_outer_length / below, tilt.by_outer_length),
    )


def _held(share: Polar, inner: Contact, outer: Contact, limit: float) -> Polar:
    """Largest moment that both races hold, min(μ D Qi/λi, μ D Qo/λo)."""
    li, lo = share.value, 2.0 - share.value
    one_i, one_o = where(li > 0.0, li, 1.0), where(lo > 0.0, lo, 1.0)
    can_i, can_o = limit * inner.load / one_i, limit * outer.load / one_o
    first = where(li > 0.0, can_i, FAR) < where(lo > 0.0, can_o, FAR)
    can = where(first, can_i, can_o)
    change = where(first, -1.0 / one_i, 1.0 / one_o) * can
    return Polar(
        can,
        0.0,
        where(first, limit * inner.slope / one_i, 0.0) + change * share.by_inner_length,
        0.0,
        where(first, 0.0, limit * outer.slope / one_o) + change * share.by_outer_length,
    )


def tilt_of(a: Angles, side: Any, spin: Any) -> Any:
    """|tan β| at which (ωm/ω) |ωR/ω| sin β is ``spin`` ≥ 0 in size: a quadratic equation."""
    gap_o, gap_i = 1.0 + a.gamma * a.cos_o, 1.0 - a.gamma * a.cos_i
    outer, outer_t = a.cos_o / gap_o, side * a.sin_o / gap_o
    both, both_t = outer + a.cos_i / gap_i, outer_t + side * a.sin_i / gap_i
    m = spin * a.gamma
    square, line = outer_t - m * both_t**2, outer - 2.0 * m * both * both_t
    root = np.sqrt(np.maximum(line**2 + 4.0 * square * m * both**2, 0.0))
    return 2.0 * m * both**2 / (line + root)
