"""The physical state of a bearing under a given load, a given displacement, or a mix of both.

Two stages (theory: solving). With the gyroscopic moment off and the centrifugal force frozen the
problem is convex: damped Newton finds its one solution from anywhere. The real angle dependence
and the gyroscopic moment are then switched on by a blend t = 0 … 1, and the state is followed; a
path that ends before t = 1 (a fold, a jump of a contact, a ball lifted off) has no physical end,
which is an outcome, not a number.

All states of a batch advance together; converged ones drop out.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from bearings.arrays import Array, Flags, Words
from bearings.ball.balance import Balance
from bearings.ring import tolerances as tol
from bearings.ring.compiled.states import CompiledStates, compiled_states
from bearings.ring.contacts import Contacts, contacts
from bearings.ring.convex_stage import convex_state
from bearings.ring.followed_stage import corrected, followed
from bearings.ring.linearised import Linear, linearise, newton_step, scaled_error
from bearings.ring.problem import Problem, first_displacement


@dataclass(frozen=True, eq=False, slots=True)
class Solution:
    """Solved states: d (s, 5), ball (u, s, n), balance, K (s, 5, 5), residual, outcome (s,)."""

    displacement: Array
    ball: Array
    balance: Balance
    contacts: Contacts
    ring_load: Array
    stiffness: Array
    residual: Array
    outcome: Words


def solve(
    problem: Problem, displacement: Array, guess: Array | None = None, *, compiled: bool = False
) -> Solution:
    """Find the physical state of every problem, starting at ``displacement`` (s, 5).

    ``guess`` (u, s, n): unknowns of the balls near the solution at full blend (a previous
    state of a sweep); where following from it fails, the two-stage solve decides. ``compiled``: one
    state after the other instead of all together.
    """
    if compiled and problem.compliances is None:
        d, x, _, _, outcome = one_by_one(problem, displacement, guess)
        linear = None
    else:
        d, x, outcome, linear = _together(problem, displacement, guess)
        failed = np.flatnonzero(outcome != "")
        if guess is not None and failed.size:  # a bad guess must not cost a state
            part = problem.take(failed)
            retried = _together(part, first_displacement(part, displacement[failed]), None)
            d[failed], x[:, failed], outcome[failed] = retried[:3]
            linear = None
    if linear is None:
        linear = linearise(problem, d, x, np.full(len(d), problem.full))
    (d, x), balance, touching, ring_load = _last_digits(problem, d, x, linear, outcome == "")
    return Solution(
        displacement=d,
        ball=x,
        balance=balance,
        contacts=touching,
        ring_load=ring_load,
        stiffness=linear.stiffness,
        residual=linear.error,
        outcome=outcome,
    )


def one_by_one(
    problem: Problem, displacement: Array, guess: Array | None, *, chained: bool = False
) -> CompiledStates:
    """Solve by the compiled solver, see ``compiled_states``.

    States that it does not find are solved as a batch, where free motions are followed; and so is
    every bearing whose rings deform, which the compiled solver does not support.
    """
    if problem.compliances is not None:
        start = None if guess is None or guess.shape[1] != len(displacement) else guess
        batch = solve(problem, displacement, start)
        return CompiledStates(
            batch.displacement, batch.ball, batch.ring_load, batch.stiffness, batch.outcome
        )
    solved = compiled_states(problem, displacement, guess, chained=chained)
    missing = np.flatnonzero(solved.outcome)
    if missing.size:
        part = problem.take(missing)
        retried = solve(part, first_displacement(part, displacement[missing]))
        solved.displacement[missing], solved.load[missing] = retried.displacement, retried.ring_load
        solved.ball[:, missing], solved.stiffness[missing] = retried.ball, retried.stiffness
        solved.outcome[missing] = retried.outcome
    return solved


def _together(
    problem: Problem, displacement: Array, guess: Array | None
) -> tuple[Array, Array, Words, Linear | None]:
    """Solve as a batch: (d, X), the outcome of every state, the linearisation if available."""
    states = len(problem.speed)
    d, x = displacement.copy(), np.zeros((problem.unknowns, states, problem.assembly.balls))
    solved, linear = np.zeros(states, dtype=bool), None
    if problem.turning and guess is not None:
        d, x, solved, linear = corrected(problem, d, guess, np.full(states, problem.full))[:4]
        solved &= problem.law.one_branch
    outcome = np.where(solved, "", "no equilibrium")
    cold = np.flatnonzero(~solved)
    if cold.size:
        part, linear = problem.take(cold), None
        d[cold], x[:2, cold], reached = convex_state(part, displacement[cold])
        x[2:, cold], converged = 0.0, reached
        if problem.placed or problem.compliances is not None:
            d[cold], x[:, cold], converged = _followed(part, d[cold], x[:, cold], reached)
        heavy = np.abs(part.load).max(axis=1) > tol.LIGHT
        words = np.where(reached | ~heavy, "no equilibrium", "overloaded")
        outcome[cold] = np.where(converged, "", words)
    return d, x, outcome, linear


def _followed(problem: Problem, d: Array, x: Array, reached: Flags) -> tuple[Array, Array, Flags]:
    """Call ``followed``, and retry failed states as rings with unrestrained motions.

    A load on one or two balls leaves motions of the ring free: any position that balances it is a
    state, and the nearest is taken. This excludes laws whose contacts open and close with a jump.
    """
    start = d.copy(), x.copy()
    d, x, converged, given_up = followed(problem, d, x, reached)
    failed = np.flatnonzero(reached & ~converged & ~given_up & problem.law.one_branch)
    if failed.size:
        part = replace(problem.take(failed), loose=True)
        initial = start[0][failed], start[1][:, failed], np.ones(failed.size, dtype=bool)
        d[failed], x[:, failed], converged[failed], _ = followed(part, *initial)
    return d, x, converged


def _last_digits(
    problem: Problem, d: Array, x: Array, linear: Linear, converged: Flags
) -> tuple[tuple[Array, Array], Balance, Contacts, Array]:
    """Remove rounding of the lengths from (d, X), balance, contacts and ring load."""
    full_error = scaled_error(problem, linear.balance, linear.ring_load, rounding=0.0)
    inexact = converged & (full_error >= tol.TOLERANCE)
    if not inexact.any():
        return (d, x), *contacts(problem, linear.balance, (d, x)), linear.ring_load
    dd, dx = newton_step(problem, linear)
    dd, dx = np.where(inexact[:, None], dd, 0.0), np.where(inexact[:, None], dx, 0.0)
    load = linear.load + (linear.stiffness @ dd[..., None])[..., 0]
    ring_load = np.where(inexact[:, None], load, linear.ring_load)
    touching = contacts(problem, linear.balance, (d, x), (dd, dx))
    return (d + dd, x + dx), *touching, ring_load
