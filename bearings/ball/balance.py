"""One ball between its grooves: its balance, its forces on the inner ring, and all derivatives.

The law of a ball over its contacts, whatever the kind of bearing (with Fc fixed, and at rest:
``bearings.ball.potential``): the contacts of each race have a resultant (``bearings.ball.race``),
directions and loads of the resultants give Fc and Mg. Plain expressions of floats or arrays (any
shape), which compile as they are: ``where`` distinguishes cases between balls. Plane vectors are
(axial, radial); X is the ball centre, A the middle of the inner groove (with the tilt of the ring
there as its third part), both relative to the middle of the outer groove.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from bearings.ball.condensed import Condensed, Forces
from bearings.ball.friction import limited
from bearings.ball.kinematics import Angles, Partial, Rolling, inner_share, orbit_and_spin, tan_beta
from bearings.ball.law import LawNumbers
from bearings.ball.plane import (
    Motion,
    Pair,
    Polar,
    combined,
    exchanged,
    less_by,
    more_by,
    plus,
    scaled,
    times,
    where,
)
from bearings.ball.potential import both_grooves, resting_reaction
from bearings.ball.race import Contact, Race, against, by_groove, facing, race
from bearings.geometry import Geometry


class Balance(NamedTuple):
    """Linearised balance of a ball at given A and X.

    ``forces`` on the ball and on the ring; loads [N] and directions (sin, cos) of the races'
    resultants, Fc [N], Mg [N·m], and λi.
    """

    forces: Forces
    inner_load: Any
    outer_load: Any
    inner_direction: Pair
    outer_direction: Pair
    centrifugal_force: Any
    gyroscopic_moment: Any
    inner_share: Any


class Rolled(NamedTuple):
    """Forces of a rolling ball on its inner ring (``axial``, ``radial``; ``turning``: moment by
    friction) and its residual forces (``level`` axial, ``rise`` radial), by the races."""

    inner: Race
    outer: Race
    axial: Polar
    radial: Polar
    turning: Polar
    level: Polar
    rise: Polar
    centrifugal_force: Any
    gyroscopic_moment: Any
    inner_share: Any


class Moving(NamedTuple):
    """A value with its derivatives by X and by A."""

    value: Any
    by_ball: Pair
    by_centre: Motion


def turning_balance(
    c: Geometry,
    law: LawNumbers,
    centre: Motion,
    ball: Pair,
    squared: Any,
    blend: Any,
    vary: float,
) -> Balance:
    """Balance of a ball on a turning ring (theory: one ball).

    ``centre``: A, with the tilt of the ring where it has two grooves; ``ball``: X; ``law``:
    which hypotheses of motion and sharing hold. ``squared`` ω² [rad²/s²]; ``blend`` t in [0, 1]
    leads from the convex problem (Mg = 0, Fc at the nominal angle) to the full one; ``vary`` 1,
    or 0 for derivatives that leave Fc and Mg as they are.
    """
    r = _rolled(c, law, centre, ball, squared, blend, vary)
    inner, outer = r.inner, r.outer
    axial, radial = _moving(r.axial, inner, outer), _moving(r.radial, inner, outer)
    tilting = _about_the_middle(inner, radial, _moving(r.turning, inner, outer))
    level, rise = _moving(r.level, inner, outer), _moving(r.rise, inner, outer)
    forces = Forces(
        residual=(level.value, rise.value),
        residual_by_ball=(level.by_ball, rise.by_ball),
        residual_by_centre=(level.by_centre, rise.by_centre),
        action=(axial.value, radial.value, tilting.value),
        action_by_ball=(axial.by_ball, radial.by_ball, tilting.by_ball),
        action_by_centre=(axial.by_centre, radial.by_centre, tilting.by_centre),
    )
    return Balance(
        forces=forces,
        inner_load=inner.load,
        outer_load=outer.load,
        inner_direction=(inner.sin, inner.cos),
        outer_direction=(outer.sin, outer.cos),
        centrifugal_force=r.centrifugal_force,
        gyroscopic_moment=r.gyroscopic_moment,
        inner_share=r.inner_share,
    )


def _rolled(
    c: Geometry,
    law: LawNumbers,
    centre: Motion,
    ball: Pair,
    squared: Any,
    blend: Any,
    vary: float,
) -> Rolled:
    """Compute both races and the forces they exert on a ball that rolls between them."""
    inner = race(c.inner_grooves, against(centre, ball), 1.0)
    outer = race(c.outer_grooves, ball, -1.0)
    si, ci, so, co = inner.sin, inner.cos, outer.sin, outer.cos
    weight = _weight(c.race_ratio, inner.approach, outer.approach)
    angles = Angles(si, ci, so, co, c.size_ratio, weight.value)
    share = _share(inner_share(law.sharing, weight.value), weight)
    inertia = blend * c.ball_inertia * squared  # Mg over (ωm/ω) (ωR/ω) sin β
    rolls = where(inner.approach > 0.0, 1.0, 0.0)
    attitude = _attitude(tan_beta(law.kinematics, angles), weight, rolls)
    orbit, spin = orbit_and_spin(angles, attitude.value)
    moment = _chained(inertia * spin.value, inertia, spin, attitude)
    loads = Contact(inner.load, inner.slope), Contact(outer.load, outer.slope)
    if law.friction > 0.0:
        limit = law.friction * c.ball_diameter
        moment, attitude = limited(moment, attitude, share, loads[0], loads[1], limit)
        orbit = orbit_and_spin(angles, attitude.value)[0]
    full = c.orbital_factor * squared
    centrifugal_force = full * (
        c.nominal_orbit_ratio_squared + blend * (orbit.value**2 - c.nominal_orbit_ratio_squared)
    )
    fc = _chained(centrifugal_force, 2.0 * vary * blend * full * orbit.value, orbit, attitude)
    ti = scaled(vary, 1.0 / c.ball_diameter, times(share, moment))
    to = less_by(scaled(vary, 2.0 / c.ball_diameter, moment), ti)

    fa, fr = _inner_force(loads[0], ti, si, ci)
    ga, gr = _outer_force(loads[1], to, so, co)
    turning = scaled(1.0, c.inner_conformity * c.ball_diameter, ti)
    return Rolled(
        inner=inner,
        outer=outer,
        axial=fa,
        radial=fr,
        turning=turning,
        level=less_by(fa, ga),
        rise=more_by(less_by(fr, gr), fc),
        centrifugal_force=fc.value,
        gyroscopic_moment=moment.value,
        inner_share=share.value,
    )


def by_grooves(
    c: Geometry,
    law: LawNumbers,
    centre: Motion,
    ball: Pair,
    squared: Any,
    blend: Any,
    vary: float,
) -> tuple[tuple[tuple[Pair, ...], tuple[Pair, ...]], ...]:
    """Derivatives of the forces on a ball between two grooves a ring (two rows) and of its action
    on the ring (three rows) by a shift of the groove of each contact, in their order.

    Arguments as for ``turning_balance``.
    """
    r = _rolled(c, law, centre, ball, squared, blend, vary)
    zero = (0.0, 0.0)
    fixed_inner = r.inner._replace(angle_by=zero, approach_by=zero, middle_by=zero)
    fixed_outer = r.outer._replace(angle_by=zero, approach_by=zero, middle_by=zero)
    pairs = [
        (shifted, fixed_outer) for shifted in by_groove(c.inner_grooves, against(centre, ball), 1.0)
    ]
    pairs += [(fixed_inner, shifted) for shifted in by_groove(c.outer_grooves, ball, -1.0)]
    derivatives = []
    for inner, outer in pairs:
        # A shift of an inner groove leads away from the ball, one of an outer groove towards it.
        side = -1.0 if inner is fixed_inner else 1.0
        level, rise, axial, radial, turning = (
            _by_vectors(part, inner, outer, side)
            for part in (r.level, r.rise, r.axial, r.radial, r.turning)
        )
        middle = combined(r.inner.middle, radial, r.radial.value, inner.middle_by)
        derivatives.append(((level, rise), (axial, radial, plus(turning, middle))))
    return tuple(derivatives)


def _by_vectors(p: Polar, inner: Race, outer: Race, side: float) -> Pair:
    """Derivative of a value by a shift of a groove, through the derivatives of both races."""
    by_inner = combined(p.by[0], inner.angle_by, p.by[1], inner.approach_by)
    by_outer = combined(p.by[2], outer.angle_by, p.by[3], outer.approach_by)
    return side * (by_inner[0] + by_outer[0]), side * (by_inner[1] + by_outer[1])


def _about_the_middle(inner: Race, radial: Moving, tilting: Moving) -> Moving:
    """Add the moment of the radial force, which acts off the middle of the two grooves."""
    by, middle, force = inner.middle_by, inner.middle, radial.value
    if len(by) == 2:
        return tilting
    by_ball = combined(middle, radial.by_ball, -force, (by[0], by[1]))
    by_centre = combined(middle, radial.by_centre, force, by)
    return Moving(
        tilting.value + middle * force,
        plus(tilting.by_ball, by_ball),
        plus(tilting.by_centre, by_centre),
    )


def resting_balance(c: Geometry, centre: Motion) -> tuple[Balance, Condensed]:
    """Balance of balls at rest, and the same with the balls eliminated, in closed form."""
    eliminated = resting_reaction(c, centre)[1]
    sin, cos, _, _ = facing(both_grooves(c), centre)
    load = np.hypot(eliminated.action[0], eliminated.action[1])
    zero = np.zeros_like(load)
    zeros = (zero, zero)
    forces = Forces(
        residual=zeros,
        residual_by_ball=((zero + 1.0, zero), (zero, zero + 1.0)),
        residual_by_centre=eliminated.follow,
        action=eliminated.action,
        action_by_ball=(zeros, zeros, zeros),
        action_by_centre=eliminated.tangent,
    )
    direction = (sin, cos)
    return Balance(forces, load, load, direction, direction, zero, zero, zero + 1.0), eliminated


def _weight(ratio: float, di: Any, do: Any) -> Polar:
    """Weight C of the races, c (δi/δo)²; meaningless where the outer race is free."""
    deep = where(do > 0.0, do, 1.0)
    slope = ratio * di / (deep * deep)
    return Polar(slope * di, (0.0, 2.0 * slope, 0.0, -2.0 * slope * di / deep))


def _share(share: tuple[Any, Any], weight: Polar) -> Polar:
    """λi with its derivatives, from its value and its slope by the weight."""
    return Polar(share[0], (0.0, share[1] * weight.by[1], 0.0, share[1] * weight.by[3]))


def _attitude(beta: Partial, weight: Polar, rolls: Any) -> Polar:
    """tan β of the rotation axis of a ball; 0 for a ball on the outer race alone."""
    by_weight = beta.by_weight * rolls
    by_inner, by_outer = by_weight * weight.by[1], by_weight * weight.by[3]
    by = (beta.by_inner * rolls, by_inner, beta.by_outer * rolls, by_outer)
    return Polar(beta.value * rolls, by)


def _chained(value: Any, factor: Any, rolling: Rolling, attitude: Polar) -> Polar:
    """Value whose derivatives are ``factor`` times those of a rolling ratio (chain rule)."""
    by_attitude, by = factor * rolling.by_attitude, attitude.by
    by_inner = factor * rolling.by_inner + by_attitude * by[0]
    by_outer = factor * rolling.by_outer + by_attitude * by[2]
    return Polar(value, (by_inner, by_attitude * by[1], by_outer, by_attitude * by[3]))


def _inner_force(contact: Contact, friction: Polar, sin: Any, cos: Any) -> tuple[Polar, Polar]:
    """Axial and radial force of ball and inner ring on each other."""
    axial = contact.load * sin + friction.value * cos
    radial = contact.load * cos - friction.value * sin
    k, (a, b, c, d) = contact.slope, friction.by
    return (
        Polar(axial, (radial + a * cos, k * sin + b * cos, c * cos, d * cos)),
        Polar(radial, (-axial - a * sin, k * cos - b * sin, -c * sin, -d * sin)),
    )


def _outer_force(contact: Contact, friction: Polar, sin: Any, cos: Any) -> tuple[Polar, Polar]:
    """Axial and radial force of ball and outer ring on each other."""
    axial, radial = _inner_force(contact, exchanged(friction), sin, cos)
    return exchanged(axial), exchanged(radial)


def _moving(p: Polar, inner: Race, outer: Race) -> Moving:
    """Value with derivatives by the motions of ball and inner groove, through both races."""
    by_centre = combined(p.by[0], inner.angle_by, p.by[1], inner.approach_by)
    a, b = outer.angle_by, outer.approach_by
    by_ball = (
        p.by[2] * a[0] + p.by[3] * b[0] - by_centre[0],
        p.by[2] * a[1] + p.by[3] * b[1] - by_centre[1],
    )
    return Moving(p.value, by_ball, by_centre)
