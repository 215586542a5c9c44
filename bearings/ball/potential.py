"""The convex core of the ball problem: Hertzian contacts and a fixed centrifugal force.

Σ 0.4 k δ₊^2.5 − Fc X₂ over one to four contacts has one minimum over the ball centre X for every
place of the inner groove, and the minimum is convex in that place: a bearing assembled from it has
one equilibrium, reachable from anywhere. A ball at rest between one groove a ring has a closed
form. Plain expressions of floats or arrays, which compile as they are.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from bearings.ball.condensed import Condensed, Forces, condensed
from bearings.ball.plane import (
    EPS,
    Block,
    Motion,
    Pair,
    combined,
    direction,
    dot,
    inverse,
    where,
)
from bearings.ball.race import (
    Springs,
    against,
    facing,
    facing_radius,
    spring,
    springs,
    vector_to,
)
from bearings.geometry import Geometry, Groove

SEATED = 1e-8  # of the ball's own loads
LEAST_HOLD = 0.3  # of the stiffness is kept by a step: a tenth of the approach


def both_races(c: Geometry, centre: Motion, ball: Pair) -> tuple[Springs, Springs]:
    """The contacts of the inner and of the outer race as springs, at A and X."""
    return springs(c.inner_grooves, against(centre, ball), 1.0), springs(
        c.outer_grooves, ball, -1.0
    )


def stiffness(inner: Springs, outer: Springs) -> Block:
    """Stiffness of a ball between its contacts [N/m]."""
    mixed = inner.slope[1] + outer.slope[1]
    return (inner.slope[0] + outer.slope[0], mixed), (mixed, inner.slope[2] + outer.slope[2])


def rounding_force(c: Geometry, largest: Any) -> Any:
    """Error of the load of a ball under ``largest`` by rounding of the lengths [N]."""
    slope = 1.5 * (c.inner.stiffness**2 * np.maximum(largest, 1e-300)) ** (1.0 / 3.0)
    return EPS * c.free_distance * slope


def potential(
    c: Geometry, inner: Springs, outer: Springs, ball: Pair, centrifugal_force: Any
) -> Any:
    """Potential of one ball; that of Fc counts from the free outer race."""
    return inner.energy + outer.energy - centrifugal_force * (ball[1] - c.outer_centre_distance)


def reaction(
    c: Geometry, centre: Motion, ball: Pair, centrifugal_force: Any
) -> tuple[Any, Condensed]:
    """Potential of a ball at its seat, and its reaction with the ball eliminated.

    The residual of the balance of the ball is removed to first order: under a light thrust at
    speed it exceeds the thrust.
    """
    inner, outer = both_races(c, centre, ball)
    (p, q), (r, s) = stiffness(inner, outer)
    (a11, a12, a22), (t1, t2, _) = inner.slope, inner.by_tilt
    first, second, third = _rows(centre, inner)
    forces = Forces(
        residual=_gap(inner, outer, centrifugal_force),
        residual_by_ball=((-p, -q), (-r, -s)),
        residual_by_centre=(first, second),
        action=(inner.force[0], inner.force[1], inner.couple),
        action_by_ball=((-a11, -a12), (-a12, -a22), (-t1, -t2)),
        action_by_centre=(first, second, third),
    )
    return potential(c, inner, outer, ball, centrifugal_force), condensed(forces)


def _gap(inner: Springs, outer: Springs, centrifugal_force: Any) -> Pair:
    """Residual force on a ball, which pushes it towards its seat."""
    return inner.force[0] - outer.force[0], inner.force[1] - outer.force[1] + centrifugal_force


def _rows(centre: Motion, inner: Springs) -> tuple[Motion, Motion, Motion]:
    """Slopes of force and couple by the motion of the inner groove at a fixed ball."""
    (a11, a12, a22), (t1, t2, tt) = inner.slope, inner.by_tilt
    if len(centre) == 2:
        return (a11, a12), (a12, a22), (t1, t2)
    return (a11, a12, t1), (a12, a22, t2), (t1, t2, tt)


def resting_reaction(c: Geometry, centre: Motion) -> tuple[Any, Condensed]:
    """Energy, and action on the ring, of a ball at rest between one groove a ring:
    Q = kn (|A| − BD)₊^1.5 along A."""
    p = spring(both_grooves(c), centre)
    none = combined(0.0, centre, 0.0, centre)
    first, second, _ = _rows(centre, p)
    action = (p.force[0], p.force[1], none[0])
    return p.energy, Condensed(
        fold=none[0] + 1.0,
        still=(none[0], none[1]),
        follow=(none, none),
        action=action,
        tangent=(first, second, none),
    )


def both_grooves(c: Geometry) -> Groove:
    """Both grooves of a ball at rest as one: their contacts in series."""
    return Groove(c.series_stiffness, c.free_distance, 0.0, 0.0, 0.0, c.inner_grooves[0].walls)


def resting_seat(c: Geometry, centre: Pair) -> Pair:
    """Ball centre at rest: on the line of two groove centres; without load, on the outer race."""
    sin, cos, approach, _ = facing(both_grooves(c), centre)
    part = (c.series_stiffness / c.outer.stiffness) ** (2.0 / 3.0)
    seat = c.outer_centre_distance + part * approach
    return sin * seat, cos * seat


def riding_radius(c: Geometry, centrifugal_force: Any) -> Any:
    """X₂ of a ball that rides the bottom of an outer race of one groove."""
    return c.outer_centre_distance + (centrifugal_force / c.outer.stiffness) ** (2.0 / 3.0)


def first_seat(c: Geometry, centre: Motion, centrifugal_force: Any) -> Pair:
    """First ball centre of the search for a seat: the best of those that pairs of contacts give.

    It is the seat itself of a ball that rides the bottom of its outer groove, free of the inner
    race.
    """
    if len(c.inner_grooves) == 1 and len(c.outer_grooves) == 1:
        x = _between(c, (centre[0], centre[1]), centrifugal_force)
    else:
        x = _best(c, centre, centrifugal_force)
    if len(c.outer_grooves) == 2:
        return x
    riding = riding_radius(c, centrifugal_force)
    free = springs(c.inner_grooves, against(centre, (0.0 * riding, riding)), 1.0).energy == 0.0
    return where(free, 0.0, x[0]), where(free, riding, x[1])


def _best(c: Geometry, centre: Motion, centrifugal_force: Any) -> Pair:
    """Ball centre of least potential among those of all pairs of contacts and the outer arch."""
    half = c.outer_grooves[0].offset
    root = (
        c.outer_centre_distance + (0.5 * centrifugal_force / c.outer.stiffness) ** (2.0 / 3.0)
    ) ** 2 - half * half
    x = (0.0 * centre[0], np.sqrt(np.maximum(root, 0.0)))
    least = _energy(c, centre, x, centrifugal_force)
    for outer in c.outer_grooves:
        for inner in c.inner_grooves:
            vector = vector_to(inner, centre, 1.0)
            trial = _between(c, (vector[0] - outer.offset, vector[1]), centrifugal_force)
            trial = (trial[0] + outer.offset, trial[1])
            energy = _energy(c, centre, trial, centrifugal_force)
            better = energy < least
            x = (where(better, trial[0], x[0]), where(better, trial[1], x[1]))
            least = where(better, energy, least)
    return x


def _energy(c: Geometry, centre: Motion, ball: Pair, centrifugal_force: Any) -> Any:
    inner, outer = both_races(c, centre, ball)
    return potential(c, inner, outer, ball, centrifugal_force)


def _between(c: Geometry, centre: Pair, centrifugal_force: Any) -> Pair:
    """Ball centre where each race carries Fc, on the side that Fc pushes to; that at rest if the
    rings press the ball more.

    A ball that Fc alone holds starts at its races: from the bottom of the groove, deep in the inner
    race, steps that must not leave the outer race would stall. One that the inner groove carries
    beyond 90° leaves the outer race, and is seated; a groove that continues straight from there
    presses it along the axis alone.
    """
    inner = c.inner_centre_distance + (centrifugal_force / c.inner.stiffness) ** (2.0 / 3.0)
    outer = riding_radius(c, centrifugal_force)
    sin, cos, length = direction(centre)
    along = (length * length + outer * outer - inner * inner) / (2.0 * length)
    along = np.minimum(np.maximum(along, -outer), outer)
    across = np.sqrt(outer * outer - along * along)
    level = facing_radius(c.inner_grooves[0], centre[1])
    reach = np.sqrt(centre[0] * centre[0] + level * level)
    pressed = reach > inner + outer
    at_rest = resting_seat(c, centre)
    axial = where(pressed, at_rest[0], along * sin - across * where(sin < 0.0, -cos, cos))
    radial = where(pressed, at_rest[1], along * cos + across * np.abs(sin))
    if len(c.inner_grooves[0].walls) == 0:
        lifted = direction((centre[0], centre[1] + inner))[2] <= c.outer_centre_distance
        return where(lifted, centre[0], axial), where(lifted, centre[1] + inner, radial)
    beyond = ((radial > centre[1]) | (radial < 0.0)) & (reach <= inner + outer)
    wall = centre[0] - where(sin < 0.0, -inner, inner)
    wall = np.minimum(np.maximum(wall, -outer), outer)
    return where(beyond, wall, axial), where(beyond, np.sqrt(outer * outer - wall * wall), radial)


class SeatStep(NamedTuple):
    """Newton step of a ball towards its seat.

    ``step``: of the ball centre [m]; ``energy``: the potential before it, and ``most`` the upper
    limit after it, with a tolerance for rounding; ``hold``: stiffness of the contacts [N/m];
    ``moving``: whether the ball is not yet at its seat.
    """

    step: Pair
    energy: Any
    most: Any
    hold: Any
    moving: Any


def seat_step(c: Geometry, centre: Motion, ball: Pair, centrifugal_force: Any) -> SeatStep:
    """Potential and Newton step at X."""
    inner, outer = both_races(c, centre, ball)
    both = stiffness(inner, outer)
    back = inverse(both)
    gap = _gap(inner, outer, centrifugal_force)
    size = (
        np.sqrt(dot(inner.force, inner.force))
        + np.sqrt(dot(outer.force, outer.force))
        + centrifugal_force
    )
    hold = both[0][0] + both[1][1]
    noise = 4.0 * EPS * c.free_distance * hold  # force by rounding of the lengths
    energy = potential(c, inner, outer, ball, centrifugal_force)
    slack = 4.0 * EPS * (np.abs(energy) + inner.energy + outer.energy + c.free_distance * size)
    step = dot(back[0], gap), dot(back[1], gap)
    if len(c.outer_grooves[0].walls) > 0:
        step = _rising(c, both, outer, (gap, step), ball[1])
    return SeatStep(
        step=step,
        energy=energy,
        most=energy + slack,
        hold=hold,
        moving=np.sqrt(dot(gap, gap)) > SEATED * size + noise,
    )


def _rising(
    c: Geometry, both: Block, outer: Springs, newton: tuple[Pair, Pair], radial: Any
) -> Pair:
    """Step of a ball: not Newton's where straight walls alone press it and nothing carries Fc.

    It rises above the level of the outer groove centre, whose arc then carries Fc: as far as the
    load of the wall, turned with the arc, carries it. ``newton``: residual force and step.
    """
    (gap, step), hold = newton, both[0][0]
    pinched = (both[1][1] == 0.0) & (hold > 0.0) & (outer.force[0] != 0.0)
    turning = np.abs(outer.force[0]) / c.outer_centre_distance
    rise = gap[1] / where(pinched, turning, 1.0) - radial
    along = gap[0] / where(pinched, hold, 1.0)
    return where(pinched, along, step[0]), where(pinched, rise, step[1])


def improves(now: SeatStep, then: SeatStep) -> Any:
    """Whether a trial lowers the potential and keeps stiffness: a free ball has no Newton step."""
    return (then.energy <= now.most) & (then.hold > LEAST_HOLD * now.hold)
