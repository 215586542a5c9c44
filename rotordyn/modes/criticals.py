"""Critical speeds, at which a mode whirls at a multiple of a rotor's speed, each solved for.

There are two methods. Where only the gyroscopic effect and tables of supports depend on speed,
critical speeds between two breakpoints are the eigenvalues of one problem (``synchronous``), for
any speeds of the case. Where bearings change with speed, and for axial motion and torsion, lines of
followed modes show between which speeds they are. In either case the machine is then solved anew at
that speed, with damping, until the frequency of the mode is the multiple to rounding.

Reported are those in the band in which modes are followed, each by the followed mode that has its
shape and its frequency there.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rotordyn.arrays import Matrix
from rotordyn.equation.free_motion import synchronous_motions
from rotordyn.modes.branches import (
    MARGIN,
    MOTIONS,
    Branch,
    branches_of,
    breakpoints_between,
    whirl_degree,
)
from rotordyn.modes.character import across, whirl_along
from rotordyn.modes.excitation import Line, excited_by, exciting
from rotordyn.modes.names import named
from rotordyn.modes.roots import Start, State, rounded, solved
from rotordyn.numerics.crossing import zero_crossings
from rotordyn.numerics.follow import mac
from rotordyn.scene.formulation import SOFTENED
from rotordyn.scene.scene import Scene

SLOWEST = 1e-9  # [rad/s]: slower lines are not searched for crossings
BEYOND = 1.2  # times the highest frequency of lines: up to there modes are followed
NARROW = 0.01  # of the range of speeds: shorter pieces of tables are not solved directly
APART = 1e-9  # [rad/s]: closer speeds are one
SAME, ALIKE = 1e-6, 0.5  # of the speed, MAC: one root found twice, at most apart by rounding
RESONANT = math.sqrt(0.5)  # damping ratio above which no response has a peak
FITS = 0.1  # of a frequency: a root farther from those of a mode at adjacent speeds is another
ROUNDING = 1e-9  # of the highest frequency


@dataclass(frozen=True, slots=True)
class Critical:
    """A mode that has the frequency of a ``line`` at the ``speed`` of the spindle [rad/s]."""

    mode: str
    speed: float
    line: Line
    kind: str
    whirl: str
    damping_ratio: float
    excited: bool


def criticals_up_to(
    scene: Scene, size: float, orders: Iterable[float] = (1.0,), motions: Sequence[str] = MOTIONS
) -> list[Critical]:
    """Return critical speeds of engine ``orders``, on lines of up to ``size`` times the frequency
    of rotation of the spindle; none where it has one speed alone."""
    top = size * float(scene.speed[-1])
    if len(scene.usable) < 2 or top < SLOWEST:
        return []
    highest, lines = BEYOND * top, exciting(scene.spindle.ratios, dict.fromkeys(orders))
    return critical_speeds(scene, highest, lines, *named(branches_of(scene, highest, motions)))


def critical_speeds(
    scene: Scene,
    highest: float,
    lines: Sequence[Line],
    branches: Sequence[Branch],
    names: Sequence[str],
) -> list[Critical]:
    """Return critical speeds on ``lines`` between the speeds of the case, up to the ``highest``
    angular frequency [rad/s], ascending by line and speed."""
    bending = {branch.subsystem for branch in branches if branch.kind == "bending"}
    starts = [start for line in lines for start in _crossed(branches, line)]
    starts += [
        start for line in lines for k in bending for start in _direct(scene, branches, k, line)
    ]
    starts = [s for s in starts if s.line.size * s.speed <= MARGIN * highest]
    crossings, criticals = list[tuple[Start, float, State]](), list[Critical]()
    for start, speed, state in solved(scene, branches, starts):
        oscillates = -state.pole.real <= RESONANT * abs(state.pole)
        within = abs(state.pole.imag) <= (1.0 + ROUNDING) * highest
        within_rounding = max(SAME, rounded(scene, branches[start.branch]))
        repeated = any(_same(start, speed, state, other, within_rounding) for other in crossings)
        if repeated or not (oscillates and within):
            continue
        crossings.append((start, speed, state))
        branch = branches[start.branch]
        index = _owner(branches, branch.subsystem, speed, state)
        owner = None if index is None else branches[index]
        if owner is not None and owner.overdamped:
            continue
        name = f"{branch.kind}, not followed" if index is None else names[index]
        kind = (owner or branch).kind
        criticals.append(_named(scene, branch.subsystem, kind, name, start.line, speed, state))
    return sorted(criticals, key=lambda c: (lines.index(c.line), c.speed))


def _crossed(branches: Sequence[Branch], line: Line) -> list[Start]:
    """Return starts where followed modes cross the line, on the local cubic."""
    starts = []
    for place, branch in enumerate(branches):
        track, speed = branch.track, branch.track.speed
        miss = np.abs(track.pole.imag) - line.size * speed
        for zero in zero_crossings(speed, miss):
            if zero <= 0.0:
                continue
            row = int(np.clip(np.searchsorted(speed, zero) - 1, 0, max(len(speed) - 2, 0)))
            ends = [k for k in (row, row + 1) if k < len(speed) and not track.lost[k]]
            nearest = min(ends, key=lambda k: abs(speed[k] - zero))
            low, high = float(speed[ends[0]]), float(speed[ends[-1]])
            starts.append(Start(place, line, zero, low, high, track.vector[nearest], branch.side))
    return starts


def _direct(scene: Scene, branches: Sequence[Branch], subsystem: int, line: Line) -> list[Start]:
    """Return starts at all synchronous bending motions of a subsystem between the speeds of the
    case, where the matrices are linear in speed from breakpoint to breakpoint."""
    linear = scene.system(subsystem).linear
    if linear.kinds != {"bending"} or not _piecewise(scene):
        return []
    place = next(
        k for k, b in enumerate(branches) if (b.kind, b.subsystem) == ("bending", subsystem)
    )
    speed = scene.speed[scene.usable]
    ends = np.unique(np.concatenate([speed[[0, -1]], breakpoints_between(scene)]))
    whirling = scene.at(ends).whirling(line.size)
    stiffness = _symmetric(whirling.linear(subsystem).allowed_stiffness)
    starts = []
    for (low, high), (slow, fast) in zip(pairwise(ends), pairwise(stiffness), strict=True):
        if high - low < max(NARROW * (ends[-1] - ends[0]), APART):
            continue  # two crossings of one mode hardly fit; lines show a single one
        slope = (fast - slow) / (high - low)
        constant = slow - low * slope
        limits = float(speed[0]), float(speed[-1])
        motions = synchronous_motions(linear, constant, slope, line.size)
        starts += [
            Start(place, line, spin, *limits, vector, side)
            for spin, vector, side in motions
            if low <= spin <= high
        ]
    return starts


def _symmetric(stiffness: Matrix) -> Matrix:
    """Return the symmetric part: damping of rotating parts, or what couples the planes one way,
    only shifts roots off the real axis, where they would be missed."""
    return np.asarray(0.5 * (stiffness + np.swapaxes(stiffness, -1, -2)))


def _piecewise(scene: Scene) -> bool:
    """True if stiffness changes with the tables of supports alone."""
    force = scene.force
    return (
        not scene.spindle.seats
        and scene.conditions.formulation != SOFTENED
        and (force is None or bool((force == force[:1]).all()))
    )


def _owner(branches: Sequence[Branch], subsystem: int, speed: float, state: State) -> int | None:
    """Return the followed mode to which a root belongs: of its shape, and of its frequency, at the
    adjacent speeds; the most similar and nearest of several."""
    best, owner = -math.inf, None
    omega = abs(state.pole.imag)
    for index, branch in enumerate(branches):
        if branch.subsystem != subsystem:
            continue
        track = branch.track
        row = int(np.clip(np.searchsorted(track.speed, speed), 1, max(len(track.speed) - 1, 1)))
        ends = [k for k in (row - 1, row) if k < len(track.speed) and not track.lost[k]]
        if not ends:
            continue
        frequency = np.abs(track.pole[ends].imag)
        outside = max(frequency.min() - omega, omega - frequency.max(), 0.0) / omega
        assurance = float(mac(track.vector[ends].T, state.vector[:, None]).max())
        distance = abs(float(np.interp(speed, track.speed[ends], frequency)) - omega) / omega
        if outside <= FITS and assurance >= ALIKE and assurance - distance > best:
            best, owner = assurance - distance, index
    return owner


def _same(
    start: Start, speed: float, state: State, other: tuple[Start, float, State], rounding: float
) -> bool:
    """True if two searches ended in one root."""
    other_start, other_speed, other_state = other
    return bool(
        other_start.line == start.line
        and abs(speed - other_speed) <= rounding * other_speed
        and len(other_state.vector) == len(state.vector)
        and mac(other_state.vector[:, None], state.vector[:, None])[0, 0] > ALIKE
    )


def _named(
    scene: Scene, subsystem: int, kind: str, name: str, line: Line, speed: float, state: State
) -> Critical:
    """Return the critical speed of a root, and whether something that rotates excites it."""
    linear, whirl = scene.system(subsystem).linear, ""
    if kind == "bending":
        vector = np.where(linear.energy_of("bending"), state.vector, 0.0)
        degree = float(whirl_degree(linear, vector[None])[0])
        whirl = whirl_along(linear, vector, degree)
    bends = across(linear, state.vector)
    excited = line.excites(excited_by(kind, whirl, axisymmetric=linear.axisymmetric, across=bends))
    ratio = 0.0 - state.pole.real / abs(state.pole)  # no negative zero
    return Critical(name, speed, line, kind, whirl, float(ratio), excited)
