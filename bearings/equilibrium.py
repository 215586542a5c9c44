"""The physical state of a bearing under a given load, a given displacement, or a mix of both.

Two stages (theory: solving). With the gyroscopic moment off and the centrifugal force frozen the
problem is convex: damped Newton finds its one solution from anywhere. The real angle dependence
and the gyroscopic moment are then switched on by a blend t = 0 … 1, and the state is followed; a
path that folds back before t = 1 has no physical end, which is an outcome, not a number.

All states of a batch advance together; those that are done drop out.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bearings.ball import Balance, BallModel, resting_balance, turning_balance
from bearings.convex import Reaction, reaction, resting_reaction, resting_seat, seat
from bearings.ring import Ring

Array = NDArray[np.float64]
Index = NDArray[np.intp]

TOLERANCE = 1e-11  # of the largest ball load (ball balance) and ring load (ring balance)
LONGEST_TURN = 0.15  # rad a contact angle may move in one step of the blend
SHORTEST_BLEND = 1.0 / 512.0
NEWTON_STEPS = 8
EPS = float(np.finfo(float).eps)


@dataclass(frozen=True, slots=True)
class Problem:
    """States to find: all at rest or all turning.

    ``origin`` (2, s): A at zero displacement; ``speed`` (s,) [rad/s]; ``load`` (s, 5) is met on
    the freedoms where ``free`` (5,) is true, the displacement is kept on the others.
    """

    model: BallModel
    ring: Ring
    origin: Array
    speed: Array
    load: Array
    free: NDArray[np.bool_]
    turning: bool

    def take(self, index: Index) -> Problem:
        """The same problem for some of its states."""
        return replace(
            self,
            origin=self.origin[:, index],
            speed=self.speed[index],
            load=self.load[index],
        )

    @property
    def scale(self) -> Array:
        """What makes the five freedoms lengths: 1, 1, 1, Ri, Ri [m]."""
        radius = self.model.geometry.centre_radius
        return np.array([1.0, 1.0, 1.0, radius, radius])


@dataclass(frozen=True, slots=True)
class Linear:
    """Balls linearised at (d, X): the Newton step follows from it.

    ``ring_load`` (s, 5) at the point itself; ``fold`` (s,): the smallest ball determinant, positive
    on the physical branch; ``error`` (s,): scaled residual of balls and ring.
    """

    balance: Balance
    ball_inverse: Array
    ring_load: Array
    fold: Array
    error: Array


@dataclass(frozen=True, slots=True)
class Solution:
    """d (s, 5), X (2, s, n), the balance there, tangent (s, 5, 5), an outcome word per state."""

    displacement: Array
    ball: Array
    balance: Balance
    ring_load: Array
    stiffness: Array
    outcome: NDArray[np.str_]


def solve(problem: Problem, displacement: Array, guess: Array | None = None) -> Solution:
    """The physical state of every problem, started at ``displacement`` (s, 5).

    ``guess`` (2, s, n): ball centres near the solution at full blend (a previous state of a
    sweep); where following from it fails, the two-stage solve decides.
    """
    states = len(problem.speed)
    d, x = displacement.copy(), np.zeros((2, states, problem.ring.balls))
    done, linear = np.zeros(states, dtype=bool), None
    if problem.turning and guess is not None:
        d, x, done, linear = _correct(problem, d, guess, np.ones(states))[:4]
    if not done.all():
        cold = np.flatnonzero(~done)
        part = problem.take(cold)
        d[cold], x[:, cold], done[cold] = _convex(part, displacement[cold])
        if problem.turning:
            d[cold], x[:, cold], done[cold] = _blended(part, d[cold], x[:, cold], done[cold])
        linear = None
    if linear is None:
        linear = linearise(problem, d, x, np.ones(states))
    return Solution(
        displacement=d,
        ball=x,
        balance=linear.balance,
        ring_load=linear.ring_load,
        stiffness=tangent(problem, linear),
        outcome=np.where(done, "", "no equilibrium").astype("<U16"),
    )


def linearise(problem: Problem, d: Array, x: Array, blend: Array) -> Linear:
    """Balance and scaled error at (d, X); at rest X is written to its own place."""
    centre = problem.ring.centres(problem.origin, d)
    if problem.turning:
        balance = turning_balance(problem.model, centre, x, problem.speed[:, None], blend[:, None])
    else:
        balance, seat = resting_balance(problem.model, centre)
        x[...] = seat
    inverse, determinant = _inverse(balance.dresidual_dx)
    ring_load = problem.ring.load(balance.action)
    return Linear(
        balance=balance,
        ball_inverse=inverse,
        ring_load=ring_load,
        fold=determinant.min(axis=-1),
        error=_error(problem, balance, ring_load),
    )


def tangent(problem: Problem, linear: Linear) -> Array:
    """∂f/∂d with the balls following the ring, all of Fc and Mg included (s, 5, 5)."""
    balance = linear.balance
    follow = _product(linear.ball_inverse, balance.dresidual_da)
    return problem.ring.stiffness(balance.daction_da - _product(balance.daction_dx, follow))


def _product(a: Array, b: Array) -> Array:
    """Matrix product of component-first small matrices."""
    return np.einsum("ab...,bc...->ac...", a, b)


def _applied(a: Array, v: Array) -> Array:
    """Component-first matrix times vector."""
    return np.einsum("ab...,b...->a...", a, v)


def _error(problem: Problem, balance: Balance, ring_load: Array) -> Array:
    """Largest scaled residual of balls and ring; rounding of the lengths is not counted."""
    g = problem.model.geometry
    largest = np.maximum(balance.outer_load, balance.inner_load).max(axis=-1)
    reach = g.inner_reach + g.outer_reach
    slope = 1.5 * (g.inner.stiffness**2 * np.maximum(largest, 1e-300)) ** (1.0 / 3.0)
    noise = 16.0 * EPS * reach * slope
    ball = np.abs(balance.residual).max(axis=(0, -1)) / (largest + noise / TOLERANCE + 1e-300)
    miss = np.abs((ring_load - problem.load) / problem.scale)[:, problem.free]
    if not miss.size:
        return ball
    count = g.balls
    size = np.abs(problem.load / problem.scale).max(axis=-1) + 1e-3 * count * largest
    ring = miss.max(axis=-1) / (size + count * noise / TOLERANCE + 1e-300)
    return np.maximum(ball, ring)


def _inverse(matrix: Array) -> tuple[Array, Array]:
    """Inverse and determinant of 2×2 matrices, component first; singular ones give zero."""
    (a, b), (c, d) = matrix
    determinant = a * d - b * c
    safe = np.where(determinant != 0.0, determinant, np.inf)
    return np.array([[d, -b], [-c, a]]) / safe, determinant


def _step(problem: Problem, linear: Linear) -> tuple[Array, Array]:
    """Newton step (dd, dX) of balls and ring together."""
    balance, free = linear.balance, problem.free
    dd = np.zeros_like(problem.load)
    if free.any():
        scale = problem.scale[free]
        settle = -_applied(linear.ball_inverse, balance.residual)
        correction = problem.ring.load(_applied(balance.daction_dx, settle))
        gap = (problem.load - linear.ring_load - correction)[:, free] / scale
        k = tangent(problem, linear)[:, free][:, :, free] / scale / scale[:, None]
        dd[:, free] = _solve(k, gap) / scale
    moved = np.einsum("cjn,sj->csn", problem.ring.spread, dd)
    pull = balance.residual + _applied(balance.dresidual_da, moved)
    return dd, -_applied(linear.ball_inverse, pull)


def _solve(k: Array, gap: Array) -> Array:
    """K⁻¹ gap, zero where K is singular to rounding."""
    largest = np.abs(k).max(axis=(1, 2), keepdims=True) + 1e-300
    regular = np.abs(np.linalg.det(k / largest)) > 1e-14
    safe = np.where(regular[:, None, None], k, np.eye(k.shape[-1]))
    return np.where(regular[:, None], np.linalg.solve(safe, gap[..., None])[..., 0], 0.0)


def _downhill(problem: Problem, k: Array, gap: Array) -> Array:
    """Newton direction of the convex stage with soft directions stiffened, its length bounded."""
    g = problem.model.geometry
    values, vectors = np.linalg.eigh(0.5 * (k + k.swapaxes(1, 2)))
    reference = g.balls * g.series_stiffness * np.sqrt(1e-3 * g.free_distance)
    values = np.maximum(values, 1e-7 * reference)
    step = (vectors @ ((vectors.swapaxes(1, 2) @ gap[..., None]) / values[..., None]))[..., 0]
    longest = np.abs(step).max(axis=1, keepdims=True)
    return step * np.minimum(1.0, 0.2 * g.free_distance / np.maximum(longest, 1e-300))


def _convex(problem: Problem, start: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
    """(d, X) of the convex stage and whether it was reached (it always should)."""
    d = start.copy()
    x, answer = _settled(problem, d, None)
    if not problem.free.any():
        return d, x, np.ones(len(d), dtype=bool)
    done = np.zeros(len(d), dtype=bool)
    for _ in range(100):
        gap, k, done = _ring_balance(problem, answer)
        todo = np.flatnonzero(~done)
        if not todo.size:
            break
        part = problem.take(todo)
        step = np.zeros((todo.size, 5))
        scale = problem.scale[problem.free]
        step[:, problem.free] = _downhill(problem, k[todo], gap[todo]) / scale
        d[todo], x[:, todo] = _searched(part, d[todo], x[:, todo], answer.energy[todo], step)
        x[:, todo], fresh = _settled(part, d[todo], x[:, todo])
        for old, new in zip(answer, fresh, strict=True):
            old[..., todo, :] = new
    return d, x, done


def _settled(problem: Problem, d: Array, near: Array | None) -> tuple[Array, Reaction]:
    """Ball centres at displacement d with the push frozen, and what the balls do to the ring."""
    g, centre = problem.model.geometry, problem.ring.centres(problem.origin, d)
    if not problem.turning:
        return resting_seat(g, centre), resting_reaction(g, centre)
    push = problem.model.nominal_centrifugal(problem.speed)[:, None]
    x = seat(g, centre, push, near)
    return x, reaction(g, centre, x, push)


def _ring_balance(problem: Problem, answer: Reaction) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Load still missing and tangent, freedoms as lengths; and where nothing is missing."""
    g, free, scale = problem.model.geometry, problem.free, problem.scale[problem.free]
    action = np.concatenate([answer.force, g.centre_radius * answer.force[:1]])
    slope = np.concatenate([answer.slope, g.centre_radius * answer.slope[:1]])
    gap = (problem.load - problem.ring.load(action))[:, free] / scale
    k = problem.ring.stiffness(slope)[:, free][:, :, free] / scale / scale[:, None]
    carried = g.balls * np.hypot(*answer.force).max(axis=-1)
    size = np.abs(problem.load / problem.scale).max(axis=-1) + 1e-3 * carried
    noise = 16.0 * EPS * (g.inner_reach + g.outer_reach) * np.abs(k).max(axis=(1, 2))
    needed = 1e-6 if problem.turning else 0.1 * TOLERANCE
    return gap, k, np.abs(gap).max(axis=-1) < needed * size + noise


