"""Speeds at which a followed mode turns at a multiple of the speed, by secants.

The machine, its bearings and damping included, is set up anew at each trial, all searches at once;
journals in squeeze films whirl at the multiple.
Of it the one mode is corrected that the search is after; all are solved for where that leads to a
mode unlike it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rotordyn.arrays import Array, Complex, Indices
from rotordyn.equation.free_motion import FreeMotions, answering_stiffness
from rotordyn.equation.hysteresis import Signs, signs_of
from rotordyn.modes.branches import Branch, whirl_degree
from rotordyn.modes.excitation import Line
from rotordyn.numerics.correct import corrected
from rotordyn.numerics.follow import mac
from rotordyn.numerics.modes import swings
from rotordyn.scene.scene import Scene

ITERATIONS = 20
CLOSE = 1e-11  # of the frequency: the condition holds
ROUNDED = 1e-7  # likewise, where no other speed comes nearer to it; more is no root in the range
NEARNESS = 2.0  # of the MAC that a distance as large as the frequency costs
CLEAR = 0.7  # MAC, less that, from which no other mode can be meant


@dataclass(frozen=True, eq=False, slots=True)
class Start:
    """Where to look: ``speed`` [rad/s] for ``branch``, between ``low`` and ``high``.

    ``line``: what excites there; ``side``: the whirl of the branch where planes are one, else 0;
    ``before``: a speed already looked at, and what it missed by.
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
    """The mode nearest to a start at some speed; ``miss`` |Im λ| − n Ω [rad/s]."""

    pole: complex
    vector: Complex
    miss: float


def solved(
    scene: Scene, branches: Sequence[Branch], starts: Sequence[Start]
) -> list[tuple[Start, float, State]]:
    """Every start led to its root by secants, all at once; those without one are left out."""
    if not starts:
        return []
    at = np.array([s.speed for s in starts])
    starts = list(starts)
    open_, done = list(range(len(starts))), []
    near: dict[int, tuple[Start, float, State]] = {}
    for _ in range(ITERATIONS):
        states = _states(scene, branches, [starts[k] for k in open_], at[open_])
        still = []
        for k, state in zip(open_, states, strict=True):
            if state is None:
                continue
            if abs(state.miss) <= CLOSE * abs(state.pole):
                done.append((starts[k], float(at[k]), state))
                continue
            if abs(state.miss) <= ROUNDED * abs(state.pole):
                near[k] = starts[k], float(at[k]), state
            onward = _next(starts[k], float(at[k]), state.miss)
            starts[k] = replace(
                starts[k],
                vector=state.vector,
                before=(float(at[k]), state.miss),
            )
            if onward != at[k]:
                at[k] = onward
                still.append(k)
            elif k in near:
                done.append(near[k])
        open_ = still
        if not open_:
            break
    return done + [near[k] for k in open_ if k in near]  # where rounding keeps secants moving


def _next(start: Start, at: float, miss: float) -> float:
    """The secant through the last two speeds, at first the speed at which the frequency met would
    be the multiple; not beyond the ends of the search."""
    before, onward = start.before, at + miss / start.line.size
    if before is not None and before[1] != miss:
        onward = at - miss * (at - before[0]) / (miss - before[1])
    return float(np.clip(onward, start.low, start.high))


def _states(
    scene: Scene, branches: Sequence[Branch], starts: list[Start], at: Array
) -> list[State | None]:
    """The mode of every start at its speed; None where there is none, or no equilibrium."""
    speeds, row = np.unique(at, return_inverse=True)
    other = scene.at(speeds)
    states: list[State | None] = [None] * len(starts)
    if all(other.outcome):
        return states
    place = np.full(len(speeds), -1)
    place[other.usable] = np.arange(len(other.usable))
    ways: dict[tuple[int, float], list[int]] = {}
    for k in np.flatnonzero(place[row] >= 0).tolist():
        way = branches[starts[k].branch].subsystem, starts[k].line.size
        ways.setdefault(way, []).append(k)
    for (subsystem, size), chosen in ways.items():
        rows, mine = place[row[chosen]], [starts[k] for k in chosen]
        whirling = other.whirling(size)
        near = _corrected(whirling, subsystem, rows, mine, at[chosen])
        for k, at_row, state in zip(chosen, rows.tolist(), near, strict=True):
            states[k] = state or _nearest(
                _known(whirling, subsystem, starts[k]), at_row, starts[k], float(at[k])
            )
    return states


def _corrected(
    scene: Scene, subsystem: int, rows: Indices, starts: list[Start], at: Array
) -> list[State | None]:
    """The mode of every start by itself; None where that is not clearly the one looked for.

    Cases that are mostly critical speeds (lalanne_ferraris) take 1.6 times as long by ``_states``.
    """
    linear, line = scene.linear(subsystem), starts[0].line.size
    signs = Signs(*map(int, signs_of(np.array([line]), np.ones(1), whirling=False)[0]))
    stiffness = linear.within(answering_stiffness(linear, signs)[rows])
    begun = np.asarray(np.array([s.vector for s in starts]) @ linear.basis, dtype=complex)
    damping = linear.within(linear.damping[rows])
    turning = np.asarray(1j * line * at, dtype=complex)
    pole, vector, met = corrected(stiffness, damping, turning, begun)
    states: list[State | None] = [None] * len(starts)
    for k in np.flatnonzero(met & swings(pole) & (pole.imag > 0.0)).tolist():
        moved = linear.basis @ vector[k]
        if _fitness(starts[k], at[k], pole[k : k + 1], moved[:, None])[0] > CLEAR:
            states[k] = State(complex(pole[k]), moved, float(pole[k].imag - line * at[k]))
    return states


def _known(scene: Scene, subsystem: int, start: Start) -> FreeMotions:
    """Modes of a subsystem; with loss factors, of motions at the multiple of the speed that the
    start is after. Where planes are one here and not at all speeds, its shape tells its whirl."""
    motions = scene.system(subsystem)
    if motions.lossy is None:
        return motions
    turning = start.line.size
    if motions.whirling:
        degree = whirl_degree(motions.linear, start.vector[None, :, None])
        turning *= start.side or math.copysign(1.0, degree[0, 0])
    signs = signs_of(np.array([turning]), np.ones(1), whirling=motions.whirling)
    return motions.answering(Signs(*map(int, signs[0])))


def _nearest(motions: FreeMotions, row: int, start: Start, speed: float) -> State | None:
    """The swinging mode of a subsystem that is most like the start and near to its line."""
    pole, vector = motions.pole[row], motions.vector[row]
    columns = np.flatnonzero(swings(pole) & (motions.whirl[row] * start.side >= 0.0))
    if not columns.size:
        return None
    best = columns[int(_fitness(start, speed, pole[columns], vector[:, columns]).argmax())]
    miss = float(pole[best].imag) - start.line.size * speed
    return State(complex(pole[best]), vector[:, best], miss)


def _fitness(start: Start, speed: float, pole: Complex, vector: Complex) -> Array:
    """How like the start modes (k,) with ``vector`` (n, k) are, and how near to its line."""
    line, turning = start.line.size * speed, pole.imag
    apart = np.abs(turning - line) / np.maximum(np.maximum(turning, line), 1e-100)
    return np.asarray(mac(start.vector[:, None], vector)[0] - NEARNESS * apart)
