"""Linearisation of balls and ring at given places: the Newton step and the scaled residual.

Each ball is eliminated and acts on the ring as a spring (theory: solving). The path of states and
larger iterations that move the rings (``iterate``) take their steps from here.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from bearings.arrays import Array, Flags, Index
from bearings.ball.balance import Balance, resting_balance, turning_balance
from bearings.ball.condensed import Condensed, condensed
from bearings.ball.potential import rounding_force
from bearings.ring import tolerances as tol
from bearings.ring.assembly import Assembly, full_assembly
from bearings.ring.groove_shifts import ShiftStep, linearised_shifts
from bearings.ring.operation import Operation
from bearings.ring.problem import Problem


@dataclass(frozen=True, eq=False)
class Linear:
    """Balls of an ``assembly`` linearised at (d, X): the Newton step follows from it.

    ``balls``: each ball eliminated; ``ring_load`` (s, 5) at the point itself; ``fold`` (s,): the
    smallest ball determinant, positive on the physical branch; ``error`` (s,): scaled residual of
    balls and ring. ``shifts``: of the grooves of rings that
    deform, likewise eliminated.
    """

    assembly: Assembly
    balance: Balance
    balls: Condensed
    ring_load: Array
    fold: Array
    error: Array
    shifts: ShiftStep | None = None

    @cached_property
    def load(self) -> Array:
        """f (s, 5) with the balls in balance to first order."""
        load = self.assembly.load(self.balls.action)
        return load if self.shifts is None else load + self._by_shift(self.shifts.still)

    @cached_property
    def stiffness(self) -> Array:
        """∂f/∂d with the balls following the ring, all of Fc and Mg included (s, 5, 5)."""
        rigid = self.assembly.stiffness(self.balls.tangent)
        if self.shifts is None:
            return rigid
        columns = [self._by_shift(self.shifts.follow[..., k]) for k in range(5)]
        total = rigid + np.stack(columns, axis=-1)
        if self.shifts.across is None:
            return total
        x, r, tilt = self.shifts.across
        across = self.assembly.stiffness(((*x,), (*r,), (*tilt,)))
        across[:, 0], across[:, :, 0] = 0.0, 0.0
        return total + across

    def _by_shift(self, shift: Array) -> Array:
        """Change of f (s, 5) by a ``shift`` (u, s, n) of the grooves."""
        assert self.shifts is not None
        x, r, tilt = (self.shifts.action_by * shift).sum(axis=1)
        return self.assembly.load((x, r, tilt))

    def _ball_by(self, shift: Array) -> Array:
        """Change dX (2, s, n) by a ``shift`` (u, s, n) of the grooves."""
        assert self.shifts is not None
        return np.asarray((self.shifts.ball_by * shift).sum(axis=1))

    @property
    def still(self) -> Array:
        """Newton step of the balls (u, s, n) at a fixed ring."""
        still = np.stack(self.balls.still)
        if self.shifts is None:
            return still
        return np.concatenate([still + self._ball_by(self.shifts.still), self.shifts.still])

    def along(self, dd: Array) -> Array:
        """Step (u, s, n) of balls that follow the ring by dd (s, 5)."""
        along = followed_by(np.stack(self.balls.follow), self.assembly.moved(dd))
        if self.shifts is None:
            return along
        shift = np.einsum("usnk,sk->usn", self.shifts.follow, dd)
        return np.concatenate([along + self._ball_by(shift), shift])


def linearise(problem: Problem, d: Array, x: Array, blend: Array, *, vary: float = 1.0) -> Linear:
    """Linearise at (d, X); ``vary`` 0 freezes Fc and Mg. At rest X has no influence."""
    g, centre = problem.shifted(x), tuple(problem.centres(d, x))
    t: Any = 0.0
    if problem.placed:
        squared, t = problem.squared[:, None], blend[:, None] if problem.varying else 0.0
        balance = turning_balance(g, problem.law.numbers, centre, (x[0], x[1]), squared, t, vary)
        balls = condensed(balance.forces)
    else:
        balance, balls = resting_balance(g, centre)
    ring_load = problem.assembly.load(balance.forces.action)
    error, shifts = scaled_error(problem, balance, ring_load), None
    if problem.compliances is not None:
        shifts = linearised_shifts(problem, g, centre, x, balance, balls, blend, (t, vary))
        largest = np.maximum(balance.outer_load, balance.inner_load).max(axis=-1)
        noise = tol.ROUNDING * rounding_force(problem.geometry, largest) / tol.TOLERANCE
        error = np.maximum(error, shifts.error / (largest + noise + 1e-300))
    return Linear(
        assembly=problem.assembly,
        balance=balance,
        balls=balls,
        ring_load=ring_load,
        fold=balls.fold.min(axis=-1),
        error=error,
        shifts=shifts,
    )


def reduced(problem: Problem, k: Array) -> Array:
    """Rows and columns of K (s, 5, 5) of the DOF whose load is given, scaled to lengths."""
    scale = problem.scale[problem.free]
    return np.asarray(k[:, problem.free][:, :, problem.free] / scale / scale[:, None])


def scaled_error(
    problem: Problem, balance: Balance, ring_load: Array, rounding: float = tol.ROUNDING
) -> Array:
    """Largest scaled residual of balls and ring, with a tolerance for rounding of the lengths."""
    g = problem.geometry
    largest = np.maximum(balance.outer_load, balance.inner_load).max(axis=-1)
    noise = rounding * rounding_force(g, largest) / tol.TOLERANCE
    ball = np.maximum(*np.abs(balance.forces.residual)).max(axis=-1) / (largest + noise + 1e-300)
    imbalance = np.abs((ring_load - problem.load) / problem.scale)[:, problem.free]
    if not imbalance.size:
        return ball
    size = problem.load_size + g.balls * (1e-3 * largest + noise) + 1e-300
    return np.maximum(ball, imbalance.max(axis=-1) / size)


def newton_step(problem: Problem, linear: Linear) -> tuple[Array, Array]:
    """Newton step (dd, dX) of balls and ring together."""
    free, dd = problem.free, np.zeros_like(problem.load)
    if free.any():
        scale = problem.scale[free]
        gap = (problem.load - linear.load)[:, free] / scale
        k = reduced(problem, linear.stiffness)
        dd[:, free] = _solve(k, gap, loose=problem.loose) / scale
    return dd, linear.still + linear.along(dd)


def followed_by(follow: Array, motion: Array) -> Array:
    """Motion (2, …) of balls that ``follow`` (2, m, …) a ``motion`` (m, …) of their grooves."""
    step = follow[:, 0] * motion[0] + follow[:, 1] * motion[1]
    return step if len(motion) == 2 else step + follow[:, 2] * motion[2]


def _solve(k: Array, gap: Array, *, loose: bool) -> Array:
    """K⁻¹ gap; zero where K is singular to rounding, or the shortest such step if ``loose``."""
    largest = np.abs(k).max(axis=(1, 2), keepdims=True) + 1e-300
    part = k / largest
    regular = np.abs(np.linalg.det(part)) > tol.PLAINLY_REGULAR
    soft = np.flatnonzero(~regular & np.isfinite(part).all(axis=(1, 2)))
    if soft.size:
        regular[soft] = np.linalg.svd(part[soft], compute_uv=False)[:, -1] > tol.SINGULAR
    safe = np.where(regular[:, None, None], k, np.eye(k.shape[-1]))
    step = np.where(regular[:, None], np.linalg.solve(safe, gap[..., None])[..., 0], 0.0)
    if loose and (rest := soft[~regular[soft]]).size:
        step[rest] = (np.linalg.pinv(k[rest], rcond=tol.SINGULAR) @ gap[rest, :, None])[..., 0]
    return step


def frozen_tangents(
    operation: Operation, d: Array, x: Array, exists: Flags
) -> Iterator[tuple[Index, Array]]:
    """Yield indices (k,) and tangents (k, 5, 5) with Fc and Mg constant, of those of the states
    d (s, 5) and X (2, s, n) that exist, ``exists`` (s,), and turn."""
    for index, part in Problem.of(operation, full_assembly).parts(exists):
        if part.turning:
            linear = linearise(part, d[index], x[:, index], np.ones(index.size), vary=0.0)
            yield index, linear.stiffness
