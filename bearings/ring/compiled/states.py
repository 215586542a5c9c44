"""A list of states handed to the compiled solver."""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearings.ring.compiled.entry import find_all
from bearings.ring.compiled.jit import compiled, is_kept
from bearings.ring.problem import Problem

Array = NDArray[np.float64]
BALL = 6e-6  # s that a ball takes without compiling
FROM_DISK = 2.0  # s to get the compiled solver from the disk
COMPILING = 30.0  # s to compile it


_loaded: set[tuple[int, int]] = set()


class Answer(NamedTuple):
    """d (s, 5), X (2, s, n), load (s, 5), K (s, 5, 5), and where there is a state (s,)."""

    displacement: Array
    ball: Array
    load: Array
    stiffness: Array
    found: NDArray[np.bool_]


def pays(balls: int, kind: tuple[int, int]) -> bool:
    """Whether so many balls are found sooner with the compiled solver, its loading included.

    ``kind``: numbers of contacts a race, for each of which the solver is compiled once.
    """
    if kind in _loaded:
        return True
    seconds = BALL * balls
    return seconds > COMPILING or (seconds > FROM_DISK and kind == (1, 1) and is_kept())


@lru_cache(maxsize=1)
def _entry() -> Any:
    return compiled(find_all, keep=True)


def compiled_states(
    problem: Problem, displacement: Array, guess: Array | None, *, chained: bool = False
) -> Answer:
    """Solve one state after the other.

    ``displacement`` (s, 5), ``guess`` (2, s or fewer, n): starts; ``chained``: where there is no
    guess, a state starts from the one before if that is near.
    """
    g, ring = problem.geometry, problem.ring
    states, balls = len(problem.speed), ring.balls
    d, x = displacement.copy(), np.zeros((states, balls, 2))
    if guess is not None:
        x[: guess.shape[1]] = guess.transpose(1, 2, 0)
    load, stiffness = np.zeros((states, 5)), np.zeros((states, 5, 5))
    found = np.zeros(states, dtype=np.bool_)
    given = (problem.origin.T, problem.speed, problem.load)
    _loaded.add((len(g.inner_grooves), len(g.outer_grooves)))
    _entry()(
        g,
        problem.law.numbers,
        ring.azimuth,
        problem.scale,
        np.flatnonzero(problem.free),
        problem.turning,
        problem.law.one_branch,
        problem.placed,
        problem.full,
        tuple(np.array(part, order="C") for part in given),  # one type of array: one compilation
        (d, x, load, stiffness, found),
        np.arange(states) < (0 if guess is None else guess.shape[1]),
        chained,
    )
    return Answer(d, x.transpose(2, 0, 1), load, stiffness, found)
