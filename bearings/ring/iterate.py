"""Bearings within a larger Newton iteration: balls take one step with every move of their rings.

Whoever moves the rings sees a ring on springs, each ball eliminated as linearised where it stands;
balls and rings come into balance together, instead of the balls anew for every place of a ring
(``Iterate``); or, compiled, the balls anew for every place (``Settled``).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from bearings.arrays import Array, Flags, Index
from bearings.ball.plane import turned_far
from bearings.geometry import Geometry
from bearings.ring.assembly import Assembly
from bearings.ring.equilibrium import one_by_one
from bearings.ring.linearised import Linear, followed_by, linearise, tangent
from bearings.ring.operation import Operation
from bearings.ring.problem import Problem, turns
from bearings.ring.state import BearingState
from bearings.ring.tolerances import LONGEST_TURN

Parts = tuple[tuple[Index, Problem], ...]


@dataclass(frozen=True, eq=False, slots=True)
class Iterate:
    """A batch of bearings of one model on the way to balance; ``shape`` (…) is that of the batch.

    ``displacement`` (…, 5); ``ball`` (2, …, n): centres of the balls that are solved.
    ``load`` (…, 5) and ``stiffness`` (…, 5, 5) of the rings with the balls settled to first order;
    ``error`` (…): largest imbalance of a ball over the largest ball load, NaN where there is no
    state; ``pressure`` (…): largest of both races [Pa]; ``inner_load`` (…, n) of the balls [N];
    ``sound`` (…): every ball on the physical branch. A turning ball moves by ``still``, and by
    ``follow`` times what its groove centre does; at rest balls have none.
    """

    parts: Parts
    shape: tuple[int, ...]
    displacement: Array
    ball: Array
    load: Array
    stiffness: Array
    error: Array
    pressure: Array
    inner_load: Array
    sound: Flags
    still: Array
    follow: Array

    def at(self, displacement: Array, ball: Array) -> Iterate:
        """Rings and balls placed there."""
        return _linearised(self.parts, self.shape, displacement, ball)

    def moved(self, displacement: Array) -> Iterate:
        """Rings placed there, every ball one Newton step on."""
        step = self.along(displacement - self.displacement)
        return self.at(displacement, self.ball + self.still + step)

    def along(self, change: Array) -> Array:
        """What balls do with a ``change`` (…, 5) of the displacement (2, …, n)."""
        moved = self.parts[0][1].assembly.moved(change.reshape(-1, 5))
        return followed_by(self.follow, moved.reshape(len(moved), *self.ball.shape[1:]))

    def follows(self, before: Iterate) -> Flags:
        """Where every ball is on the physical branch and no angle has turned far (…)."""
        near = self.sound.reshape(-1).copy()
        for index, problem in self.parts:
            if problem.placed:
                pair = (problem.faced(*one._states(index)) for one in (before, self))
                for then, now in zip(*pair, strict=True):
                    near[index] &= ~turned_far(then, now, LONGEST_TURN).any(axis=-1)
        return near.reshape(self.shape)

    def _states(self, index: Index) -> tuple[Array, Array]:
        """Displacements (s, 5) and balls (2, s, n) of some bearings of the batch."""
        balls = self.ball.reshape(2, -1, self.ball.shape[-1])
        return self.displacement.reshape(-1, 5)[index], balls[:, index]


def iterate(state: BearingState, assembly: Callable[[Geometry], Assembly]) -> Iterate:
    """A solved batch as an iterate; ``assembly`` says which of its balls are solved.

    The first balls of the state are taken for those of the assembly.
    """
    parts = parts_of(state.operation, assembly)
    ball = state.ball_centre[..., : parts[0][1].assembly.balls]
    return _linearised(parts, state.operation.shape, state.displacement, ball)


def iterate_of(
    state: BearingState, rows: Index, columns: Index, assembly: Callable[[Geometry], Assembly]
) -> Iterate:
    """Some bearings of a solved batch (speeds, places), also repeated: ``rows`` and ``columns``."""
    grid = np.ix_(rows, columns)
    there = np.arange(len(state.operation.speed)).reshape(state.operation.shape)[grid]
    index = there.ravel()
    chosen = state.operation.repeated(index, state.operation.speed[index])
    parts = parts_of(
        replace(chosen, displacement=state.displacement[grid].reshape(-1, 5)), assembly
    )
    balls = parts[0][1].assembly.balls
    ball = state.ball_centre.reshape(2, len(state.operation.speed), -1)[:, index, :balls]
    ball = ball.reshape(2, *there.shape, balls)
    return _linearised(parts, there.shape, state.displacement[grid], ball)


def parts_of(operation: Operation, assembly: Callable[[Geometry], Assembly]) -> Parts:
    """States at given displacements that turn, and those at rest."""
    whole = replace(Problem.of(operation, assembly), free=np.zeros(5, dtype=bool))
    turn = turns(whole.geometry, operation.speed)
    groups = ((np.flatnonzero(turn == turning), turning) for turning in (True, False))
    return tuple((k, replace(whole.take(k), turning=turning)) for k, turning in groups if k.size)


def _linearised(parts: Parts, shape: tuple[int, ...], displacement: Array, ball: Array) -> Iterate:
    count, balls = sum(len(k) for k, _ in parts), ball.shape[-1]
    d, x = displacement.reshape(count, 5), ball.reshape(2, count, balls)
    load, stiffness = np.empty((count, 5)), np.empty((count, 5, 5))
    error, pressure = np.empty((2, count))
    inner_load = np.empty((count, balls))
    sound = np.empty(count, dtype=bool)
    parts_of = len(parts[0][1].assembly.spread)
    still, follow = np.zeros((2, count, balls)), np.zeros((2, parts_of, count, balls))
    for k, problem in parts:
        linear = linearise(problem, d[k], x[:, k], np.full(len(k), problem.full))
        load[k] = problem.assembly.load(np.stack(linear.balls.action))
        stiffness[k] = tangent(problem, linear.balls)
        error[k], pressure[k] = linear.error, _pressure(problem, linear)
        inner_load[k] = linear.balance.inner_load
        sound[k] = np.isfinite(linear.error)
        if problem.turning:
            sound[k] = (linear.fold > 0.0) & (linear.balance.outer_load > 0.0).all(axis=-1)
        if problem.placed:
            still[:, k] = linear.balls.still
            follow[:, :, k] = linear.balls.follow
    return Iterate(
        parts=parts,
        shape=shape,
        displacement=displacement,
        ball=ball,
        load=load.reshape(*shape, 5),
        stiffness=stiffness.reshape(*shape, 5, 5),
        error=error.reshape(shape),
        pressure=pressure.reshape(shape),
        inner_load=inner_load.reshape(*shape, balls),
        sound=sound.reshape(shape),
        still=still.reshape(2, *shape, balls),
        follow=follow.reshape(2, parts_of, *shape, balls),
    )


def _pressure(problem: Problem, linear: Linear) -> Array:
    g, balance = problem.geometry, linear.balance
    inner, outer = balance.inner_load.max(axis=-1), balance.outer_load.max(axis=-1)
    return np.maximum(g.inner.peak_pressure(inner), g.outer.peak_pressure(outer))


@dataclass(frozen=True, eq=False, slots=True)
class Settled:
    """What ``Iterate`` does step by step, the balls in balance at every place of the rings.

    By the compiled solver: dearer for one bearing by itself, for which that must be loaded, several
    times cheaper for thousands of iterations. Fields as there; ``error`` 0 where there is a state.
    """

    parts: Parts
    shape: tuple[int, ...]
    displacement: Array
    ball: Array
    load: Array
    stiffness: Array
    error: Array

    def moved(self, displacement: Array) -> Settled:
        """Rings at ``displacement`` (…, 5), balls sought from where they are."""
        return _settled(self.parts, self.shape, displacement, self)

    def follows(self, before: Settled) -> Flags:
        """Where there is a state: each is found by itself if its neighbour leads astray (…)."""
        return np.asarray(np.isfinite(self.error))


def settled(operation: Operation, assembly: Callable[[Geometry], Assembly]) -> Settled:
    """Bearings at given displacements; ``assembly`` says which of their balls are solved."""
    parts = parts_of(operation, assembly)
    return _settled(parts, operation.shape, operation.displacement, None)


def _settled(
    parts: Parts, shape: tuple[int, ...], displacement: Array, before: Settled | None
) -> Settled:
    count, balls = sum(len(k) for k, _ in parts), parts[0][1].assembly.balls
    d, x = displacement.reshape(count, 5), np.zeros((2, count, balls))
    load, stiffness, error = np.empty((count, 5)), np.empty((count, 5, 5)), np.zeros(count)
    if before is not None:
        known = before.ball.reshape(2, count, balls)
        stayed = (before.displacement.reshape(count, 5) == d).all(axis=1)
        load[:], stiffness[:] = before.load.reshape(count, 5), before.stiffness.reshape(count, 5, 5)
        x[:], error[:] = known, before.error.reshape(count)
    for k, problem in parts:
        if before is not None and stayed[k].all():
            continue
        (_, x[:, k], load[k], stiffness[k], exists), _ = one_by_one(
            problem, d[k], None if before is None else known[:, k]
        )
        error[k] = np.where(exists, 0.0, np.nan)
    return Settled(
        parts,
        shape,
        displacement,
        x.reshape(2, *shape, balls),
        load.reshape(*shape, 5),
        stiffness.reshape(*shape, 5, 5),
        error.reshape(shape),
    )