def _searched(
    problem: Problem, d: Array, x: Array, energy: Array, step: Array
) -> tuple[Array, Array]:
    """A step along ``step``, halved until the potential falls; balls settle at every try."""
    count = problem.model.geometry.balls / problem.ring.balls

    def potential(energy: Array, d: Array) -> Array:
        work = (problem.load * d)[:, problem.free].sum(axis=-1)
        return np.asarray(count * energy.sum(axis=-1) - work)

    g, before = problem.model.geometry, potential(energy, d)
    largest = np.abs(problem.load / problem.scale).max(axis=-1)
    slack = 64.0 * EPS * (np.abs(before) + largest * (g.inner_reach + g.outer_reach))
    length = np.ones(len(d))
    trial = d
    for _ in range(40):
        trial = d + length[:, None] * step
        x, answer = _settled(problem, trial, x)
        good = potential(answer.energy, trial) <= before + slack
        if good.all():
            break
        length = np.where(good, length, 0.5 * length)
    return trial, x


def _correct(
    problem: Problem, d: Array, x: Array, blend: Array
) -> tuple[Array, Array, NDArray[np.bool_], Linear, int]:
    """Plain Newton at ``blend`` from a point close by.

    Returns new (d, X), success, the linearisation there, and the iterations used. Success means:
    converged, no angle turned far, every ball on the outer race, no fold passed.
    """
    start = _angles(problem, d, x)
    d, x = d.copy(), x.copy()
    for used in range(NEWTON_STEPS + 1):
        linear = linearise(problem, d, x, blend)
        moving = linear.error >= TOLERANCE
        if not moving.any() or used == NEWTON_STEPS:
            break
        dd, dx = _step(problem, linear)
        d += np.where(moving[:, None], dd, 0.0)
        x += np.where(moving[:, None], dx, 0.0)
    turned = np.abs(_angles(problem, d, x) - start).max(axis=(0, -1))
    good = ~moving & (linear.fold > 0.0) & (turned < LONGEST_TURN)
    good &= (linear.balance.outer_load > 0.0).all(axis=-1)
    free = problem.free
    if free.any():
        k = tangent(problem, linear)[:, free][:, :, free]
        good &= np.linalg.det(_relative(k, problem.scale[free])) > 0.0
    return d, x, good, linear, used


