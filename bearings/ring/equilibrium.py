"""The physical state of a bearing under a given load, a given displacement, or a mix of both.

Two stages (theory: solving). With the gyroscopic moment off and the centrifugal force frozen the
problem is convex: damped Newton finds its one solution from anywhere. The real angle dependence
and the gyroscopic moment are then switched on by a blend t = 0 … 1, and the state is followed; a
path that ends before t = 1 (a fold, a jump of a contact, a ball lifted off) has no physical end,
which is an outcome, not a number.

All states of a batch advance together; those that are done drop out.
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
    """d (s, 5), ball (u, s, n), balance, tangent (s, 5, 5), residual, outcome word (s,)."""

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
    """The physical state of every problem, started at ``displacement`` (s, 5).

    ``guess`` (u, s, n): unknowns of the balls near the solution at full blend (a previous
    state of a sweep); where following from it fails, the two-stage solve decides. ``compiled``: one
    state after the other instead of all together.
    """
    if compiled and problem.compliances is None:
        each, outcome = one_by_one(problem, displacement, guess)
        d, x, linear = each.displacement, each.ball, None
    else:
        d, x, outcome, linear = _together(problem, displacement, guess)
        lost = np.flatnonzero(outcome != "")
        if guess is not None and lost.size:  # no state is lost by a start that leads astray
            part = problem.take(lost)
            again = _together(part, first_displacement(part, displacement[lost]), None)
            d[lost], x[:, lost], outcome[lost] = again[:3]
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
) -> tuple[CompiledStates, Words]:
    """Compiled, see ``compiled_states``, and the outcome of every state.

    What is refused so is looked for together, where free motions are followed; and so is every
    bearing whose rings deform, which the compiled solver does not know.
    """
    if problem.compliances is not None:
        near = None if guess is None or guess.shape[1] != len(displacement) else guess
        all_ = solve(problem, displacement, near)
        exists = all_.outcome == ""
        return CompiledStates(
            all_.displacement, all_.ball, all_.ring_load, all_.stiffness, exists
        ), all_.outcome
    solved = compiled_states(problem, displacement, guess, chained=chained)
    outcome = _words(solved.exists)
    missing = (~solved.exists).nonzero()[0]
    if missing.size:
        part = problem.take(missing)
        again = solve(part, first_displacement(part, displacement[missing]))
        solved.displacement[missing], solved.load[missing] = again.displacement, again.ring_load
        solved.ball[:, missing], solved.stiffness[missing] = again.ball, again.stiffness
        outcome[missing], solved.exists[missing] = again.outcome, again.outcome == ""
    return solved, outcome


def _together(
    problem: Problem, displacement: Array, guess: Array | None
) -> tuple[Array, Array, Words, Linear | None]:
    """(d, X), the outcome of every state, and its linearisation if that is known."""
    states = len(problem.speed)
    d, x = displacement.copy(), np.zeros((problem.unknowns, states, problem.assembly.balls))
    done, linear = np.zeros(states, dtype=bool), None
    if problem.turning and guess is not None:
        d, x, done, linear = corrected(problem, d, guess, np.full(states, problem.full))[:4]
        done &= problem.law.one_branch
    outcome = _words(done)
    cold = np.flatnonzero(~done)
    if cold.size:
        part, linear = problem.take(cold), None
        d[cold], x[:2, cold], reached = convex_state(part, displacement[cold])
        x[2:, cold], converged = 0.0, reached
        if problem.placed or problem.compliances is not None:
            d[cold], x[:, cold], converged = _followed(part, d[cold], x[:, cold], reached)
        heavy = np.abs(part.load).max(axis=1) > tol.LIGHT
        outcome[cold] = np.where(reached | ~heavy, _words(converged), "overloaded")
    return d, x, outcome, linear


def _followed(problem: Problem, d: Array, x: Array, reached: Flags) -> tuple[Array, Array, Flags]:
    """``followed``; what fails is tried again as a ring of which not every motion is held.

    A load that one or two balls carry leaves the others free: any of the places that meet it is a
    state, and the nearest is taken. Not where contacts open and close with a jump.
    """
    start = d.copy(), x.copy()
    d, x, converged, given_up = followed(problem, d, x, reached)
    left = np.flatnonzero(reached & ~converged & ~given_up & problem.law.one_branch)
    if left.size:
        part = replace(problem.take(left), loose=True)
        begun = start[0][left], start[1][:, left], np.ones(left.size, dtype=bool)
        d[left], x[:, left], converged[left], _ = followed(part, *begun)
    return d, x, converged


def _words(done: Flags) -> Words:
    words = np.zeros(len(done), dtype="<U16")
    words[~done] = "no equilibrium"
    return words


def _last_digits(
    problem: Problem, d: Array, x: Array, linear: Linear, converged: Flags
) -> tuple[tuple[Array, Array], Balance, Contacts, Array]:
    """(d, X), balance, contacts and ring load, freed from rounding of the lengths."""
    exact = scaled_error(problem, linear.balance, linear.ring_load, rounding=0.0)
    left = converged & (exact >= tol.TOLERANCE)
    if not left.any():
        return (d, x), *contacts(problem, linear.balance, (d, x)), linear.ring_load
    dd, dx = newton_step(problem, linear)
    dd, dx = np.where(left[:, None], dd, 0.0), np.where(left[:, None], dx, 0.0)
    load = linear.load + (linear.stiffness @ dd[..., None])[..., 0]
    ring_load = np.where(left[:, None], load, linear.ring_load)
    touching = contacts(problem, linear.balance, (d, x), (dd, dx))
    return (d + dd, x + dx), *touching, ring_load
