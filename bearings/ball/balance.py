"""One ball between its grooves: its balance, what it does to the inner ring, and all derivatives.

The one law of a ball over its contacts, whatever the kind of bearing: the contacts of each race
make a resultant (``bearings.ball.race``), directions and loads of the resultants make Fc and Mg.
Plain expressions of floats or arrays (any shape), which compile as they stand: choices between
balls are made by ``where``. Plane vectors are (axial, radial); X is the ball centre, A the middle
of the inner groove (with the tilt of the ring there as its third part), both seen from the middle
of the outer groove.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from bearings.ball.constants import BallConstants
from bearings.ball.friction import limited
from bearings.ball.kinematics import Angles, Partial, Rolling, inner_share, orbit_and_spin, tan_beta
from bearings.ball.plane import (
    Block,
    Pair,
    Triple,
    determinant,
    dot,
    inverse,
    plus,
    row_times,
    where,
)
from bearings.ball.polar import Polar, less_by, more_by, scaled, times
from bearings.ball.race import Contact, Race, race


class LawNumbers(NamedTuple):
    """What is assumed of a ball, by numbers.

    ``kinematics`` in ``HYPOTHESES``, ``sharing`` in ``SHARINGS``; ``limited``: friction is.
    """

    kinematics: int
    sharing: int
    limited: bool


class Balance(NamedTuple):
    """State of a ball at given A and X, linearised.

    ``residual`` [N]: sum of forces on the ball. ``action`` of the shaft on the ring through this
    ball: axial force, radial force [N], and the moment [N·m] that turns the ring at the ball about
    the middle of its groove. ``…_by_ball``, ``…_by_centre``: derivatives by X and by A, row by row.
    Loads [N] and directions (sin, cos) of the races' resultants, Fc [N], Mg [N·m], and λi.
    """

    residual: Pair
    residual_by_ball: Block
    residual_by_centre: tuple[Triple, Triple]
    action: Triple
    action_by_ball: tuple[Pair, Pair, Pair]
    action_by_centre: tuple[Triple, Triple, Triple]
    inner_load: Any
    outer_load: Any
    inner_direction: Pair
    outer_direction: Pair
    centrifugal_force: Any
    gyroscopic_moment: Any
    inner_share: Any


class Settled(NamedTuple):
    """What a balance says of a ball that follows the ring.

    ``fold``: determinant of the balance by X, positive on the physical branch. X moves by
    ``still`` + ``follow`` · ΔA; the action there is ``action`` + ``tangent`` · ΔA.
    """

    fold: Any
    still: Pair
    follow: tuple[Triple, Triple]
    action: Triple
    tangent: tuple[Triple, Triple, Triple]


def turning_balance(
    c: BallConstants,
    law: LawNumbers,
    centre: Triple,
    ball: Pair,
    squared: Any,
    blend: Any,
    vary: float,
) -> Balance:
    """Balance of a ball on a turning ring (theory: one ball).

    ``squared`` ω² [rad²/s²]; ``blend`` t in [0, 1] leads from the convex problem (Mg = 0, Fc at the
    nominal angle) to the full one; ``vary`` 1, or 0 for derivatives that leave Fc and Mg as they
    are.
    """
    inner = race(c.inner, (centre[0] - ball[0], centre[1] - ball[1]), centre[2], 1.0)
    outer = race(c.outer, ball, 0.0, -1.0)
    si, ci, so, co = inner.sin, inner.cos, outer.sin, outer.cos
    weight = _weight(c.race_ratio, inner.approach, outer.approach)
    angles = Angles(si, ci, so, co, c.size_ratio, weight.value)
    share = _share(inner_share(law.sharing, weight.value), weight)
    turn = blend * c.ball_inertia * squared
    rolls = where(inner.approach > 0.0, 1.0, 0.0)
    tilt = _tilt(tan_beta(law.kinematics, angles), weight, rolls)
    orbit, spin = orbit_and_spin(angles, tilt.value)
    moment = _chained(turn * spin.value, turn, spin, tilt)
    loads = Contact(inner.load, inner.slope), Contact(outer.load, outer.slope)
    if law.limited:
        moment, tilt = limited(moment, tilt, share, loads[0], loads[1], c.limit)
        orbit = orbit_and_spin(angles, tilt.value)[0]
    full = c.orbit * squared
    push = full * (c.nominal + blend * (orbit.value**2 - c.nominal))
    fc = _chained(push, 2.0 * vary * blend * full * orbit.value, orbit, tilt)
    ti = scaled(vary, 1.0 / c.ball_diameter, times(share, moment))
    to = less_by(scaled(vary, 2.0 / c.ball_diameter, moment), ti)

    fa, fr = _inner_force(loads[0], ti, si, ci)
    ga, gr = _outer_force(loads[1], to, so, co)
    turning = scaled(1.0, c.inner_conformity * c.ball_diameter, ti)
    level, rise = less_by(fa, ga), more_by(less_by(fr, gr), fc)
    level_i, rise_i = _by_inner(level, inner), _by_inner(rise, inner)
    fa_i, fr_i, turning_i = _by_inner(fa, inner), _by_inner(fr, inner), _by_inner(turning, inner)
    fr_o = _by_outer(fr, outer)
    action = (fa.value, fr.value, turning.value)
    action_by_ball = (
        _by_ball(_by_outer(fa, outer), fa_i),
        _by_ball(fr_o, fr_i),
        _by_ball(_by_outer(turning, outer), turning_i),
    )
    action_by_centre = (fa_i, fr_i, turning_i)
    if len(c.inner) > 1:
        action, action_by_ball, action_by_centre = _about_the_middle(
            inner, action, action_by_ball, action_by_centre
        )
    return Balance(
        residual=(level.value, rise.value),
        residual_by_ball=(
            _by_ball(_by_outer(level, outer), level_i),
            _by_ball(_by_outer(rise, outer), rise_i),
        ),
        residual_by_centre=(level_i, rise_i),
        action=action,
        action_by_ball=action_by_ball,
        action_by_centre=action_by_centre,
        inner_load=inner.load,
        outer_load=outer.load,
        inner_direction=(si, ci),
        outer_direction=(so, co),
        centrifugal_force=fc.value,
        gyroscopic_moment=moment.value,
        inner_share=share.value,
    )


def _about_the_middle(
    inner: Race,
    action: Triple,
    by_ball: tuple[Pair, Pair, Pair],
    by_centre: tuple[Triple, Triple, Triple],
) -> tuple[Triple, tuple[Pair, Pair, Pair], tuple[Triple, Triple, Triple]]:
    """The moment of the radial force, which acts beside the middle of the groove, added."""
    middle, radial = inner.middle, action[1]
    m1, m2, mt = inner.middle_by
    (r1, r2), (c1, c2, ct) = by_ball[1], by_centre[1]
    (b1, b2), (d1, d2, dt) = by_ball[2], by_centre[2]
    ball = (b1 + middle * r1 - radial * m1, b2 + middle * r2 - radial * m2)
    centre = (
        d1 + middle * c1 + radial * m1,
        d2 + middle * c2 + radial * m2,
        dt + middle * ct + radial * mt,
    )
    return (
        (action[0], radial, action[2] + middle * radial),
        (by_ball[0], by_ball[1], ball),
        (by_centre[0], by_centre[1], centre),
    )


def settled(b: Balance) -> Settled:
    """The ball eliminated: what is left is a ring on springs."""
    back = inverse(b.residual_by_ball)
    back = ((-back[0][0], -back[0][1]), (-back[1][0], -back[1][1]))
    columns = b.residual_by_centre
    still = (dot(back[0], b.residual), dot(back[1], b.residual))
    follow = (row_times(back[0], columns), row_times(back[1], columns))
    axial, radial, lever = b.action_by_ball
    return Settled(
        fold=determinant(b.residual_by_ball),
        still=still,
        follow=follow,
        action=(
            b.action[0] + dot(axial, still),
            b.action[1] + dot(radial, still),
            b.action[2] + dot(lever, still),
        ),
        tangent=(
            plus(b.action_by_centre[0], row_times(axial, follow)),
            plus(b.action_by_centre[1], row_times(radial, follow)),
            plus(b.action_by_centre[2], row_times(lever, follow)),
        ),
    )


def _weight(ratio: float, di: Any, do: Any) -> Polar:
    """C of the races, c (δi/δo)²; without meaning where the outer race is free."""
    deep = where(do > 0.0, do, 1.0)
    slope = ratio * di / (deep * deep)
    return Polar(slope * di, 0.0, 2.0 * slope, 0.0, -2.0 * slope * di / deep)


def _share(law: tuple[Any, Any], weight: Polar) -> Polar:
    """λi, which depends on the weight alone."""
    by_length = law[1] * weight.by_inner_length
    return Polar(law[0], 0.0, by_length, 0.0, law[1] * weight.by_outer_length)


def _tilt(law: Partial, weight: Polar, rolls: Any) -> Polar:
    """tan β, 0 of a ball that rides the outer race alone."""
    return Polar(
        law.value * rolls,
        law.by_inner * rolls,
        law.by_weight * weight.by_inner_length * rolls,
        law.by_outer * rolls,
        law.by_weight * weight.by_outer_length * rolls,
    )


def _chained(value: Any, factor: Any, rolling: Rolling, tilt: Polar) -> Polar:
    """A value that changes by ``factor`` times a rolling ratio."""
    by_tilt = factor * rolling.by_tilt
    return Polar(
        value,
        factor * rolling.by_inner + by_tilt * tilt.by_inner_angle,
        by_tilt * tilt.by_inner_length,
        factor * rolling.by_outer + by_tilt * tilt.by_outer_angle,
        by_tilt * tilt.by_outer_length,
    )


def _inner_force(contact: Contact, friction: Polar, sin: Any, cos: Any) -> tuple[Polar, Polar]:
    """Axial and radial force of ball and inner ring on each other."""
    axial = contact.load * sin + friction.value * cos
    radial = contact.load * cos - friction.value * sin
    return (
        Polar(
            axial,
            radial + friction.by_inner_angle * cos,
            contact.slope * sin + friction.by_inner_length * cos,
            friction.by_outer_angle * cos,
            friction.by_outer_length * cos,
        ),
        Polar(
            radial,
            -axial - friction.by_inner_angle * sin,
            contact.slope * cos - friction.by_inner_length * sin,
            -friction.by_outer_angle * sin,
            -friction.by_outer_length * sin,
        ),
    )


def _outer_force(contact: Contact, friction: Polar, sin: Any, cos: Any) -> tuple[Polar, Polar]:
    """Axial and radial force of ball and outer ring on each other."""
    axial = contact.load * sin + friction.value * cos
    radial = contact.load * cos - friction.value * sin
    return (
        Polar(
            axial,
            friction.by_inner_angle * cos,
            friction.by_inner_length * cos,
            radial + friction.by_outer_angle * cos,
            contact.slope * sin + friction.by_outer_length * cos,
        ),
        Polar(
            radial,
            -friction.by_inner_angle * sin,
            -friction.by_inner_length * sin,
            -axial - friction.by_outer_angle * sin,
            contact.slope * cos - friction.by_outer_length * sin,
        ),
    )


def _by_inner(p: Polar, inner: Race) -> Triple:
    """Derivatives by A."""
    a, b = inner.angle_by, inner.approach_by
    turn, along = p.by_inner_angle, p.by_inner_length
    return turn * a[0] + along * b[0], turn * a[1] + along * b[1], turn * a[2] + along * b[2]


def _by_outer(p: Polar, outer: Race) -> Pair:
    """Derivatives by X through the outer race alone."""
    a, b = outer.angle_by, outer.approach_by
    turn, along = p.by_outer_angle, p.by_outer_length
    return turn * a[0] + along * b[0], turn * a[1] + along * b[1]


def _by_ball(outer: Pair, inner: Triple) -> Pair:
    """Derivatives by X through both races."""
    return outer[0] - inner[0], outer[1] - inner[1]
