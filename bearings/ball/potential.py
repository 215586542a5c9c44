"""The convex core of the ball problem: Hertzian contacts and a fixed centrifugal push.

Σ 0.4 k δ₊^2.5 − Fc X₂ over one to four contacts has one minimum over the ball centre X for every
place of the inner groove, and what is left is convex in that place: a bearing assembled from it has
one equilibrium, reachable from anywhere. A ball at rest between one groove a ring has a closed
form. Plain expressions of floats or arrays, which compile as they stand.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from bearings.ball.constants import EPS, BallConstants, Groove
from bearings.ball.plane import Block, Pair, Triple, direction, dot, inverse, row_times, where
from bearings.ball.race import place

SETTLED = 1e-8  # of the ball's own loads


class Reaction(NamedTuple):
    """What a settled ball does to the inner ring.

    Its potential; (axial, radial, tilting) action on the ring, its slope by the place of the inner
    groove, and how X follows that place.
    """

    energy: Any
    action: Triple
    slope: tuple[Triple, Triple, Triple]
    follow: tuple[Triple, Triple]


class Springs(NamedTuple):
    """The contacts of a race: potential, force and symmetric slope (11, 12, 22) by their vector.

    ``couple`` Σ x F_r about the middle of the ring; ``by_tilt``: slopes of force and couple by the
    tilt of the ring.
    """

    energy: Any
    force: Pair
    slope: Triple
    couple: Any
    by_tilt: Triple


def springs(grooves: tuple[Groove, ...], vector: Pair, tilt: Any, side: float) -> Springs:
    """Contacts of a race at a vector, as in ``bearings.ball.race``."""
    if len(grooves) == 1:
        p = place(grooves[0], vector, tilt, side)
        return Springs(p.energy, p.force, p.slope, 0.0, (0.0, 0.0, 0.0))
    return _two(grooves, vector, tilt, side)


def _two(grooves: tuple[Groove, ...], vector: Pair, tilt: Any, side: float) -> Springs:
    p, q = place(grooves[0], vector, tilt, side), place(grooves[1], vector, tilt, side)
    x, y = grooves[0].offset, grooves[1].offset
    return Springs(
        p.energy + q.energy,
        (p.force[0] + q.force[0], p.force[1] + q.force[1]),
        (p.slope[0] + q.slope[0], p.slope[1] + q.slope[1], p.slope[2] + q.slope[2]),
        x * p.force[1] + y * q.force[1],
        (
            x * p.slope[1] + y * q.slope[1],
            x * p.slope[2] + y * q.slope[2],
            x * x * p.slope[2] + y * y * q.slope[2],
        ),
    )


def contacts(c: BallConstants, centre: Triple, ball: Pair) -> tuple[Springs, Springs]:
    """Inner and outer contacts; ``centre``: middle of the inner groove, and the ring's tilt."""
    inner = springs(c.inner, (centre[0] - ball[0], centre[1] - ball[1]), centre[2], 1.0)
    return inner, springs(c.outer, ball, 0.0, -1.0)


def stiffness(inner: Springs, outer: Springs) -> Block:
    """Of a ball between its contacts."""
    mixed = inner.slope[1] + outer.slope[1]
    return (inner.slope[0] + outer.slope[0], mixed), (mixed, inner.slope[2] + outer.slope[2])


def potential(c: BallConstants, inner: Springs, outer: Springs, ball: Pair, push: Any) -> Any:
    """Of one ball; the push counts from the free outer race."""
    return inner.energy + outer.energy - push * (ball[1] - c.outer_reach)


def reaction(c: BallConstants, centre: Triple, ball: Pair, push: Any) -> Reaction:
    """Action and tangent of a ball that sits at its seat."""
    inner, outer = contacts(c, centre, ball)
    back = inverse(stiffness(inner, outer))
    (a11, a12, a22), (t1, t2, tt) = inner.slope, inner.by_tilt
    columns = ((a11, a12, t1), (a12, a22, t2))
    follow = (row_times(back[0], columns), row_times(back[1], columns))
    slope = (
        _left((a11, a12, t1), (a11, a12), follow),
        _left((a12, a22, t2), (a12, a22), follow),
        _left((t1, t2, tt), (t1, t2), follow),
    )
    action = (inner.force[0], inner.force[1], inner.couple)
    return Reaction(potential(c, inner, outer, ball, push), action, slope, follow)


