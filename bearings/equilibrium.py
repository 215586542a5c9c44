"""The physical state of a bearing under a given load, a given displacement, or a mix of both.

Two stages (theory: solving). With the gyroscopic moment off and the centrifugal force frozen the
problem is convex: damped Newton finds its one solution from anywhere. The real angle dependence
and the gyroscopic moment are then switched on by a blend t = 0 … 1, and the state is followed; a
path that ends before t = 1 (a fold, a jump of a contact, a ball lifted off) has no physical end,
which is an outcome, not a number.

All states of a batch advance together; those that are done drop out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearings.ball import Balance, Settled, settled, turning_balance
from bearings.constants import EPS
from bearings.convex_stage import convex_state
from bearings.free_motion import beyond
from bearings.last_digits import after_step
from bearings.plane import Pair, dot, turned_far
from bearings.problem import (
    FIRST_BLEND,
    FIRST_FREE,
    JUMP,
    LONGEST_TURN,
    MOST_FREE_MOTIONS,
    NEWTON_STEPS,
    ON_THE_WAY,
    QUICK_STEPS,
    ROUNDING,
    SHORTEST_BLEND,
    TOLERANCE,
    Index,
    Problem,
)
from bearings.rest import resting_balance
from bearings.ring import rows

Array = NDArray[np.float64]
PLAINLY_REGULAR = 1e-14  # determinant of K over its largest entry
SINGULAR = 1e-13  # least singular value of K over its largest entry: there it is rounding
Answers = tuple[Array, Array, NDArray[np.str_], "Linear | None"]


@dataclass(frozen=True, eq=False, slots=True)
class Linear:
    """Balls linearised at (d, X): the Newton step follows from it.

    ``balls``: each ball eliminated; ``ring_load`` (s, 5) at the point itself; ``fold`` (s,): the
    smallest ball determinant, positive on the physical branch; ``error`` (s,): scaled residual of
    balls and ring.
    """

    balance: Balance
    balls: Settled
    ring_load: Array
    fold: Array
    error: Array


@dataclass(frozen=True, eq=False, slots=True)
class Solution:
    """d (s, 5), X (2, s, n), balance there, tangent (s, 5, 5), residual, outcome word (s,)."""

    displacement: Array
    ball: Array
    balance: Balance
    ring_load: Array
    stiffness: Array
    residual: Array
    outcome: NDArray[np.str_]


def solve(
    problem: Problem, displacement: Array, guess: Array | None = None, *, compiled: bool = False
) -> Solution:
    """The physical state of every problem, started at ``displacement`` (s, 5).

    ``guess`` (2, s, n): ball centres near the solution at full blend (a previous state of a
    sweep); where following from it fails, the two-stage solve decides. ``compiled``: one state
    after the other instead of all together.
    """
    if compiled:
        d, x, outcome, linear = _one_by_one(problem, displacement, guess)
    else:
        d, x, outcome, linear = _together(problem, displacement, guess)
    if linear is None:
        linear = linearise(problem, d, x, np.ones(len(d)))
    d, x, balance, ring_load = _last_digits(problem, d, x, linear, outcome == "")
    return Solution(
        displacement=d,
        ball=x,
        balance=balance,
        ring_load=ring_load,
        stiffness=tangent(problem, linear.balls),
        residual=linear.error,
        outcome=outcome,
    )


def _one_by_one(problem: Problem, displacement: Array, guess: Array | None) -> Answers:
    """Compiled; what is refused so is looked for together, where free motions are followed."""
    from bearings.compiled.states import compiled_states

    answer = compiled_states(problem, displacement, guess)
    d, x, outcome = answer.displacement, answer.ball, _words(answer.found)
    missing = np.flatnonzero(~answer.found)
    if missing.size:
        found = _together(problem.take(missing), displacement[missing], None)
        d[missing], x[:, missing], outcome[missing] = found[:3]
    return d, x, outcome, None


def _together(problem: Problem, displacement: Array, guess: Array | None) -> Answers:
    """(d, X), the outcome of every state, and its linearisation if that is known."""
    states = len(problem.speed)
    d, x = displacement.copy(), np.zeros((2, states, problem.ring.balls))
    done, linear = np.zeros(states, dtype=bool), None
    if problem.turning and guess is not None:
        d, x, done, linear = _correct(problem, d, guess, np.ones(states))[:4]
    outcome = _words(done)
    cold = np.flatnonzero(~done)
    if cold.size:
        part, linear = problem.take(cold), None
        d[cold], x[:, cold], reached = convex_state(part, displacement[cold])
        found = reached
        if problem.turning:
            d[cold], x[:, cold], found = _blended(part, d[cold], x[:, cold], reached)
        outcome[cold] = np.where(reached, _words(found), "overloaded")
    return d, x, outcome, linear


def _words(done: NDArray[np.bool_]) -> NDArray[np.str_]:
    return np.where(done, "", "no equilibrium").astype("<U16")


def linearise(problem: Problem, d: Array, x: Array, blend: Array) -> Linear:
    """Balance and scaled error at (d, X); at rest X plays no part."""
    model, a = problem.model, problem.centres(d)
    centre = (a[0], a[1])
    if problem.turning:
        squared = problem.speed[:, None] ** 2
        balance = turning_balance(
            model.constants, model.numbers, centre, (x[0], x[1]), squared, blend[:, None], 1.0
        )
        balls = settled(balance)
    else:
        balance, balls = resting_balance(model.constants, centre)
    ring_load = problem.ring.load(np.stack(balance.action))
    return Linear(
        balance=balance,
        balls=balls,
        ring_load=ring_load,
        fold=balls.fold.min(axis=-1),
        error=_error(problem, balance, ring_load),
    )


def tangent(problem: Problem, balls: Settled) -> Array:
    """∂f/∂d with the balls following the ring, all of Fc and Mg included (s, 5, 5)."""
    return problem.ring.stiffness(rows(balls.tangent))


def _last_digits(
    problem: Problem, d: Array, x: Array, linear: Linear, found: NDArray[np.bool_]
) -> tuple[Array, Array, Balance, Array]:
    """(d, X), balance and ring load, freed from what rounding of the lengths has left in them."""
    exact = _error(problem, linear.balance, linear.ring_load, rounding=0.0)
    left = found & (exact >= TOLERANCE)
    if not left.any():
        return d, x, linear.balance, linear.ring_load
    dd, dx = _step(problem, linear)
    dd, dx = np.where(left[:, None], dd, 0.0), np.where(left[:, None], dx, 0.0)
    part = tangent(problem, linear.balls) @ dd[..., None]
    load = problem.ring.load(np.stack(linear.balls.action)) + part[..., 0]
    ring_load = np.where(left[:, None], load, linear.ring_load)
    there = d + dd, x + dx
    return *there, after_step(problem, linear.balance, there, (dd, dx)), ring_load


def _error(
    problem: Problem, balance: Balance, ring_load: Array, rounding: float = ROUNDING
) -> Array:
    """Largest scaled residual of balls and ring but for some roundings of the lengths."""
    g = problem.model.geometry
    largest = np.maximum(balance.outer_load, balance.inner_load).max(axis=-1)
    reach = g.inner_reach + g.outer_reach
    slope = 1.5 * (g.inner.stiffness**2 * np.maximum(largest, 1e-300)) ** (1.0 / 3.0)
    noise = rounding * EPS * reach * slope
    ball = np.maximum(*np.abs(balance.residual)).max(axis=-1) / (
        largest + noise / TOLERANCE + 1e-300
    )
    miss = np.abs((ring_load - problem.load) / problem.scale)[:, problem.free]
    if not miss.size:
        return ball
    count = g.balls
    size = np.abs(problem.load / problem.scale).max(axis=-1) + 1e-3 * count * largest
    ring = miss.max(axis=-1) / (size + count * noise / TOLERANCE + 1e-300)
    return np.maximum(ball, ring)


def _step(problem: Problem, linear: Linear) -> tuple[Array, Array]:
    """Newton step (dd, dX) of balls and ring together."""
    balls, free = linear.balls, problem.free
    dd = np.zeros_like(problem.load)
    if free.any():
        scale = problem.scale[free]
        gap = (problem.load - problem.ring.load(np.stack(balls.action)))[:, free] / scale
        k = tangent(problem, balls)[:, free][:, :, free] / scale / scale[:, None]
        dd[:, free] = _solve(k, gap) / scale
    axial, radial = problem.ring.moved(dd)
    still, follow = balls.still, balls.follow
    return dd, np.stack([still[k] + dot(follow[k], (axial, radial)) for k in (0, 1)])


def _solve(k: Array, gap: Array) -> Array:
    """K⁻¹ gap, zero where K is singular to rounding."""
    largest = np.abs(k).max(axis=(1, 2), keepdims=True) + 1e-300
    part = k / largest
    regular = np.abs(np.linalg.det(part)) > PLAINLY_REGULAR
    soft = np.flatnonzero(~regular & np.isfinite(part).all(axis=(1, 2)))
    if soft.size:
        regular[soft] = np.linalg.svd(part[soft], compute_uv=False)[:, -1] > SINGULAR
    safe = np.where(regular[:, None, None], k, np.eye(k.shape[-1]))
    return np.where(regular[:, None], np.linalg.solve(safe, gap[..., None])[..., 0], 0.0)


def _correct(
    problem: Problem, d: Array, x: Array, blend: Array
) -> tuple[Array, Array, NDArray[np.bool_], Linear, NDArray[np.int_]]:
    """Plain Newton at ``blend`` from a point close by.

    Returns new (d, X), success, the linearisation there, and the iterations used. Success means:
    converged, no angle turned far, every ball on the outer race, no fold and no jump passed.
    """
    before = _segments(problem, d, x)
    d, x = d.copy(), x.copy()
    used = np.zeros(len(d), dtype=int)
    needed = np.where(blend < 1.0, ON_THE_WAY, TOLERANCE)
    linear = linearise(problem, d, x, blend)
    first, moving = linear.balance, linear.error >= needed
    for _ in range(NEWTON_STEPS):
        if not moving.any():
            break
        used += moving
        dd, dx = _step(problem, linear)
        d += np.where(moving[:, None], dd, 0.0)
        x += np.where(moving[:, None], dx, 0.0)
        linear = linearise(problem, d, x, blend)
        moving = linear.error >= needed
    good = ~moving & (linear.fold > 0.0)
    for then, now in zip(before, _segments(problem, d, x), strict=True):
        good &= ~turned_far(then, now, LONGEST_TURN).any(axis=-1)
    good &= (linear.balance.outer_load > 0.0).all(axis=-1)
    if not problem.model.one_branch:
        good &= ~_jumped(problem.model.constants.ball_diameter, first, linear.balance).any(axis=-1)
    free = problem.free
    if free.any():
        k = tangent(problem, linear.balls)[:, free][:, :, free]
        good &= np.linalg.det(_relative(k, problem.scale[free])) > 0.0
    return d, x, good, linear, used


def _jumped(diameter: float, before: Balance, now: Balance) -> NDArray[np.bool_]:
    """Whether an inner contact (s, n) has opened or closed with a moment that does not fade."""
    changed = (before.inner_load > 0.0) != (now.inner_load > 0.0)
    moment = np.maximum(np.abs(before.gyroscopic_moment), np.abs(now.gyroscopic_moment))
    largest = np.maximum(now.outer_load, now.inner_load).max(axis=-1, keepdims=True)
    return changed & (2.0 * moment > JUMP * diameter * largest)


def _relative(k: Array, scale: Array) -> Array:
    """K with all freedoms as lengths, divided by its largest entry."""
    k = k / scale / scale[:, None]
    return k / (np.abs(k).max(axis=(1, 2), keepdims=True) + 1e-300)


def _segments(problem: Problem, d: Array, x: Array) -> tuple[Pair, Pair]:
    """From the outer groove centre to the ball, and on to the inner groove centre."""
    inner = problem.centres(d) - x
    return (x[0], x[1]), (inner[0], inner[1])


def _blended(
    problem: Problem, d: Array, x: Array, done: NDArray[np.bool_]
) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Follow the states that are ``done`` at blend 0 to the full problem."""
    blend, stride = np.zeros(len(d)), np.full(len(d), FIRST_BLEND)
    freed = np.zeros(len(d), dtype=int)
    while True:
        todo = np.flatnonzero(done & (blend < 1.0) & (stride >= SHORTEST_BLEND))
        if not todo.size:
            stuck = np.flatnonzero(done & (blend < 1.0) & (freed < MOST_FREE_MOTIONS))
            freed[stuck] += 1
            if not _free(problem, d, x, blend, stride, stuck):
                break
            continue
        target = np.minimum(1.0, blend[todo] + stride[todo])
        new_d, new_x, good, _, used = _correct(problem.take(todo), d[todo], x[:, todo], target)
        won = todo[good]
        d[won], x[:, won], blend[won] = new_d[good], new_x[:, good], target[good]
        stride[won] *= np.where(used[good] <= QUICK_STEPS, 2.0, 1.0)
        stride[todo[~good]] *= 0.25
    return d, x, done & (blend >= 1.0)


def _free(problem: Problem, d: Array, x: Array, blend: Array, stride: Array, stuck: Index) -> bool:
    """Moves what no load holds to where another ball takes part; whether any state goes on."""
    moved = False
    for k in stuck:
        part = problem.take(np.array([k]))
        linear = linearise(part, d[k : k + 1], x[:, k : k + 1], blend[k : k + 1])
        there = beyond(part, d[k], x[:, k], linear.balance)
        if there is None:
            continue
        target = np.minimum(1.0, blend[k : k + 1] + FIRST_FREE)
        new_d, new_x, good = _correct(part, there[None], x[:, k : k + 1], target)[:3]
        if good[0]:
            d[k], x[:, k], blend[k], stride[k] = new_d[0], new_x[:, 0], target[0], FIRST_FREE
            moved = True
    return moved
