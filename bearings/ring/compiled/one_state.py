"""One state to find: what its balls do together, evaluated ball by ball."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearings.ball.balance import Rows, settled, turning_balance
from bearings.ball.law import LawNumbers
from bearings.ball.plane import Motion, Pair, Triple, plus
from bearings.ball.potential import (
    both_races,
    depth,
    first_seat,
    improves,
    reaction,
    resting_reaction,
    resting_seat,
    riding_radius,
    seat_step,
)
from bearings.geometry import Geometry, Groove
from bearings.ring.tolerances import SEAT_STEPS

Array = NDArray[np.float64]


class One(NamedTuple):
    """A state to find.

    ``origin`` (2,), ``load`` (5,), ``scale`` (5,), ``placed`` and ``full`` as in
    ``bearings.ring.problem.Problem``; ``azimuth`` (n, 6) as in
    ``bearings.ring.assembly.Assembly``; ``free``: places of the freedoms whose load
    is given; ``one_branch`` as in ``bearings.ball.law``; ``squared`` ω²; ``load_size``: largest
    load, as a force.
    """

    origin: Array
    squared: float
    load: Array
    scale: Array
    load_size: float
    geometry: Geometry
    law: LawNumbers
    azimuth: Array
    free: NDArray[np.intp]
    turning: bool
    one_branch: bool
    placed: bool
    full: float


class Work(NamedTuple):
    """Room for what an evaluation finds.

    ``still`` (n, 2), ``follow`` (n, 6): how each ball moves with the ring. ``grip`` (n, 2): inner
    load and gyroscopic moment of each ball, ``first_grip`` where a stride began. ``action``,
    ``settled`` (5,): load on the ring, as it is and with the balls settled. ``stiffness`` (5, 5).
    ``d``, ``x``: where the last stride began.
    """

    still: Array
    follow: Array
    grip: Array
    first_grip: Array
    action: Array
    settled: Array
    stiffness: Array
    d: Array
    x: Array


class Evaluation(NamedTuple):
    """Sums over the balls.

    ``largest`` ball load; ``imbalance`` of a ball; ``fold``: smallest ball determinant;
    ``pressed``: every ball on the outer race; ``energy`` of the convex stage.
    """

    largest: float
    imbalance: float
    fold: float
    pressed: bool
    energy: float


def room(balls: int) -> Work:
    """Empty room for a ring of so many balls."""
    five, x = np.zeros(5), np.zeros((balls, 2))
    follow, stiffness = np.zeros((balls, 6)), np.zeros((5, 5))
    grip, first = x.copy(), x.copy()
    return Work(x, follow, grip, first, five, five.copy(), stiffness, five.copy(), x.copy())


def centre_of(p: One, d: Array, ball: int) -> Motion:
    """A of one ball."""
    motion = moved(p, d, ball)
    return plus(motion, noticed(p.geometry.inner_grooves, (p.origin[0], p.origin[1], 0.0)))


def noticed(grooves: tuple[Groove, ...], motion: Triple) -> Motion:
    """What a ball notices of a motion of its ring: of one groove not the tilt about its centre."""
    if len(grooves) == 1:
        return motion[0], motion[1]
    return motion


def moved(p: One, d: Array, ball: int) -> Motion:
    """What a displacement adds to A of one ball."""
    cos, sin, radius = p.azimuth[ball, 1], p.azimuth[ball, 2], p.geometry.centre_radius
    tilt = d[4] * cos - d[3] * sin
    motion = (d[0] - radius * tilt, d[1] * cos + d[2] * sin, tilt)
    return noticed(p.geometry.inner_grooves, motion)


def followed(f: Array, step: Motion) -> Pair:
    """What a ball does where its groove moves by ``step``."""
    axial, radial = f[0] * step[0] + f[1] * step[1], f[3] * step[0] + f[4] * step[1]
    if len(step) == 2:
        return axial, radial
    return axial + f[2] * step[2], radial + f[5] * step[2]


def _keep_follow(f: Array, first: Motion, second: Motion) -> None:
    f[0], f[1], f[3], f[4] = first[0], first[1], second[0], second[1]
    if len(first) == 3:
        f[2], f[5] = first[2], second[2]


def evaluate(p: One, d: Array, x: Array, blend: float, w: Work) -> Evaluation:
    """The full problem at (d, X)."""
    largest, imbalance, fold, pressed = 0.0, 0.0, np.inf, True
    _clear(w)
    for ball in range(len(x)):
        centre = centre_of(p, d, ball)
        if not p.placed:
            at_rest = resting_reaction(p.geometry, centre)
            action = at_rest.action
            largest = max(largest, np.sqrt(action[0] ** 2 + action[1] ** 2))
            _add(p, ball, action, action, at_rest.slope, w)
            continue
        here = (x[ball, 0], x[ball, 1])
        b = turning_balance(p.geometry, p.law, centre, here, p.squared, blend, 1.0)
        s = settled(b)
        largest = max(largest, b.inner_load, b.outer_load)
        imbalance = max(imbalance, abs(b.residual[0]), abs(b.residual[1]))
        fold, pressed = min(fold, s.fold), pressed and b.outer_load > 0.0
        w.grip[ball, 0], w.grip[ball, 1] = b.inner_load, b.gyroscopic_moment
        w.still[ball, 0], w.still[ball, 1] = s.still
        _keep_follow(w.follow[ball], s.follow[0], s.follow[1])
        _add(p, ball, b.action, s.action, s.tangent, w)
    return Evaluation(largest, imbalance, fold, pressed, 0.0)


def evaluate_convex(p: One, d: Array, x: Array, w: Work) -> Evaluation:
    """The convex stage at d, balls settled from X, which is written anew."""
    largest, energy, c = 0.0, 0.0, p.geometry
    push = c.orbit * c.nominal * p.squared
    _clear(w)
    for ball in range(len(x)):
        centre = centre_of(p, d, ball)
        if p.placed:
            here = seat(c, centre, push, (x[ball, 0], x[ball, 1]))
            each = reaction(c, centre, here, push)
            _keep_follow(w.follow[ball], each.follow[0], each.follow[1])
        else:
            here = resting_seat(c, (centre[0], centre[1]))
            each = resting_reaction(c, centre)
        energy += each.energy
        x[ball, 0], x[ball, 1] = here
        largest = max(largest, np.sqrt(each.action[0] ** 2 + each.action[1] ** 2))
        _add(p, ball, each.action, each.action, each.slope, w)
    return Evaluation(largest, 0.0, 1.0, True, energy * p.geometry.balls / len(x))


def _clear(w: Work) -> None:
    w.action[:] = 0.0
    w.settled[:] = 0.0
    w.stiffness[:] = 0.0


def _add(
    p: One,
    ball: int,
    action: Triple,
    settled_action: Triple,
    tangent: Rows,
    w: Work,
) -> None:
    """What one ball adds to load and stiffness of the ring.

    A tilt of the ring moves its groove axially by the lever, and turns it.
    """
    az, radius = p.azimuth[ball], p.geometry.centre_radius
    _add_load(az, radius, action, w.action)
    _add_load(az, radius, settled_action, w.settled)
    one, cos, sin, cos2, both, sin2 = az[0], az[1], az[2], az[3], az[4], az[5]
    k, (axial, across, couple) = w.stiffness, tangent
    a1, a2, at = _lever(axial, radius)
    r1, r2, rt = _lever(across, radius)
    c1, c2, ct = _lever(couple, radius)
    m1, m2, mt = radius * a1 - c1, radius * a2 - c2, radius * at - ct
    k[0, 0] += a1 * one
    k[0, 1] += a2 * cos
    k[0, 2] += a2 * sin
    k[0, 3] += at * sin
    k[0, 4] -= at * cos
    k[1, 0] += r1 * cos
    k[1, 1] += r2 * cos2
    k[1, 2] += r2 * both
    k[1, 3] += rt * both
    k[1, 4] -= rt * cos2
    k[2, 0] += r1 * sin
    k[2, 1] += r2 * both
    k[2, 2] += r2 * sin2
    k[2, 3] += rt * sin2
    k[2, 4] -= rt * both
    k[3, 0] += m1 * sin
    k[3, 1] += m2 * both
    k[3, 2] += m2 * sin2
    k[3, 3] += mt * sin2
    k[3, 4] -= mt * both
    k[4, 0] -= m1 * cos
    k[4, 1] -= m2 * cos2
    k[4, 2] -= m2 * both
    k[4, 3] -= mt * both
    k[4, 4] += mt * cos2


def _lever(row: Motion, radius: float) -> Triple:
    """A row of slopes by axial and radial motion of the ring and by its tilt."""
    if len(row) == 2:
        return row[0], row[1], radius * row[0]
    return row[0], row[1], radius * row[0] - row[2]


def _add_load(az: Array, radius: float, action: Triple, load: Array) -> None:
    axial, radial, couple = action
    lever = radius * axial - couple
    load[0] += az[0] * axial
    load[1] += az[1] * radial
    load[2] += az[2] * radial
    load[3] += az[2] * lever
    load[4] -= az[1] * lever


def seat(c: Geometry, centre: Motion, push: float, start: Pair) -> Pair:
    """X of least potential, see ``seat`` in ``bearings.ring.convex_stage``."""
    riding = riding_radius(c, push)
    if len(c.outer_grooves) == 1 and both_races(c, centre, (0.0, riding))[0].energy == 0.0:
        return 0.0, riding
    first = first_seat(c, centre, push)
    x = (first[0] + 0.0, first[1] + 0.0)
    now, length = seat_step(c, centre, x, push), 1.0
    if depth(c.outer_grooves, start) > 0.0:
        given = seat_step(c, centre, start, push)
        if given.energy < now.energy:
            x, now = start, given
    for _ in range(SEAT_STEPS):
        if not now.moving:
            break
        trial = (x[0] + length * now.step[0], x[1] + length * now.step[1])
        then = seat_step(c, centre, trial, push)
        if improves(now, then):
            x, now, length = trial, then, 1.0
        else:
            length *= 0.5
    return x
