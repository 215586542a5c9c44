"""Speeds at which a followed mode whirls at a multiple of the speed, by secants.

The machine, its bearings and damping included, is set up anew at each trial, all searches at once;
journals in squeeze films whirl at the multiple. Only the mode sought is corrected; all modes are
solved for where that leads to a mode unlike it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rotordyn.arrays import Array, Complex, Indices
from rotordyn.equation.free_motion import FreeMotions, stiffness_with_signs
from rotordyn.equation.hysteresis import signs_at
from rotordyn.modes.branches import Branch, whirl_degree
from rotordyn.modes.excitation import Line
from rotordyn.numerics.correct import corrected
from rotordyn.numerics.follow import mac
from rotordyn.numerics.modes import oscillates
from rotordyn.scene.scene import Scene

ITERATIONS = 20  # secants, at most
CLOSE = 1e-11  # of the frequency: the condition holds
ROUNDED = 1e-7  # likewise, where no other speed is closer; more is no root in the range
CHANCE = 3.0  # times the rounding of a frequency: misses as large are due to it
NEARNESS = 2.0  # of the MAC that a distance as large as the frequency costs
CLEAR = 0.7  # MAC, less that, from which it is no other mode


@dataclass(frozen=True, eq=False, slots=True)
class Start:
    """Start of a search: ``speed`` [rad/s] for ``branch``, between ``low`` and ``high``.

    ``line``: excitation there; ``side``: the whirl of the branch where planes are one, else 0;
    ``before``: a previous speed, and its ``miss``.
    """

    branch: int
    line: Line
    speed: float
    low: float
    high: float
    vector: Complex
    side: float
    before: tuple[float, float] | None = None


@dataclass(frozen=True, eq=False, slots=True)
class State:
    """Mode nearest to a start at some speed; ``miss`` |Im λ| − n Ω [rad/s]."""

    pole: complex
    vector: Complex
    miss: float


def solved(
    scene: Scene, branches: Sequence[Branch], starts: Sequence[Start]
) -> list[tuple[Start, float, State]]:
    """Return the root of every start by secants, all at once; starts without one are omitted."""
    if not starts:
        return []
    at = np.array([s.speed for s in starts])
    starts = list(starts)
    open_, done = list(range(len(starts))), []
    nearest: dict[int, tuple[Start, float, State]] = {}
    for _ in range(ITERATIONS):
        states = _states(scene, branches, [starts[k] for k in open_], at[open_])
        continuing = []
        for k, state in zip(open_, states, strict=True):
            if state is None:
                continue
            if abs(state.miss) <= CLOSE * abs(state.pole):
                done.append((starts[k], float(at[k]), state))
                continue
            if abs(state.miss) <= rounded(scene, branches[starts[k].branch]) * abs(state.pole):
                nearest[k] = starts[k], float(at[k]), state
            next_speed = _next(starts[k], float(at[k]), state.miss)
            starts[k] = replace(starts[k], vector=state.vector, before=(float(at[k]), state.miss))
            if next_speed != at[k]:
                at[k] = next_speed
                continuing.append(k)
            elif k in nearest:
                done.append(nearest[k])
        open_ = continuing
        if not open_:
            break
    return done + [nearest[k] for k in open_ if k in nearest]  # where rounding keeps secants moving


def rounded(scene: Scene, branch: Branch) -> float:
    """Return how exactly a followed mode meets a line, over its frequency, by rounding."""
    rows = np.flatnonzero(branch.column >= 0)
    error = scene.system(branch.subsystem).rounding[rows, branch.column[rows]]
    return max(ROUNDED, CHANCE * float(np.nanmax(error, initial=0.0)))


def _next(start: Start, at: float, miss: float) -> float:
    """Return the speed by the secant through the last two, at first the speed of which the
    frequency would be the multiple; not beyond the ends of the search."""
    before, speed = start.before, at + miss / start.line.size
    if before is not None and before[1] != miss:
        speed = at - miss * (at - before[0]) / (miss - before[1])
    return float(np.clip(speed, start.low, start.high))


def _states(
    scene: Scene, branches: Sequence[Branch], starts: list[Start], at: Array
) -> list[State | None]:
    """Return the mode of every start at its speed; None if there is none, or no equilibrium."""
    speeds, row = np.unique(at, return_inverse=True)
    other = scene.at(speeds)
    states: list[State | None] = [None] * len(starts)
    if all(other.outcome):
        return states
    usable_row = np.full(len(speeds), -1)
    usable_row[other.usable] = np.arange(len(other.usable))
    groups: dict[tuple[int, float], list[int]] = {}
    for k in np.flatnonzero(usable_row[row] >= 0).tolist():
        key = branches[starts[k].branch].subsystem, starts[k].line.size
        groups.setdefault(key, []).append(k)
    for (subsystem, size), chosen in groups.items():
        rows, members = usable_row[row[chosen]], [starts[k] for k in chosen]
        whirling = other.whirling(size)
        modes = _corrected(whirling, subsystem, rows, members, at[chosen])
        for k, at_row, state in zip(chosen, rows.tolist(), modes, strict=True):
            states[k] = state or _nearest(
                _motions(whirling, subsystem, starts[k]), at_row, starts[k], float(at[k])
            )
    return states


def _corrected(
    scene: Scene, subsystem: int, rows: Indices, starts: list[Start], at: Array
) -> list[State | None]:
    """Return the mode of every start by itself; None where that is not clearly the one sought.

    Cases that are mostly critical speeds (lalanne_ferraris) take 1.6 times as long by ``_states``.
    """
    linear, line = scene.linear(subsystem), starts[0].line.size
    stiffness = stiffness_with_signs(linear, signs_at(line))[rows]
    guess = np.asarray(np.array([s.vector for s in starts]) @ linear.basis, dtype=complex)
    damping = linear.within(linear.damping[rows])
    guessed_pole = np.asarray(1j * line * at, dtype=complex)
    pole, vector, converged = corrected(stiffness, damping, guessed_pole, guess)
    states: list[State | None] = [None] * len(starts)
    for k in np.flatnonzero(converged & oscillates(pole) & (pole.imag > 0.0)).tolist():
        displacement = linear.basis @ vector[k]
        if _fitness(starts[k], at[k], pole[k : k + 1], displacement[:, None])[0] > CLEAR:
            states[k] = State(complex(pole[k]), displacement, float(pole[k].imag - line * at[k]))
    return states


def _motions(scene: Scene, subsystem: int, start: Start) -> FreeMotions:
    """Return the modes of a subsystem; with loss factors, of motions at the start's multiple of the
    speed. Where planes are one here and not at all speeds, its shape determines its whirl."""
    motions, side = scene.system(subsystem), start.side
    if motions.linear.axisymmetric and not side:
        degree = whirl_degree(motions.linear, start.vector[None, :, None])
        side = math.copysign(1.0, degree[0, 0])
    return motions.at_order(start.line.size, side)


def _nearest(motions: FreeMotions, row: int, start: Start, speed: float) -> State | None:
    """Return the vibration mode of a subsystem that is most like the start and near its line."""
    pole, vector = motions.pole[row], motions.vector[row]
    columns = np.flatnonzero(oscillates(pole) & (motions.whirl[row] * start.side >= 0.0))
    if not columns.size:
        return None
    best = columns[int(_fitness(start, speed, pole[columns], vector[:, columns]).argmax())]
    miss = float(pole[best].imag) - start.line.size * speed
    return State(complex(pole[best]), vector[:, best], miss)


def _fitness(start: Start, speed: float, pole: Complex, vector: Complex) -> Array:
    """Return the similarity of modes (k,), ``vector`` (n, k), to the start and its line."""
    line, frequency = start.line.size * speed, pole.imag
    distance = np.abs(frequency - line) / np.maximum(np.maximum(frequency, line), 1e-100)
    return np.asarray(mac(start.vector[:, None], vector)[0] - NEARNESS * distance)
