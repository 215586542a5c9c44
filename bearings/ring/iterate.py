"""Bearings within a larger Newton iteration: balls take one step with every move of their rings.

The outer iteration moves rings on springs, with each ball eliminated by its current linearisation;
balls and rings converge together, instead of the balls anew for every place of a ring
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
from bearings.ring.problem import Problem
from bearings.ring.state import BearingState
from bearings.ring.tolerances import LONGEST_TURN

Parts = tuple[tuple[Index, Problem], ...]


@dataclass(frozen=True, eq=False)
class Iterate:
    """A batch of bearings of one model during the iteration, of shape (…).

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

    def _joined(self, get: Callable[[Problem, Linear], NDArray[Any]]) -> Any:
        """Join values of the states of each part (s, …) to one batch (…, …)."""
        shape = self.displacement.shape[:-1]
        values = [get(p, linear) for (_, p), linear in zip(self.parts, self._linear, strict=True)]
        joined = np.empty((math.prod(shape), *values[0].shape[1:]), values[0].dtype)
        for (k, _), value in zip(self.parts, values, strict=True):
            joined[k] = value
        return joined.reshape((*shape, *values[0].shape[1:]))

    @cached_property
    def load(self) -> Array:
        """Load of the rings with the balls in balance to first order (…, 5) [N, N·m]."""
        return self._joined(lambda p, linear: linear.load)

    @cached_property
    def stiffness(self) -> Array:
        """Tangent of the rings with the balls following (…, 5, 5)."""
        return self._joined(lambda p, linear: linear.stiffness)

    @property
    def error(self) -> Array:
        """Largest imbalance of a ball over the largest ball load (…), NaN without a state."""
        return self._joined(lambda p, linear: linear.error)

    @property
    def pressure(self) -> Array:
        """Largest contact pressure of both races (…) [Pa]."""
        return self._joined(_pressure)

    @property
    def inner_load(self) -> Array:
        """Loads of the balls on the inner race (…, n) [N]."""
        return self._joined(lambda p, linear: linear.balance.inner_load)

    def moved(self, displacement: Array) -> Iterate:
        """Move the rings to ``displacement``, and every ball by one Newton step."""
        still = self._joined(lambda p, linear: np.moveaxis(linear.still, 0, 1))
        step = np.moveaxis(still, -2, 0) + self.along(displacement - self.displacement)
        return self.at(displacement, self.ball + step)

    def at(self, displacement: Array, ball: Array) -> Iterate:
        """Place rings and balls."""
        return replace(self, displacement=displacement, ball=ball)

    def along(self, change: Array) -> Array:
        """Step (u, …, n) of the balls that follow a ``change`` (…, 5) of the displacement."""
        step, dd = np.empty(self.ball.shape), change.reshape(-1, 5)
        flat = step.reshape(len(step), len(dd), -1)
        for (k, _), linear in zip(self.parts, self._linear, strict=True):
            flat[:, k] = linear.along(dd[k])
        return step

    def follows(self, before: Iterate) -> Flags:
        """Whether every ball is on the physical branch and no angle has turned far (…)."""
        valid = self._joined(_physical)
        flat = valid.reshape(-1)
        for k, problem in self.parts:
            if problem.placed:
                pair = [problem.faced(d[k], x[:, k]) for d, x in (before._states(), self._states())]
                for then, now in zip(*pair, strict=True):
                    flat[k] &= ~turned_far(then, now, LONGEST_TURN).any(axis=-1)
        return np.asarray(valid)

    def _states(self) -> tuple[Array, Array]:
        """Displacements (s, 5) and balls (u, s, n) of the batch as a list."""
        d = self.displacement.reshape(-1, 5)
        return d, self.ball.reshape(len(self.ball), len(d), -1)


