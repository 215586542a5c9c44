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

from bearings.ball.balance import Balance
from bearings.ring.compiled.states import Answer, compiled_states
from bearings.ring.contacts import Contacts, contacts
from bearings.ring.convex_stage import convex_state
from bearings.ring.followed_stage import corrected, followed
from bearings.ring.linearised import Linear, linearise, newton_step, scaled_error, tangent
from bearings.ring.problem import TOLERANCE, Problem, first_displacement

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class Solution:
    """d (s, 5), X (2, s, n), balance there, tangent (s, 5, 5), residual, outcome word (s,)."""

    displacement: Array
    ball: Array
    balance: Balance
    contacts: Contacts
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
        answer, outcome = one_by_one(problem, displacement, guess)
        d, x, linear = answer.displacement, answer.ball, None
    else:
        d, x, outcome, linear = _together(problem, displacement, guess)
    if linear is None:
        linear = linearise(problem, d, x, np.full(len(d), problem.full))
    (d, x), balance, touching, ring_load = _last_digits(problem, d, x, linear, outcome == "")
    return Solution(
        displacement=d,
        ball=x,
        balance=balance,
        contacts=touching,
        ring_load=ring_load,
        stiffness=tangent(problem, linear.balls),
        residual=linear.error,
        outcome=outcome,
    )


def one_by_one(
    problem: Problem, displacement: Array, guess: Array | None, *, chained: bool = False
) -> tuple[Answer, NDArray[np.str_]]:
    """Compiled, see ``compiled_states``, and the outcome of every state.

    What is refused so is looked for together, where free motions are followed.
    """
    answer = compiled_states(problem, displacement, guess, chained=chained)
    outcome = _words(answer.found)
    missing = (~answer.found).nonzero()[0]
    if missing.size:
        part = problem.take(missing)
        found = solve(part, first_displacement(part, displacement[missing]))
        answer.displacement[missing], answer.load[missing] = found.displacement, found.ring_load
        answer.ball[:, missing], answer.stiffness[missing] = found.ball, found.stiffness
        outcome[missing], answer.found[missing] = found.outcome, found.outcome == ""
    return answer, outcome


def _together(
    problem: Problem, displacement: Array, guess: Array | None
) -> tuple[Array, Array, NDArray[np.str_], Linear | None]:
    """(d, X), the outcome of every state, and its linearisation if that is known."""
    states = len(problem.speed)
    d, x = displacement.copy(), np.zeros((2, states, problem.ring.balls))
    done, linear = np.zeros(states, dtype=bool), None
    if problem.turning and guess is not None:
        d, x, done, linear = corrected(problem, d, guess, np.full(states, problem.full))[:4]
    outcome = _words(done)
    cold = np.flatnonzero(~done)
    if cold.size:
        part, linear = problem.take(cold), None
        d[cold], x[:, cold], reached = convex_state(part, displacement[cold])
        found = reached
        if problem.placed:
            d[cold], x[:, cold], found = followed(part, d[cold], x[:, cold], reached)
        outcome[cold] = np.where(reached, _words(found), "overloaded")
    return d, x, outcome, linear


def _words(done: NDArray[np.bool_]) -> NDArray[np.str_]:
    words = np.zeros(len(done), dtype="<U16")
    words[~done] = "no equilibrium"
    return words


def _last_digits(
    problem: Problem, d: Array, x: Array, linear: Linear, found: NDArray[np.bool_]
) -> tuple[tuple[Array, Array], Balance, Contacts, Array]:
    """(d, X), balance, contacts and ring load, freed from rounding of the lengths."""
    exact = scaled_error(problem, linear.balance, linear.ring_load, rounding=0.0)
    left = found & (exact >= TOLERANCE)
    if not left.any():
        return (d, x), *contacts(problem, linear.balance, (d, x)), linear.ring_load
    dd, dx = newton_step(problem, linear)
    dd, dx = np.where(left[:, None], dd, 0.0), np.where(left[:, None], dx, 0.0)
    part = tangent(problem, linear.balls) @ dd[..., None]
    load = problem.ring.load(np.stack(linear.balls.action)) + part[..., 0]
    ring_load = np.where(left[:, None], load, linear.ring_load)
    touching = contacts(problem, linear.balance, (d, x), (dd, dx))
    return (d + dd, x + dx), *touching, ring_load