def _left(row: Triple, along: Pair, follow: tuple[Triple, Triple]) -> Triple:
    """What is left of a row of slopes where the ball follows."""
    yields = row_times(along, follow)
    return row[0] - yields[0], row[1] - yields[1], row[2] - yields[2]


def resting_reaction(c: BallConstants, centre: Triple) -> Reaction:
    """A ball at rest between one groove a ring: Q = kn (|A| − BD)₊^1.5 along A, X eliminated."""
    whole = Groove(c.series_stiffness, c.inner_reach + c.outer_reach, 0.0)
    p = place(whole, (centre[0], centre[1]), 0.0, 1.0)
    none = 0.0 * p.load
    slope = ((p.slope[0], p.slope[1], none), (p.slope[1], p.slope[2], none), (none, none, none))
    still = (none, none, none)
    return Reaction(p.energy, (p.force[0], p.force[1], none), slope, (still, still))


def resting_seat(c: BallConstants, centre: Pair) -> Pair:
    """Ball centre at rest: on the line of two groove centres; without load, on the outer race."""
    sin, cos, length = direction(centre)
    approach = np.maximum(length - c.inner_reach - c.outer_reach, 0.0)
    part = (c.series_stiffness / c.outer_stiffness) ** (2.0 / 3.0)
    seat = c.outer_reach + part * approach
    return sin * seat, cos * seat


def riding_radius(c: BallConstants, push: Any) -> Any:
    """X₂ of a ball that rides the bottom of an outer race of one groove."""
    return c.outer_reach + (push / c.outer_stiffness) ** (2.0 / 3.0)


def first_seat(c: BallConstants, centre: Triple, push: Any) -> Pair:
    """Where to start the search for a seat: the best of the places that pairs of contacts give."""
    if len(c.inner) == 1 and len(c.outer) == 1:
        return _between(c, (centre[0], centre[1]), push)
    return _best(c, centre, push)


def _best(c: BallConstants, centre: Triple, push: Any) -> Pair:
    """Of all pairs of an inner and an outer contact, and of the outer arch, the least potential."""
    half = c.outer[0].offset
    root = (c.outer_reach + (0.5 * push / c.outer_stiffness) ** (2.0 / 3.0)) ** 2 - half * half
    x = (0.0 * centre[0], np.sqrt(np.maximum(root, 0.0)))
    least = _energy(c, centre, x, push)
    for outer in c.outer:
        for inner in c.inner:
            shifted = (
                centre[0] + inner.offset - outer.offset,
                centre[1] + inner.offset * centre[2],
            )
            trial = _between(c, shifted, push)
            trial = (trial[0] + outer.offset, trial[1])
            energy = _energy(c, centre, trial, push)
            better = energy < least
            x = (where(better, trial[0], x[0]), where(better, trial[1], x[1]))
            least = where(better, energy, least)
    return x


def _energy(c: BallConstants, centre: Triple, ball: Pair, push: Any) -> Any:
    inner, outer = contacts(c, centre, ball)
    return potential(c, inner, outer, ball, push)


def _between(c: BallConstants, centre: Pair, push: Any) -> Pair:
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
    after the step, rounding granted; ``room``: how deep it is in the outer race; ``moving``: not
    yet settled.
    """

    step: Pair
    energy: Any
    most: Any
    room: Any
    moving: Any


def seat_step(c: BallConstants, centre: Triple, ball: Pair, push: Any) -> SeatStep:
    """Potential and Newton step at X."""
    inner, outer = contacts(c, centre, ball)
    both = stiffness(inner, outer)
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
        room=depth(c, ball),
        moving=np.sqrt(dot(gap, gap)) > SETTLED * size + noise,
    )


def depth(c: BallConstants, ball: Pair) -> Any:
    """How deep a ball is in the nearer groove of the outer race [m]."""
    first, last = c.outer[0].offset, c.outer[-1].offset
    one = direction((ball[0] - first, ball[1]))[2]
    return np.maximum(one, direction((ball[0] - last, ball[1]))[2]) - c.outer_reach


def improves(now: SeatStep, then: SeatStep) -> Any:
    """Whether a try lowers the potential and keeps a tenth of the room to the free outer race."""
    return (then.energy <= now.most) & (then.room > 0.1 * now.room)
