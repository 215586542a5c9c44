"""First stage: the bearing with the gyroscopic moment off and the centrifugal force frozen.

The balls' potentials add up to a convex function of the ring's displacement, so that Newton steps
shortened until the potential falls lead to its one equilibrium from anywhere.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearings.ball.plane import EPS, Motion
from bearings.ball.potential import reaction, resting_reaction, resting_seat
from bearings.ring.linearised import followed_by
from bearings.ring.problem import (
    CONVEX_STEPS,
    HALVINGS,
    LONGEST_STEP,
    SETTLED,
    SOFT,
    SOFTEST,
    TOLERANCE,
    Index,
    Problem,
)
from bearings.ring.seat import seat
from bearings.ring.sums import rows

Array = NDArray[np.float64]


def _downhill(problem: Problem, k: Array, gap: Array) -> Array:
    """Newton direction of the convex stage, a little stiffened, its length bounded."""
    g = problem.geometry
    soft = SOFTEST * np.abs(k).max(axis=(1, 2))
    soft += SOFT * g.balls * g.series_stiffness * math.sqrt(1e-3 * g.free_distance)
    step = np.linalg.solve(k + soft[:, None, None] * np.eye(k.shape[-1]), gap[..., None])[..., 0]
    longest = np.abs(step).max(axis=1, keepdims=True)
    return step * np.minimum(1.0, LONGEST_STEP * g.free_distance / np.maximum(longest, 1e-300))


def convex_state(problem: Problem, start: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
    """(d, X) of the convex stage and whether it was reached (it always should)."""
    d = start.copy()
    x, answer = _settled(problem, d, None)
    if not problem.free.any():
        return d, x, np.ones(len(d), dtype=bool)
    done = np.zeros(len(d), dtype=bool)
    for _ in range(CONVEX_STEPS):
        gap, k, done = _ring_balance(problem, answer)
        todo = np.flatnonzero(~done)
        if not todo.size:
            break
        part = problem.take(todo)
        step = np.zeros((todo.size, 5))
        scale = problem.scale[problem.free]
        step[:, problem.free] = _downhill(problem, k[todo], gap[todo]) / scale
        d[todo], x[:, todo], fresh = _searched(part, d[todo], x[:, todo], answer.some(todo), step)
        answer.take(todo, fresh)
    return d, x, done


@dataclass(frozen=True, eq=False, slots=True)
class Answer:
    """What settled balls do to the ring.

    ``energy`` (s, n), ``action`` (3, s, n), ``tangent`` (s, 3, m, n); ``follow`` (2, m, s, n): how
    the balls go with it.
    """

    energy: Array
    action: Array
    tangent: Array
    follow: Array

    def some(self, index: Index) -> Answer:
        """The answer of some states."""
        parts = (self.energy[index], self.action[:, index], self.tangent[index])
        return Answer(*parts, self.follow[:, :, index])

    def take(self, index: Index, fresh: Answer) -> None:
        """Write the answer of some states anew."""
        self.energy[index] = fresh.energy
        self.action[:, index] = fresh.action
        self.tangent[index] = fresh.tangent
        self.follow[..., index, :] = fresh.follow


def _settled(problem: Problem, d: Array, near: Array | None) -> tuple[Array, Answer]:
    """Ball centres at displacement d with the push frozen, and what the balls do to the ring."""
    c, a = problem.geometry, problem.centres(d)
    centre = tuple(a)
    if problem.placed:
        push = (c.orbit * c.nominal * problem.squared)[:, None]
        x = seat(c, a, push, near)
        answer = reaction(c, centre, (x[0], x[1]), push)
    else:
        x, answer = np.stack(resting_seat(c, (a[0], a[1]))), resting_reaction(c, centre)
    return x, Answer(
        energy=answer.energy,
        action=_filled(answer.action, a[0]),
        tangent=rows(answer.slope),
        follow=np.stack([_filled(row, a[0]) for row in answer.follow]),
    )


def _filled(parts: Motion, like: Array) -> Array:
    """Numbers or arrays as arrays (m, …)."""
    whole = np.empty((len(parts), *like.shape))
    for row, part in zip(whole, parts, strict=True):
        row[...] = part
    return whole


def _ring_balance(problem: Problem, answer: Answer) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Load still missing and tangent, freedoms as lengths; and where nothing is missing."""
    g, free, scale = problem.geometry, problem.free, problem.scale[problem.free]
    gap = (problem.load - problem.ring.load(answer.action))[:, free] / scale
    k = problem.ring.stiffness(answer.tangent)[:, free][:, :, free] / scale / scale[:, None]
    carried = g.balls * np.hypot(*answer.action[:2]).max(axis=-1)
    size = np.abs(problem.load / problem.scale).max(axis=-1) + 1e-3 * carried
    noise = 16.0 * EPS * (g.inner_reach + g.outer_reach) * np.abs(k).max(axis=(1, 2))
    needed = SETTLED if problem.turning else 0.1 * TOLERANCE
    return gap, k, np.abs(gap).max(axis=-1) <= needed * size + noise


def _searched(
    problem: Problem, d: Array, x: Array, now: Answer, step: Array
) -> tuple[Array, Array, Answer]:
    """A step along ``step``, halved until the potential falls; balls settle at every try."""
    count = problem.geometry.balls / problem.ring.balls

    def potential(energy: Array, d: Array) -> Array:
        work = (problem.load * d)[:, problem.free].sum(axis=-1)
        return np.asarray(count * energy.sum(axis=-1) - work)

    g, before = problem.geometry, potential(now.energy, d)
    largest = np.abs(problem.load / problem.scale).max(axis=-1)
    slack = 64.0 * EPS * (np.abs(before) + largest * (g.inner_reach + g.outer_reach))
    length, along = np.ones((len(d), 1)), problem.ring.moved(step)
    along = followed_by(now.follow, along)
    for _ in range(HALVINGS):
        trial = d + length * step
        seats, answer = _settled(problem, trial, x + length * along)
        good = potential(answer.energy, trial) <= before + slack
        if good.all():
            break
        length = np.where(good[:, None], length, 0.5 * length)
    return trial, seats, answer
