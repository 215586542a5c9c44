"""One state to solve: sums over its balls, evaluated ball by ball."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from bearings.arrays import Array, Index
from bearings.ball.balance import turning_balance
from bearings.ball.condensed import Condensed, condensed
from bearings.ball.law import LawNumbers
from bearings.ball.plane import Motion, Pair, Triple, plus
from bearings.ball.potential import (
    first_seat,
    improves,
    reaction,
    resting_reaction,
    resting_seat,
    seat_step,
)
from bearings.geometry import Geometry, Groove, frozen_force
from bearings.ring.tolerances import SEAT_STEPS


class One(NamedTuple):
    """A state to solve.

    ``origin`` (2,), ``load`` (5,), ``scale`` (5,), ``placed`` and ``full`` as in
    ``bearings.ring.problem.Problem``; ``azimuth`` (n, 5) and ``products`` (n, 5, 5) as in
    ``bearings.ring.assembly.Assembly``; ``free``: places of the DOF whose load is given;
    ``one_branch`` as in ``bearings.ball.law``; ``squared`` ω²; ``load_size``: largest load, as a
    force.
    """

    origin: Array
    squared: float
    load: Array
    scale: Array
    load_size: float
    geometry: Geometry
    law: LawNumbers
    azimuth: Array
    products: Array
    free: Index
    turning: bool
    one_branch: bool
    placed: bool
    full: float


class Workspace(NamedTuple):
    """Arrays that an evaluation writes into.

    ``still`` (n, 2), ``follow`` (n, 6): Newton step of each ball at a fixed ring, and its motion
    with the ring. ``grip`` (n, 2): inner load and gyroscopic moment of each ball, ``first_grip``
    at the begin of a stride. ``action``, ``condensed`` (5,): load on the ring, as it is and with
    the balls condensed. ``stiffness`` (5, 5); ``local`` (3, 3): that of one ball. ``d``, ``x``: at
    the begin of the last stride.
    """

    still: Array
    follow: Array
    grip: Array
    first_grip: Array
    action: Array
    condensed: Array
    stiffness: Array
    local: Array
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


def workspace(n: int) -> Workspace:
    """Empty arrays for a ring of ``n`` balls."""
    x, five = np.zeros((n, 2)), np.zeros(5)
    k, local, follow = np.zeros((5, 5)), np.zeros((3, 3)), np.zeros((n, 6))
    return Workspace(
        x.copy(), follow, x.copy(), x.copy(), five, five.copy(), k, local, five.copy(), x
    )


def centre_of(p: One, d: Array, ball: int) -> Motion:
    """Middle A of the inner groove at one ball."""
    start = without_tilt(p.geometry.inner_grooves, (p.origin[0], p.origin[1], 0.0))
    return plus(moved(p, d, ball), start)


def without_tilt(grooves: tuple[Groove, ...], motion: Triple) -> Motion:
    """Drop the tilt of a ring with one groove: it does not move the centre of the groove."""
    if len(grooves) == 1:
        return motion[0], motion[1]
    return motion


def moved(p: One, d: Array, ball: int) -> Motion:
    """Change of A at one ball by a displacement."""
    c = p.azimuth[ball]
    tilt = d[4] * c[4] + d[3] * c[3]
    motion = (d[0] - p.geometry.centre_radius * tilt, d[1] * c[1] + d[2] * c[2], tilt)
    return without_tilt(p.geometry.inner_grooves, motion)


def followed_by(f: Array, step: Motion) -> Pair:
    """Motion of a ball that follows a motion ``step`` of its groove."""
    axial, radial = f[0] * step[0] + f[1] * step[1], f[3] * step[0] + f[4] * step[1]
    if len(step) == 2:
        return axial, radial
    return axial + f[2] * step[2], radial + f[5] * step[2]


def evaluate(p: One, d: Array, x: Array, blend: float, w: Workspace) -> Evaluation:
    """Evaluate the full problem at (d, X)."""
    largest, imbalance, fold, pressed = 0.0, 0.0, np.inf, True
    _clear(w)
    for ball in range(len(x)):
        centre = centre_of(p, d, ball)
        if not p.placed:
            s = resting_reaction(p.geometry, centre)[1]
            largest = max(largest, np.sqrt(s.action[0] ** 2 + s.action[1] ** 2))
            _add(p, ball, s.action, s, w)
            continue
        place = (x[ball, 0], x[ball, 1])
        b = turning_balance(p.geometry, p.law, centre, place, p.squared, blend, 1.0)
        s = condensed(b.forces)
        largest = max(largest, b.inner_load, b.outer_load)
        residual = b.forces.residual
        imbalance = max(imbalance, abs(residual[0]), abs(residual[1]))
        fold, pressed = min(fold, s.fold), pressed and b.outer_load > 0.0
        w.grip[ball, 0], w.grip[ball, 1] = b.inner_load, b.gyroscopic_moment
        w.still[ball, 0], w.still[ball, 1] = s.still
        _keep(s.follow[0], s.follow[1], w.follow[ball])
        _add(p, ball, b.forces.action, s, w)
    return Evaluation(largest, imbalance, fold, pressed, 0.0)


def evaluate_convex(p: One, d: Array, x: Array, w: Workspace) -> Evaluation:
    """Evaluate the convex stage at d, the balls seated from X, which is overwritten."""
    largest, energy, c = 0.0, 0.0, p.geometry
    centrifugal_force = frozen_force(c, p.squared)
    _clear(w)
    for ball in range(len(x)):
        centre = centre_of(p, d, ball)
        if p.placed:
            place = seat(c, centre, centrifugal_force, (x[ball, 0], x[ball, 1]))
            potential, s = reaction(c, centre, place, centrifugal_force)
            _keep(s.follow[0], s.follow[1], w.follow[ball])
        else:
            place = resting_seat(c, (centre[0], centre[1]))
            potential, s = resting_reaction(c, centre)
        energy += potential
        x[ball, 0], x[ball, 1] = place
        largest = max(largest, np.sqrt(s.action[0] ** 2 + s.action[1] ** 2))
        _add(p, ball, s.action, s, w)
    return Evaluation(largest, 0.0, 1.0, True, energy * p.geometry.balls / len(x))


def _keep(first: Motion, second: Motion, f: Array) -> None:
    """Store both rows of ``follow`` of a ball in ``f`` (6,)."""
    f[0], f[1], f[3], f[4] = first[0], first[1], second[0], second[1]
    if len(first) == 3:
        f[2], f[5] = first[2], second[2]


def put(into: Array, values: Array) -> None:
    """Copy ``values`` into an array, which must be contiguous, else nothing is written; a slice
    assignment would take half a second to compile, each time."""
    to, of = into.ravel(), values.ravel()
    for k in range(len(to)):
        to[k] = of[k]


def _clear(w: Workspace) -> None:
    for i in range(5):
        w.action[i] = w.condensed[i] = 0.0
        for j in range(5):
            w.stiffness[i, j] = 0.0


def _add(p: One, ball: int, action: Triple, s: Condensed, w: Workspace) -> None:
    """Add one ball to load and stiffness of the ring.

    ``action``: at the point itself; ``s``: of the condensed ball. A tilt of the ring moves its
    groove axially by the lever −Ri, and turns it.
    """
    c, products, radius = p.azimuth[ball], p.products[ball], p.geometry.centre_radius
    local, reduced, (axial, across, couple) = w.local, s.action, s.tangent
    _by_motion(axial, radius, local[0])
    _by_motion(across, radius, local[1])
    _by_motion(couple, radius, local[2])
    for j in range(3):
        local[2, j] -= radius * local[0, j]
    load = (action[0], action[1], action[2] - radius * action[0])
    condensed_load = (reduced[0], reduced[1], reduced[2] - radius * reduced[0])
    for i in range(5):
        row = (i + 1) // 2  # axial, radial twice, tilting twice
        w.action[i] += c[i] * load[row]
        w.condensed[i] += c[i] * condensed_load[row]
        for j in range(5):
            w.stiffness[i, j] += products[i, j] * local[row, (j + 1) // 2]


def _by_motion(slopes: Motion, radius: float, row: Array) -> None:
    """Write slopes by axial, radial and tilting motion of the ring into ``row``."""
    row[0], row[1], row[2] = slopes[0], slopes[1], -radius * slopes[0]
    if len(slopes) == 3:
        row[2] += slopes[2]


def seat(c: Geometry, centre: Motion, centrifugal_force: float, start: Pair) -> Pair:
    """Ball centre X of least potential, see ``seat`` in ``bearings.ring.convex_stage``."""
    first = first_seat(c, centre, centrifugal_force)
    x = (first[0] + 0.0, first[1] + 0.0)
    now, length = seat_step(c, centre, x, centrifugal_force), 1.0
    if start[0] != 0.0 or start[1] != 0.0:
        initial = seat_step(c, centre, start, centrifugal_force)
        if initial.energy < now.energy and initial.hold > 0.0:
            x, now = start, initial
    for _ in range(SEAT_STEPS):
        if not now.moving:
            break
        trial = (x[0] + length * now.step[0], x[1] + length * now.step[1])
        then = seat_step(c, centre, trial, centrifugal_force)
        if improves(now, then):
            x, now, length = trial, then, 1.0
        else:
            length *= 0.5
    return x