def iterate(state: BearingState, assembly: Callable[[Geometry], Assembly]) -> Iterate:
    """Convert a solved batch to an iterate; ``assembly`` selects the balls that are solved.

    The first balls of the state are used for those of the assembly.
    """
    parts = parts_of(state.operation, assembly)
    balls = parts[0][1].assembly.balls
    return Iterate(parts, state.displacement, state.ball_centre[..., :balls])


def parts_of(operation: Operation, assembly: Callable[[Geometry], Assembly]) -> Parts:
    """Split the states, at given displacements, into those that turn and those at rest."""
    problem = replace(Problem.of(operation, assembly), free=np.zeros(5, dtype=bool))
    return tuple(problem.parts(np.ones(len(operation.speed), dtype=bool)))


def _pressure(problem: Problem, linear: Linear) -> Array:
    """Largest contact pressure of each state (s,) [Pa]."""
    g, balance = problem.geometry, linear.balance
    inner, outer = balance.inner_load.max(axis=-1), balance.outer_load.max(axis=-1)
    return np.maximum(g.inner.peak_pressure(inner), g.outer.peak_pressure(outer))


def _physical(problem: Problem, linear: Linear) -> Flags:
    """Whether there is a state with every ball on the physical branch (s,)."""
    if not problem.turning:
        return np.isfinite(linear.error)
    return np.asarray((linear.fold > 0.0) & (linear.balance.outer_load > 0.0).all(axis=-1))


@dataclass(frozen=True, eq=False, slots=True)
class Settled:
    """Counterpart of ``Iterate`` with the balls in balance at every place of the rings.

    It uses the compiled solver: slower for a single bearing, since that must be loaded, several
    times faster for thousands of iterations. ``load`` (…, 5), ``stiffness`` (…, 5, 5); ``error``
    (…): 0 where there is a state, else NaN.
    """

    parts: Parts
    displacement: Array
    ball: Array
    load: Array
    stiffness: Array
    error: Array

    def moved(self, displacement: Array) -> Settled:
        """Move the rings to ``displacement`` (…, 5); balls are solved from their current places."""
        result = replace(
            self,
            displacement=displacement,
            ball=self.ball.copy(),
            load=self.load.copy(),
            stiffness=self.stiffness.copy(),
            error=self.error.copy(),
        )
        changed = (self.displacement != displacement).any(axis=-1).reshape(-1)
        rows = [(k, p, np.flatnonzero(changed[k])) for k, p in self.parts]
        result._solve([(k[index], p.take(index)) for k, p, index in rows if index.size], near=True)
        return result

    def _solve(self, parts: Iterable[tuple[Index, Problem]], *, near: bool) -> None:
        """Solve the states of some parts; ``near``: the balls start from their current places."""
        count = self.error.size
        d, x = self.displacement.reshape(count, 5), self.ball.reshape(len(self.ball), count, -1)
        load, stiffness = self.load.reshape(count, 5), self.stiffness.reshape(count, 5, 5)
        for k, problem in parts:
            solved = one_by_one(problem, d[k], x[:, k] if near else None)
            x[:, k], load[k], stiffness[k] = solved.ball, solved.load, solved.stiffness
            self.error.reshape(count)[k] = np.where(solved.outcome == "", 0.0, np.nan)

    def follows(self, before: Settled) -> Flags:
        """Whether there is a state (…); each is independent of the one ``before``."""
        return np.asarray(np.isfinite(self.error))


def settled(operation: Operation, assembly: Callable[[Geometry], Assembly]) -> Settled:
    """Solve bearings at given displacements; ``assembly`` selects the balls that are solved."""
    parts, shape = parts_of(operation, assembly), operation.shape
    ball = np.zeros((parts[0][1].unknowns, *shape, parts[0][1].assembly.balls))
    blank = np.zeros((*shape, 5)), np.zeros((*shape, 5, 5)), np.zeros(shape)
    result = Settled(parts, operation.displacement.reshape(*shape, 5), ball, *blank)
    result._solve(parts, near=False)
    return result
