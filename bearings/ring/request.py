"""From a question to solved states: alike ones together, each group in one solve."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from bearings.ball.law import Law
from bearings.ball.potential import resting_seat
from bearings.errors import InvalidBearing, NoEquilibrium
from bearings.geometry import Geometry
from bearings.grooves import Grooves
from bearings.ring.collect import blank, state, store
from bearings.ring.condition import conditions
from bearings.ring.data import Cause
from bearings.ring.equilibrium import solve
from bearings.ring.problem import Problem, first_displacement, turns
from bearings.ring.question import Question
from bearings.ring.state import BearingState
from bearings.ring.sums import axial_ring, full_ring

Array = NDArray[np.float64]
TOGETHER = 8000  # balls in one batch: what it works on stays near the processor

REMEDIES = {
    "overloaded": "the balls are pressed far out of their grooves; is the unit of the load right?",
    "unloaded": "no load presses the rings together; give a load, or a displacement",
    "no contact angle": "growth leaves no contact angle; reduce the fit, or look at its sign",
}


def answer(
    grooves: Grooves,
    law: Law,
    asked: Question,
    start: BearingState | None,
    compiled: bool | None,
) -> BearingState:
    """See ``BallBearing.equilibrium``."""
    found = solved(Cause(grooves, law, asked), start, compiled)
    if asked.shape == () and found.outcome:
        word, speed = str(found.outcome), float(asked.speed[0])
        raise NoEquilibrium(
            word,
            speed=speed,
            remedy=remedy(word, law),
            look=lambda: str(condition(found)).partition(": ")[2],
        )
    return found


def condition(state: BearingState) -> NDArray[np.str_]:
    """What there is to say about each state of a batch (…), see ``conditions``."""
    return conditions(state, solved)


def remedy(word: str, law: Law) -> str:
    """What helps against an outcome under these assumptions."""
    if word != "no equilibrium":
        return REMEDIES[word]
    ways = ["raise the load", "lower the speed"]
    if law.friction is None:
        ways.append("give a limit of friction")
    if not law.one_branch:
        ways.append("use outer or hybrid kinematics")
    return ", ".join(ways[:-1]) + f" or {ways[-1]}"


def solved(
    cause: Cause, start: BearingState | None = None, compiled: bool | None = None
) -> BearingState:
    """All states of a question; see ``BallBearing.equilibrium``."""
    asked, g, whole = cause.question, cause.geometry, Problem.of(cause, full_ring)
    outcome = np.where(np.isfinite(whole.origin[0]), "", "no contact angle").astype("<U16")
    if g.touching:  # a centred ring is at rest under no load
        outcome[asked.unloaded & (outcome == "")] = "unloaded"
    states = blank(g, asked, outcome)
    fast = _compiled(g, asked) if compiled is None else compiled
    for index, axial, turning in _groups(g, asked, outcome):
        problem = replace(whole.take(index), turning=turning)
        if axial:  # what is not axial stays at zero by symmetry
            free = asked.free & np.array([True, False, False, False, False])
            problem = replace(problem, ring=axial_ring(g), free=free)
        first, near = first_displacement(problem, asked.displacement[index]), None
        if start is not None and turning and cause.law.one_branch:
            first, near = _neighbour(problem, asked, start, index, first)
        store(states, index, problem, solve(problem, first, near, compiled=fast))
    return state(states, asked.shape, cause)


def _compiled(g: Geometry, asked: Question) -> bool:
    """Whether the compiled solver pays for what is asked; an axial state counts as one ball."""
    from bearings.ring.compiled.states import pays

    balls = int(np.where(asked.axial, 1, g.balls).sum())
    return pays(balls, (len(g.inner_grooves), len(g.outer_grooves)))


def _groups(
    g: Geometry, asked: Question, outcome: NDArray[np.str_]
) -> Iterator[tuple[NDArray[np.intp], bool, bool]]:
    """States alike in what must be solved: (index, axial?, turning?)."""
    is_axial, is_turning = asked.axial, turns(g, asked.speed)
    for axial in (True, False):
        for turning in (True, False):
            chosen = (is_axial == axial) & (is_turning == turning) & (outcome == "")
            index, share = np.flatnonzero(chosen), TOGETHER // (1 if axial else g.balls) + 1
            for first in range(0, len(index), share):
                yield index[first : first + share], axial, turning


def _neighbour(
    problem: Problem,
    asked: Question,
    start: BearingState,
    index: NDArray[np.intp],
    first: Array,
) -> tuple[Array, Array]:
    """(d, X) of the neighbouring states; ``first`` and seats at rest where one is missing."""
    if start.outcome.shape != asked.shape or start.inner_load.shape[-1] != (problem.geometry.balls):
        raise InvalidBearing(
            f"start must be a state of this bearing with batch shape {asked.shape} and "
            f"{problem.geometry.balls} balls, got {start.outcome.shape} and "
            f"{start.inner_load.shape[-1]} balls"
        )
    near = start.ball_centre.reshape(2, len(asked.speed), -1)[:, index]
    near = near[..., : problem.ring.balls]  # of an axial state all balls are alike
    known = np.asarray(np.isfinite(near).all(axis=(0, 2)))
    there = start.displacement.reshape(-1, 5)[index]
    first = np.where(known[:, None] & problem.free, there, first)
    a = problem.centres(first)
    seats = np.stack(resting_seat(problem.geometry, (a[0], a[1])))
    return first, np.where(known[:, None], near, seats)
