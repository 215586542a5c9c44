"""One ball between two grooves: its balance, what it does to the inner ring, and all derivatives.

Plain expressions of floats or arrays (any shape), which compile as they stand: choices between
balls are made by ``where``. Plane vectors are (axial, radial); A is the inner groove
centre and X the ball centre, both seen from the outer groove centre.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from bearings.ball.constants import BallConstants
from bearings.ball.friction import Contact, limited
from bearings.ball.kinematics import Angles, Partial, Rolling, inner_share, orbit_and_spin, tan_beta
from bearings.ball.plane import (
    Block,
    Pair,
    determinant,
    direction,
    dot,
    inverse,
    less,
    plus,
    row_times,
    where,
)
from bearings.ball.polar import Polar, combined, less_by, more_by, scaled, times


class LawNumbers(NamedTuple):
    """What is assumed of a ball, by numbers.

    ``kinematics`` in ``HYPOTHESES``, ``sharing`` in ``SHARINGS``; ``limited``: friction is.
    """

    kinematics: int
    sharing: int
    limited: bool


class Balance(NamedTuple):
    """State of a ball at given A and X, linearised.

    ``residual`` [N]: sum of forces on the ball. ``action``: axial force, radial force [N] and
    moment [N·m] of the shaft on the ring through this ball. ``…_by_ball`` and ``…_by_centre``:
    their derivatives by X and by A, row by row. Loads [N] and directions (sin, cos) of the
    contacts, Fc [N], Mg [N·m], and λi.
    """

    residual: Pair
    residual_by_ball: Block
    residual_by_centre: Block
    action: tuple[Any, Any, Any]
    action_by_ball: tuple[Pair, Pair, Pair]
    action_by_centre: tuple[Pair, Pair, Pair]
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
    follow: Block
    action: tuple[Any, Any, Any]
    tangent: tuple[Pair, Pair, Pair]


def turning_balance(
    c: BallConstants,
    law: LawNumbers,
    centre: Pair,
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
    si, ci, li = direction(less(centre, ball))
    so, co, lo = direction(ball)
    di, do = np.maximum(li - c.inner_reach, 0.0), np.maximum(lo - c.outer_reach, 0.0)
    inner, outer = hertz(c.inner_stiffness, di), hertz(c.outer_stiffness, do)
    weight = _weight(c.race_ratio, di, do)
    angles = Angles(si, ci, so, co, c.size_ratio, weight.value)
    share = _share(inner_share(law.sharing, weight.value), weight)
    turn = blend * c.ball_inertia * squared
    tilt = _tilt(tan_beta(law.kinematics, angles), weight, where(di > 0.0, 1.0, 0.0))
    orbit, spin = orbit_and_spin(angles, tilt.value)
    moment = _chained(turn * spin.value, turn, spin, tilt)
    if law.limited:
        moment, tilt = limited(moment, tilt, share, inner, outer, c.limit)
        orbit = orbit_and_spin(angles, tilt.value)[0]
    full = c.orbit * squared
    push = full * (c.nominal + blend * (orbit.value**2 - c.nominal))
    fc = _chained(push, 2.0 * vary * blend * full * orbit.value, orbit, tilt)
    ti = scaled(vary, 1.0 / c.ball_diameter, times(share, moment))
    to = less_by(scaled(vary, 2.0 / c.ball_diameter, moment), ti)

    fa, fr = _inner_force(inner, ti, si, ci)
    ga, gr = _outer_force(outer, to, so, co)
    lever = combined(c.centre_radius, fa, -c.inner_conformity * c.ball_diameter, ti)
    level, rise = less_by(fa, ga), more_by(less_by(fr, gr), fc)
    level_i, rise_i = _by_inner(level, si, ci, li), _by_inner(rise, si, ci, li)
    fa_i, fr_i = _by_inner(fa, si, ci, li), _by_inner(fr, si, ci, li)
    lever_i = _by_inner(lever, si, ci, li)
    return Balance(
        residual=(level.value, rise.value),
        residual_by_ball=(
            less(_by_outer(level, so, co, lo), level_i),
            less(_by_outer(rise, so, co, lo), rise_i),
        ),
        residual_by_centre=(level_i, rise_i),
        action=(fa.value, fr.value, lever.value),
        action_by_ball=(
            less(_by_outer(fa, so, co, lo), fa_i),
            less(_by_outer(fr, so, co, lo), fr_i),
            less(_by_outer(lever, so, co, lo), lever_i),
        ),
        action_by_centre=(fa_i, fr_i, lever_i),
        inner_load=inner.load,
        outer_load=outer.load,
        inner_direction=(si, ci),
        outer_direction=(so, co),
        centrifugal_force=fc.value,
        gyroscopic_moment=moment.value,
        inner_share=share.value,
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


def hertz(stiffness: float, approach: Any) -> Contact:
    """k δ^1.5 and its slope, δ ≥ 0."""
    root = np.sqrt(approach)
    return Contact(stiffness * approach * root, 1.5 * stiffness * root)


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


def _by_inner(p: Polar, sin: Any, cos: Any, length: Any) -> Pair:
    """Derivatives by A − X."""
    turn = p.by_inner_angle / length
    return turn * cos + p.by_inner_length * sin, p.by_inner_length * cos - turn * sin


def _by_outer(p: Polar, sin: Any, cos: Any, length: Any) -> Pair:
    """Derivatives by X alone."""
    turn = p.by_outer_angle / length
    return turn * cos + p.by_outer_length * sin, p.by_outer_length * cos - turn * sin