def _relative(k: Array, scale: Array) -> Array:
    """K with all freedoms as lengths, divided by its largest entry."""
    k = k / scale / scale[:, None]
    return k / (np.abs(k).max(axis=(1, 2), keepdims=True) + 1e-300)


def _angles(problem: Problem, d: Array, x: Array) -> Array:
    """Outer angle, and direction from the ball to the inner groove centre: (2, s, n)."""
    inner = problem.ring.centres(problem.origin, d) - x
    return np.array([np.arctan2(x[0], x[1]), np.arctan2(inner[0], inner[1])])


def _blended(
    problem: Problem, d: Array, x: Array, done: NDArray[np.bool_]
) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Follow the states that are ``done`` at blend 0 to the full problem."""
    blend, stride = np.zeros(len(d)), np.full(len(d), 0.5)
    while True:
        todo = np.flatnonzero(done & (blend < 1.0) & (stride >= SHORTEST_BLEND))
        if not todo.size:
            break
        target = np.minimum(1.0, blend[todo] + stride[todo])
        new_d, new_x, good, _, used = _correct(problem.take(todo), d[todo], x[:, todo], target)
        won = todo[good]
        d[won], x[:, won], blend[won] = new_d[good], new_x[:, good], target[good]
        stride[won] *= 2.0 if used <= 5 else 1.0
        stride[todo[~good]] *= 0.25
    return d, x, done & (blend >= 1.0)
