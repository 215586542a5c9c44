"""The convex core of the ball problem: two Hertzian contacts and a fixed centrifugal push.

Σ 0.4 k δ₊^2.5 − Fc X₂ has one minimum over the ball centre X for every inner groove centre A, and
what is left is convex in A: a bearing assembled from it has one equilibrium, reachable from
anywhere. At rest (no push) X is eliminated in closed form. Plain expressions of floats or arrays as
in ``bearings.ball.balance``.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from bearings.ball.constants import EPS, BallConstants
from bearings.ball.plane import Block, Pair, direction, dot, inverse, less, plus, row_times, where

SETTLED = 1e-8  # of the ball's own loads


class Reaction(NamedTuple):
    """What a settled ball does to the inner ring at A.

    Its potential, force, slope of the force by A, and how X follows A.
    """

    energy: Any
    force: Pair
    slope: Block
    follow: Block


class Spring(NamedTuple):
    """Potential, force and slope of a contact by its vector."""

    energy: Any
    force: Pair
    slope: Block


def spring(stiffness: float, reach: float, vector: Pair) -> Spring:
    """A contact k δ₊^1.5 along ``vector``, free up to the length ``reach``."""
    sin, cos, length = direction(vector)
    approach = np.maximum(length - reach, 0.0)
    root = np.sqrt(approach)
    load, along = stiffness * approach * root, 1.5 * stiffness * root
    across = load / length
    more = along - across
    mixed = more * sin * cos
    slope = ((across + more * sin * sin, mixed), (mixed, across + more * cos * cos))
    return Spring(0.4 * load * approach, (load * sin, load * cos), slope)


def springs(c: BallConstants, centre: Pair, ball: Pair) -> tuple[Spring, Spring]:
    """Inner and outer contact."""
    inner = spring(c.inner_stiffness, c.inner_reach, less(centre, ball))
    return inner, spring(c.outer_stiffness, c.outer_reach, ball)


def potential(c: BallConstants, inner: Spring, outer: Spring, ball: Pair, push: Any) -> Any:
    """Of one ball; the push counts from the free outer race."""
    return inner.energy + outer.energy - push * (ball[1] - c.outer_reach)


def reaction(c: BallConstants, centre: Pair, ball: Pair, push: Any) -> Reaction:
    """Force and tangent of a ball that sits at its seat."""
    inner, outer = springs(c, centre, ball)
    back = inverse((plus(inner.slope[0], outer.slope[0]), plus(inner.slope[1], outer.slope[1])))
    follow = (row_times(back[0], inner.slope), row_times(back[1], inner.slope))
    slope = (
        less(inner.slope[0], row_times(inner.slope[0], follow)),
        less(inner.slope[1], row_times(inner.slope[1], follow)),
    )
    return Reaction(potential(c, inner, outer, ball, push), inner.force, slope, follow)


def riding_radius(c: BallConstants, push: Any) -> Any:
    """X₂ of a ball that rides the outer race."""
    return c.outer_reach + (push / c.outer_stiffness) ** (2.0 / 3.0)


def resting_reaction(c: BallConstants, centre: Pair) -> Spring:
    """Force and tangent of a ball at rest: Q = kn (|A| − BD)₊^1.5 along A."""
    return spring(c.series_stiffness, c.inner_reach + c.outer_reach, centre)


def resting_seat(c: BallConstants, centre: Pair) -> Pair:
    """Ball centre at rest: on the line of the groove centres; without load, on the outer race."""
    sin, cos, length = direction(centre)
    approach = np.maximum(length - c.inner_reach - c.outer_reach, 0.0)
    part = (c.series_stiffness / c.outer_stiffness) ** (2.0 / 3.0)
    seat = c.outer_reach + part * approach
    return sin * seat, cos * seat


def first_seat(c: BallConstants, centre: Pair, push: Any) -> Pair:
    """Where each race carries Fc, on the side that Fc pushes to; as at rest where pressed more.

    A ball that Fc alone holds starts at its races: from the bottom of the groove, deep in the inner
    race, steps that must not leave the outer race would stall. One that the inner groove carries
    beyond 90° leaves the outer race, and is seated.
    """
    inner = c.inner_reach + (push / c.inner_stiffness) ** (2.0 / 3.0)
    outer = riding_radius(c, push)
    sin, cos, length = direction(centre)
    along = (length * length + outer * outer - inner * inner) / (2.0 * length)
    along = np.minimum(np.maximum(along, -outer), outer)
    across = np.sqrt(outer * outer - along * along)
    pressed = length > inner + outer
    still = resting_seat(c, centre)
    axial = where(pressed, still[0], along * sin - across * where(sin < 0.0, -cos, cos))
    radial = where(pressed, still[1], along * cos + across * np.abs(sin))
    lifted = direction((centre[0], centre[1] + inner))[2] <= c.outer_reach
    return where(lifted, centre[0], axial), where(lifted, centre[1] + inner, radial)


class SeatStep(NamedTuple):
    """A ball on its way to its seat.

    ``step``: the Newton step from here; ``energy``: the potential, and ``most`` what it may be
    after the step, rounding granted; ``room`` to the free outer race; ``moving``: not yet settled.
    """

    step: Pair
    energy: Any
    most: Any
    room: Any
    moving: Any


def seat_step(c: BallConstants, centre: Pair, ball: Pair, push: Any) -> SeatStep:
    """Potential and Newton step at X."""
    inner, outer = springs(c, centre, ball)
    both = (plus(inner.slope[0], outer.slope[0]), plus(inner.slope[1], outer.slope[1]))
    back = inverse(both)
    gap = (inner.force[0] - outer.force[0], inner.force[1] - outer.force[1] + push)
    size = np.sqrt(dot(inner.force, inner.force)) + np.sqrt(dot(outer.force, outer.force)) + push
    reach = c.inner_reach + c.outer_reach
    noise = 4.0 * EPS * reach * (both[0][0] + both[1][1])
    energy = potential(c, inner, outer, ball, push)
    slack = 4.0 * EPS * (np.abs(energy) + inner.energy + outer.energy + reach * size)
    return SeatStep(
        step=(dot(back[0], gap), dot(back[1], gap)),
        energy=energy,
        most=energy + slack,
        room=direction(ball)[2] - c.outer_reach,
        moving=np.sqrt(dot(gap, gap)) > SETTLED * size + noise,
    )


def improves(now: SeatStep, then: SeatStep) -> Any:
    """Whether a try lowers the potential and keeps a tenth of the room to the free outer race."""
    return (then.energy <= now.most) & (then.room > 0.1 * now.room)
