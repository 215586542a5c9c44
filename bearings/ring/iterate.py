"""Bearings within a larger Newton iteration: balls take one step with every move of their rings.

Whoever moves the rings sees a ring on springs, each ball eliminated as linearised where it stands;
balls and rings come into balance together, instead of the balls anew for every place of a ring
(``Iterate``); or, compiled, the balls anew for every place (``Settled``).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings.arrays import Array, Flags, Index
from bearings.ball.plane import turned_far
from bearings.geometry import Geometry
from bearings.ring.assembly import Assembly
from bearings.ring.equilibrium import one_by_one
from bearings.ring.linearised import Linear, linearise
from bearings.ring.operation import Operation
from bearings.ring.problem import Problem, turns
from bearings.ring.state import BearingState
from bearings.ring.tolerances import LONGEST_TURN

Parts = tuple[tuple[Index, Problem], ...]


@dataclass(frozen=True, eq=False)
class Iterate:
    """A batch of bearings of one model on the way to balance, of shape (…).

    ``displacement`` (…, 5); ``ball`` (u, …, n): unknowns of the balls that are solved;
    ``parts``: the states that turn, and those at rest, whose balls have no step of their own.
    """

    parts: Parts
    displacement: Array
    ball: Array

    @cached_property
    def _linear(self) -> list[Linear]:
        d, x = self._states()
        return [linearise(p, d[k], x[:, k], np.full(len(k), p.full)) for k, p in self.parts]

    def _joined(self, each: Callable[[Problem, Linear], NDArray[Any]]) -> Any:
        """Values of the states of each part (s, …), as one batch (…, …)."""
        shape = self.displacement.shape[:-1]
        values = [each(p, linear) for (_, p), linear in zip(self.parts, self._linear, strict=True)]
        whole = np.empty((math.prod(shape), *values[0].shape[1:]), values[0].dtype)
        for (k, _), value in zip(self.parts, values, strict=True):
            whole[k] = value
        return whole.reshape((*shape, *values[0].shape[1:]))

    @cached_property
    def load(self) -> Array:
        """Of the rings with the balls settled to first order (…, 5) [N, N·m]."""
        return self._joined(lambda p, linear: linear.load)

    @cached_property
    def stiffness(self) -> Array:
        """Of the rings with the balls following (…, 5, 5)."""
        return self._joined(lambda p, linear: linear.stiffness)

    @property
    def error(self) -> Array:
        """Largest imbalance of a ball over the largest ball load (…), NaN without a state."""
        return self._joined(lambda p, linear: linear.error)

    @property
    def pressure(self) -> Array:
        """Largest of both races (…) [Pa]."""
        return self._joined(_pressure)

    @property
    def inner_load(self) -> Array:
        """Of the balls (…, n) [N]."""
        return self._joined(lambda p, linear: linear.balance.inner_load)

    def moved(self, displacement: Array) -> Iterate:
        """Rings placed there, every ball one Newton step on."""
        still = self._joined(lambda p, linear: np.moveaxis(linear.still, 0, 1))
        step = np.moveaxis(still, -2, 0) + self.along(displacement - self.displacement)
        return self.at(displacement, self.ball + step)

    def at(self, displacement: Array, ball: Array) -> Iterate:
        """Rings and balls placed there."""
        return replace(self, displacement=displacement, ball=ball)

    def along(self, change: Array) -> Array:
        """What balls do with a ``change`` (…, 5) of the displacement (2, …, n)."""
        step, dd = np.empty(self.ball.shape), change.reshape(-1, 5)
        flat = step.reshape(len(step), len(dd), -1)
        for (k, _), linear in zip(self.parts, self._linear, strict=True):
            flat[:, k] = linear.along(dd[k])
        return step

    def follows(self, before: Iterate) -> Flags:
        """Where every ball is on the physical branch and no angle has turned far (…)."""
        near = self._joined(_sound)
        flat = near.reshape(-1)
        for k, problem in self.parts:
            if problem.placed:
                pair = [problem.faced(d[k], x[:, k]) for d, x in (before._states(), self._states())]
                for then, now in zip(*pair, strict=True):
                    flat[k] &= ~turned_far(then, now, LONGEST_TURN).any(axis=-1)
        return np.asarray(near)

    def _states(self) -> tuple[Array, Array]:
        """Displacements (s, 5) and balls (2, s, n), the batch as one list."""
        d = self.displacement.reshape(-1, 5)
        return d, self.ball.reshape(len(self.ball), len(d), -1)


def iterate(state: BearingState, assembly: Callable[[Geometry], Assembly]) -> Iterate:
    """A solved batch as an iterate; ``assembly`` says which of its balls are solved.

    The first balls of the state are taken for those of the assembly.
    """
    parts = parts_of(state.operation, assembly)
    balls = parts[0][1].assembly.balls
    return Iterate(parts, state.displacement, state.ball_centre[..., :balls])


def parts_of(operation: Operation, assembly: Callable[[Geometry], Assembly]) -> Parts:
    """States at given displacements that turn, and those at rest."""
    whole = replace(Problem.of(operation, assembly), free=np.zeros(5, dtype=bool))
    turn = turns(whole.geometry, operation.speed)
    groups = ((np.flatnonzero(turn == turning), turning) for turning in (True, False))
    return tuple((k, replace(whole.take(k), turning=turning)) for k, turning in groups if k.size)


def _pressure(problem: Problem, linear: Linear) -> Array:
    g, balance = problem.geometry, linear.balance
    inner, outer = balance.inner_load.max(axis=-1), balance.outer_load.max(axis=-1)
    return np.maximum(g.inner.peak_pressure(inner), g.outer.peak_pressure(outer))


def _sound(problem: Problem, linear: Linear) -> Flags:
    """Where there is a state, every ball on the physical branch (s,)."""
    if not problem.turning:
        return np.isfinite(linear.error)
    return np.asarray((linear.fold > 0.0) & (linear.balance.outer_load > 0.0).all(axis=-1))


@dataclass(frozen=True, eq=False, slots=True)
class Settled:
    """What ``Iterate`` does step by step, the balls in balance at every place of the rings.

    By the compiled solver: dearer for one bearing by itself, for which that must be loaded, several
    times cheaper for thousands of iterations. ``load`` (…, 5), ``stiffness`` (…, 5, 5); ``error``
    (…): 0 where there is a state, else NaN.
    """

    parts: Parts
    displacement: Array
    ball: Array
    load: Array
    stiffness: Array
    error: Array

    def moved(self, displacement: Array) -> Settled:
        """Rings at ``displacement`` (…, 5), balls sought from where they are."""
        there = replace(
            self,
            displacement=displacement,
            ball=self.ball.copy(),
            load=self.load.copy(),
            stiffness=self.stiffness.copy(),
            error=self.error.copy(),
        )
        moved = (self.displacement != displacement).any(axis=-1).reshape(-1)
        rows = [(k, p, np.flatnonzero(moved[k])) for k, p in self.parts]
        there._solve([(k[own], p.take(own)) for k, p, own in rows if own.size], near=True)
        return there

    def _solve(self, parts: Iterable[tuple[Index, Problem]], *, near: bool) -> None:
        """Fill in the states of some parts; ``near``: balls are close to where they are."""
        count = self.error.size
        d, x = self.displacement.reshape(count, 5), self.ball.reshape(len(self.ball), count, -1)
        load, stiffness = self.load.reshape(count, 5), self.stiffness.reshape(count, 5, 5)
        for k, problem in parts:
            found = one_by_one(problem, d[k], x[:, k] if near else None)[0]
            x[:, k], load[k], stiffness[k] = found.ball, found.load, found.stiffness
            self.error.reshape(count)[k] = np.where(found.exists, 0.0, np.nan)

    def follows(self, before: Settled) -> Flags:
        """Where there is a state: each is found by itself if its neighbour leads astray (…)."""
        return np.asarray(np.isfinite(self.error))


def settled(operation: Operation, assembly: Callable[[Geometry], Assembly]) -> Settled:
    """Bearings at given displacements; ``assembly`` says which of their balls are solved."""
    parts, shape = parts_of(operation, assembly), operation.shape
    ball = np.zeros((parts[0][1].unknowns, *shape, parts[0][1].assembly.balls))
    blank = np.zeros((*shape, 5)), np.zeros((*shape, 5, 5)), np.zeros(shape)
    there = Settled(parts, operation.displacement.reshape(*shape, 5), ball, *blank)
    there._solve(parts, near=False)
    return there
