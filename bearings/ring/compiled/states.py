"""Call of the compiled solver for a list of states; in a chain each may start from the last.

Compiled at its first call, kept on disk for the next process (``bearings.ring.compiled.jit``).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from bearings.arrays import Array, Flags, Words
from bearings.geometry import Geometry
from bearings.ring.compiled.follow import find
from bearings.ring.compiled.jit import available, compiled, is_kept
from bearings.ring.compiled.one_state import One, put, workspace
from bearings.ring.problem import Problem

BALL = 6e-6  # s per ball of the batched solver
FROM_DISK = 2.0  # s to get the compiled solver from the disk
AT_ONCE = 256  # states in one call
COMPILING = 15.0  # s to compile it
NEAR = 0.2  # relative change of speed and load from the last state that makes it a start

_loaded: set[tuple[int, int, int]] = set()


class CompiledStates(NamedTuple):
    """Solved states: d (s, 5), X (2, s, n), load (s, 5), K (s, 5, 5), outcome (s,)."""

    displacement: Array
    ball: Array
    load: Array
    stiffness: Array
    outcome: Words


def pays(balls: int, g: Geometry) -> bool:
    """Whether the compiled solver, its loading included, is faster for this number of balls."""
    return loaded(g) or _worth(BALL * balls, g)


def expect(seconds: float, g: Geometry) -> None:
    """Use the compiled solver from now on if an expected saving of ``seconds`` pays for it."""
    if not loaded(g) and _worth(seconds, g):
        _loaded.add(_type(g))


def loaded(g: Geometry) -> bool:
    """Whether this process has loaded the compiled solver for grooves of this type."""
    return _type(g) in _loaded


def _worth(seconds: float, g: Geometry) -> bool:
    quick = seconds > FROM_DISK and _type(g) == (1, 1, 0) and is_kept()
    return (seconds > COMPILING or quick) and available()


def _type(g: Geometry) -> tuple[int, int, int]:
    """Type for which the solver is compiled once: numbers of inner and outer grooves, of walls."""
    return len(g.inner_grooves), len(g.outer_grooves), len(g.inner_grooves[0].walls)


def compiled_states(
    problem: Problem, displacement: Array, guess: Array | None, *, chained: bool = False
) -> CompiledStates:
    """Solve one state after the other.

    ``displacement`` (s, 5), ``guess`` (2, s or fewer, n): starts; ``chained``: where there is no
    guess, a state starts from the one before if that is near.
    """
    g, states = problem.geometry, len(problem.speed)
    d, x = displacement.copy(), np.zeros((states, problem.assembly.balls, 2))
    if guess is not None:
        x[: guess.shape[1]] = guess.transpose(1, 2, 0)
    arrays = (d, x, np.zeros((states, 5)), np.zeros((states, 5, 5)), np.zeros(states, dtype=bool))
    if available():
        _loaded.add(_type(g))
    shared = (
        g,
        problem.law.numbers,
        problem.assembly.azimuth,
        problem.assembly.products,
        problem.free.nonzero()[0],
        problem.turning,
        problem.law.one_branch,
        problem.placed,
        problem.full,
    )
    given = problem.origin.T, problem.squared, problem.load, problem.scale
    inputs = (*(np.array(part, order="C") for part in given),)  # one type for one compilation
    near = np.arange(states) < (0 if guess is None else guess.shape[1])
    solve = compiled(find_all)
    for first in range(0, states, AT_ONCE):  # Ctrl-C waits for one call
        solve(shared, inputs, arrays, near, chained, first, min(first + AT_ONCE, states))
    outcome = np.where(arrays[-1], "", "no equilibrium")
    return CompiledStates(d, x.transpose(2, 0, 1), *arrays[2:4], outcome)


def find_all(
    shared: tuple[Any, ...],
    inputs: tuple[Array, Array, Array, Array],
    states: tuple[Array, Array, Array, Array, Flags],
    near: Flags,
    chained: bool,
    first: int,
    last: int,
) -> None:
    """Solve the states from ``first`` up to ``last`` of ``inputs`` = (A₀ (s, 2), ω² (s,),
    load (s, 5), scale (5,)).

    ``shared``: data common to all, ``One`` from ``geometry`` on. Results are written into
    ``states`` = (d (s, 5), X (s, n, 2), load (s, 5), K (s, 5, 5), exists (s,)), where d and, if
    ``near`` (s,), X are the starts. ``chained``: a state starts from the one before where load,
    displacement and speed are close; otherwise every state is solved independently.
    """
    origin, squared, load, scale = inputs
    d, x, carried, stiffness, exists = states
    w = workspace(x.shape[1])
    for k in range(first, last):
        size = np.abs(load[k] / scale).max()
        p = One(origin[k], squared[k], load[k], scale, size, *shared)
        start = near[k]
        if chained and not start and k and exists[k - 1] and _near(p, squared, load, d, k):
            start = True
            for j in p.free:
                d[k, j] = d[k - 1, j]
            put(x[k], x[k - 1])
        exists[k] = find(p, d[k], x[k], start, w)
        put(carried[k], w.condensed)
        put(stiffness[k], w.stiffness)


def _near(p: One, squared: Array, load: Array, d: Array, k: int) -> bool:
    """Whether the last state is close enough to start from."""
    speed, last = np.sqrt(squared[k]), np.sqrt(squared[k - 1])
    if abs(speed - last) > NEAR * speed:
        return False
    change = np.abs(d[k] - d[k - 1]) * p.scale
    for j in p.free:
        change[j] = 0.0
    reach = p.geometry.free_distance
    close = np.abs((load[k] - load[k - 1]) / p.scale).max() <= NEAR * p.load_size
    return close and change.max() <= 0.01 * NEAR * reach
