"""First stage: the bearing without gyroscopic moment and with fixed centrifugal force.

The balls' potentials add up to a convex function of the ring's displacement, so that Newton steps
shortened until the potential falls lead to its one equilibrium from anywhere. At every place of the
ring each ball is seated at the minimum of its own potential.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from bearings.arrays import Array, Flags, Index
from bearings.ball.plane import EPS
from bearings.ball.potential import (
    SeatStep,
    first_seat,
    improves,
    reaction,
    resting_reaction,
    resting_seat,
    seat_step,
)
from bearings.geometry import Geometry, frozen_force
from bearings.ring import tolerances as tol
from bearings.ring.linearised import followed_by, reduced
from bearings.ring.problem import Problem


def convex_state(problem: Problem, start: Array) -> tuple[Array, Array, Flags]:
    """Solve the convex stage: (d, X), and whether it converged (it always should).

    Contacts under a small load are hard walls to Newton steps, which then follow the valley between
    them in many short pieces. Under a greater load the valley is wide, and its minimum is close:
    where the steps do not suffice, the load is reduced in stages from there.
    """
    d, x, done = _descended(problem, start)
    size = problem.load_size
    todo = np.flatnonzero(~done & (size > 0.0) & (size < tol.LIGHT))
    if not todo.size:
        return d, x, done
    part, staged, factor = problem.take(todo), start[todo], tol.LIGHT / size[todo, None]
    while (factor > 1.0).any():
        staged = _descended(replace(part, load=factor * part.load), staged)[0]
        factor = np.maximum(factor / tol.LET_DOWN, 1.0)
    d[todo], x[:, todo], done[todo] = _descended(part, staged)
    return d, x, done


def _descended(problem: Problem, start: Array) -> tuple[Array, Array, Flags]:
    """Minimise by Newton steps from ``start``: (d, X), and whether that is the minimum."""
    d, now = start.copy(), _seated(problem, start, None)
    x, done = now.ball, np.full(len(d), not problem.free.any())
    scale, todo, part = problem.scale[problem.free], np.arange(len(d)), problem
    if done.all():
        return d, x, done
    for _ in range(tol.CONVEX_STEPS):
        gap, k, balanced = _ring_balance(part, now)
        done[todo] = balanced
        active = np.flatnonzero(~balanced)
        if not active.size:
            break
        todo, part, now = todo[active], part.take(active), now.take(active)
        step = np.zeros((todo.size, 5))
        step[:, problem.free] = _downhill(part, k[active], gap[active]) / scale
        d[todo], now = _searched(part, d[todo], now, step)
        x[:, todo] = now.ball
    return d, x, done


class Seated(NamedTuple):
    """A ring with every ball at the minimum of its potential, at fixed Fc.

    ``ball`` (2, s, n); ``energy`` (s,) of all balls; ``load`` (s, 5) and ``stiffness`` (s, 5, 5) of
    the ring; ``largest`` (s,): largest load of a ball on it; ``follow`` (2, m, s, n).
    """

    ball: Array
    energy: Array
    load: Array
    stiffness: Array
    largest: Array
    follow: Array

    def take(self, states: Index) -> Seated:
        """Select states by index."""
        return Seated(
            self.ball[:, states],
            self.energy[states],
            self.load[states],
            self.stiffness[states],
            self.largest[states],
            self.follow[:, :, states],
        )


def _seated(problem: Problem, d: Array, near: Array | None) -> Seated:
    """Seat the balls at displacement d; ``near``: nearby ball centres."""
    c, assembly, a = problem.geometry, problem.assembly, problem.centres(d)
    centre = tuple(a)
    if problem.placed:
        centrifugal_force = frozen_force(c, problem.squared)[:, None]
        x = seat(c, a, centrifugal_force, near)
        energy, balls = reaction(c, centre, (x[0], x[1]), centrifugal_force)
    else:
        x = np.stack(resting_seat(c, (a[0], a[1])))
        energy, balls = resting_reaction(c, centre)
    return Seated(
        ball=x,
        energy=c.balls / assembly.balls * energy.sum(axis=-1),
        load=assembly.load(balls.action),
        stiffness=assembly.stiffness(balls.tangent),
        largest=np.hypot(balls.action[0], balls.action[1]).max(axis=-1),
        follow=np.stack(balls.follow),
    )


def _ring_balance(problem: Problem, now: Seated) -> tuple[Array, Array, Flags]:
    """Residual load and tangent of the free DOF, scaled to lengths; and where it is negligible."""
    g, free, scale = problem.geometry, problem.free, problem.scale[problem.free]
    gap = (problem.load - now.load)[:, free] / scale
    k = reduced(problem, now.stiffness)
    size = problem.load_size + 1e-3 * g.balls * now.largest
    noise = tol.ROUNDING * EPS * g.free_distance * np.abs(k).max(axis=(1, 2))
    needed = tol.BALANCED if problem.turning else 0.1 * tol.TOLERANCE
    return gap, k, np.abs(gap).max(axis=-1) <= needed * size + noise


def _downhill(problem: Problem, k: Array, gap: Array) -> Array:
    """Newton direction of the convex stage, its length bounded.

    K is stiffened in proportion to the residual load, so that the last steps converge
    quadratically (Li, Fukushima, Qi & Yamashita, Comput. Optim. Appl. 28 (2004) 131).
    """
    g, residual = problem.geometry, np.abs(gap).max(axis=1)
    share = residual / (residual + problem.load_size + 1e-300)
    soft = tol.SOFTEST * np.maximum(share, tol.HARDEST) * np.abs(k).max(axis=(1, 2))
    soft += tol.SOFT * g.balls * g.series_stiffness * math.sqrt(1e-3 * g.free_distance)
    step = np.linalg.solve(k + soft[:, None, None] * np.eye(k.shape[-1]), gap[..., None])[..., 0]
    longest = np.abs(step).max(axis=1, keepdims=True)
    return step * np.minimum(1.0, tol.LONGEST_STEP * g.free_distance / np.maximum(longest, 1e-300))


def _searched(problem: Problem, d: Array, now: Seated, step: Array) -> tuple[Array, Seated]:
    """Take a ``step``, halved until the potential falls; balls are seated at every trial."""
    g = problem.geometry

    def total(seated: Seated, d: Array) -> Array:
        return np.asarray(seated.energy - (problem.load * d).sum(axis=-1))

    previous = total(now, d)
    load = 64.0 * problem.load_size + 4.0 * g.balls * frozen_force(g, problem.squared)
    slack = EPS * (64.0 * np.abs(previous) + g.free_distance * load)  # rounding of the potential
    length, along = np.ones((len(d), 1)), followed_by(now.follow, problem.assembly.moved(step))
    for _ in range(tol.HALVINGS):
        trial = d + length * step
        after = _seated(problem, trial, now.ball + length * along)
        lower = total(after, trial) <= previous + slack
        if lower.all():
            break
        length = np.where(lower[:, None], length, 0.5 * length)
    return trial, after


def seat(c: Geometry, centre: Array, centrifugal_force: Array, start: Array | None = None) -> Array:
    """Ball centre X (2, …) of least potential at A (m, …), under a ``centrifugal_force`` ≥ 0 (…).

    ``start``: a ball centre for a nearby A. Every ball takes Newton steps of its own length, halved
    where the potential rises.
    """
    a = centre.reshape(len(centre), -1)
    fc = np.broadcast_to(centrifugal_force, centre.shape[1:]).reshape(-1)

    def at(todo: Index | slice, x: Array) -> SeatStep:
        return seat_step(c, tuple(a[:, todo]), (x[0], x[1]), fc[todo])

    x = np.stack(first_seat(c, tuple(a), fc))
    now = at(slice(None), x)
    if start is not None:
        initial = start.reshape(2, -1)
        then = at(slice(None), initial)
        better = (then.energy < now.energy) & (then.hold > 0.0)
        x, now = np.where(better, initial, x), _chosen(better, then, now)
    todo, length = np.arange(a.shape[1]), np.ones(a.shape[1])
    for _ in range(tol.SEAT_STEPS):
        active = np.flatnonzero(now.moving)
        if not active.size:
            break
        parts: Any = (np.asarray(part)[..., active] for part in now)
        todo, length, now = todo[active], length[active], SeatStep(*parts)
        trial = x[:, todo] + length * np.stack(now.step)
        then = at(todo, trial)
        improved = improves(now, then)
        x[:, todo[improved]] = trial[:, improved]
        length = np.where(improved, 1.0, 0.5 * length)
        now = then if improved.all() else _chosen(improved, then, now)
    return x.reshape(2, *centre.shape[1:])


def _chosen(choice: Flags, yes: SeatStep, no: SeatStep) -> SeatStep:
    """Choose between two steps ball by ball."""
    parts: Any = (np.where(choice, *pair) for pair in zip(yes, no, strict=True))
    return SeatStep(*parts)
