"""Modes over speed: those of bending, axial motion and torsion, each followed by its shape.

A mode of motions that supports couple is named after the one with the largest share of its kinetic
energy, on the mean of all speeds: of two modes that veer, what each is over most of the range.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.certificate import swings
from rotordyn.analysis.results.modes import creeps
from rotordyn.analysis.scene import Scene
from rotordyn.analysis.specs import CampbellSpec
from rotordyn.numerics.follow import doubts, follow
from rotordyn.numerics.products import times

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Matrix = NDArray[np.inexact[Any]]
MOTIONS = ("bending", "axial", "torsion")
MARGIN = 1.5  # modes up to this multiple of the highest frequency are followed
WITHIN = 1.1  # doubts about modes above this multiple are left
ROUNDS, MOST_STEPS = 12, 400  # of further speeds; of speeds in all
MOST_KNOTS = 200  # of tables of supports, beyond which only every second (third …) is taken
NARROWEST = 1e-7  # of the range of speeds: no finer steps
FARTHEST = 0.3  # of a pole: a larger change over a step is not believed
PLANAR = 1e-6  # whirl degree below which a motion is straight


@dataclass(frozen=True, eq=False, slots=True)
class Track:
    """One mode at every ``speed`` (s,) [rad/s] at which it was solved for, those between the speeds
    of the case included; ``pole`` (s,) is NaN where it is ``lost``; ``vector`` (s, n)."""

    speed: Array
    pole: Complex
    vector: Complex

    @property
    def lost(self) -> NDArray[np.bool_]:
        """(s,)"""
        return np.isnan(self.pole)


@dataclass(frozen=True, slots=True)
class Branch:
    """One mode over the usable speeds: ``pole``, whirl ``degree``, column in the modes (−1: lost).

    ``degree``: share of the kinetic energy in forward circular motion less that in backward.
    ``vector`` (speeds, n): its displacements in the coordinates of its system.
    Poles are those of the fixed frame, whatever the formulation. ``track``: at more speeds.
    """

    kind: str
    pole: Complex
    degree: Array
    column: NDArray[np.intp]
    vector: Complex
    track: Track

    @property
    def frequency(self) -> Array:
        """|Im pole| / 2π [Hz], NaN where the mode is lost."""
        return np.abs(self.pole.imag) / (2.0 * math.pi)

    @property
    def whirl(self) -> Array:
        """+1 forward, −1 backward, 0 planar: which circular part of y, z dominates."""
        return np.where(np.abs(self.degree) < PLANAR, 0.0, np.sign(self.degree))

    def at_all(self, speed: Array) -> Branch:
        """The same mode at every ``speed`` (s,) [rad/s], of a motion that was solved at one."""
        count = len(speed)
        pole, vector = np.repeat(self.pole, count), np.repeat(self.vector, count, axis=0)
        degree, column = np.repeat(self.degree, count), np.repeat(self.column, count)
        return Branch(self.kind, pole, degree, column, vector, Track(speed, pole, vector))

    @property
    def creeping(self) -> bool:
        """It hardly swings at most speeds."""
        return bool(creeps((-self.pole.real / np.abs(self.pole))[:, None])[0])

    @property
    def born(self) -> int:
        """First speed at which it is there."""
        return int((self.column >= 0).argmax())


def branches_of(scene: Scene, spec: CampbellSpec, motions: Sequence[str] = MOTIONS) -> list[Branch]:
    """Modes of ``motions``, and of what supports couple to them, that come below
    ``spec.max_frequency``."""
    alone = {"bending": _bending, "axial": _axial, "torsion": _torsion}
    branches = _coupled(scene, spec) if scene.coupled_motions & set(motions) else []
    for motion in motions:
        if motion not in scene.coupled_motions:
            branches += alone[motion](scene, spec)
    band = 2.0 * math.pi * spec.max_frequency
    return [b for b in branches if np.nanmin(np.abs(b.track.pole.imag)) <= band]


def home_of(scene: Scene, kind: str) -> str:
    """A motion whose system a mode of this kind was found in, the same for all coupled ones."""
    coupled = scene.coupled_motions
    return min(coupled) if kind in coupled else kind


def _bending(scene: Scene, spec: CampbellSpec) -> list[Branch]:
    if not scene.bending.isotropic:
        branches = _followed("bending", scene, spec, (+1.0,))
        return [replace(b, degree=whirl_degree(b.vector, b.column < 0)) for b in branches]
    return _followed("bending", scene, spec, (-1.0, +1.0))


def _axial(scene: Scene, spec: CampbellSpec) -> list[Branch]:
    return _followed("axial", scene, spec, (+1.0,))


def _torsion(scene: Scene, spec: CampbellSpec) -> list[Branch]:
    return _followed("torsion", scene, spec, (+1.0,))


def _coupled(scene: Scene, spec: CampbellSpec) -> list[Branch]:
    """The modes of the motions that supports couple."""
    branches, places = [], scene.coupled.places
    for branch in _followed(min(scene.coupled_motions), scene, spec, (+1.0,)):
        squares = np.abs(branch.vector[branch.column >= 0]) ** 2
        squares = squares / squares.sum(axis=1, keepdims=True)
        energy = {motion: squares[:, own].sum() for motion, own in places.items()}
        kind = max(energy, key=lambda motion: float(energy[motion]))
        degree = np.where(branch.column < 0, np.nan, 0.0)
        if kind == "bending":
            degree = whirl_degree(branch.vector[:, places[kind]], branch.column < 0)
        branches.append(replace(branch, kind=kind, degree=degree))
    return branches


def _followed(
    home: str, scene: Scene, spec: CampbellSpec, sides: tuple[float, ...]
) -> list[Branch]:
    """Branches of the modes of a system that turn with e^(i·side·ω t), ω > 0.

    Where it is not clear between two speeds who is who, the machine is solved at further ones.
    """
    sweep = _Sweep.of(scene, home)
    speed = scene.speed[scene.usable]
    if len(sweep.steps) < len(speed):  # solved at one, as nothing changes with the speed
        same = [step.pole for step in sweep.steps]
        return [b.at_all(speed) for side in sides for b in sweep.branches(home, spec, side, same)]
    bends = home == "bending" or {"bending", home} <= scene.coupled_motions
    knots = knots_between(scene) if bends else ()
    if len(knots):
        sweep = sweep.refined(scene, home, list(knots))
    for _ in range(ROUNDS):
        wanted = [x for side in sides for x in sweep.doubts(spec, side)]
        if not wanted or len(sweep.steps) > MOST_STEPS:
            break
        finer = sweep.refined(scene, home, wanted)
        if len(finer.steps) == len(sweep.steps):
            break
        sweep = finer
    expected = _ahead(sweep.steps, 2.0 * math.pi * MARGIN * spec.max_frequency)
    return [b for side in sides for b in sweep.branches(home, spec, side, expected)]


@dataclass(frozen=True, eq=False, slots=True)
class _Step:
    """All modes of a system at one ``speed``: ``pole`` (k,) in the fixed frame, ``vector`` (n, k),
    ``free`` (k,); ``system`` in the coordinates of ``frame``; ``given``: the case names the
    speed."""

    speed: float
    pole: Complex
    vector: Complex
    free: NDArray[np.bool_]
    system: tuple[Complex, Matrix, Matrix]
    frame: float
    given: bool

    def chosen(self, side: float, ceiling: float) -> NDArray[np.intp]:
        """Columns that turn to ``side``, ascending, up to ``ceiling`` [rad/s]."""
        turning = side * self.pole.imag
        columns = np.flatnonzero(swings(self.pole, turning) & (turning < ceiling) & ~self.free)
        return columns[np.argsort(turning[columns])]


def _ahead(steps: Sequence[_Step], ceiling: float) -> list[Complex]:
    """Poles (k,) to be expected of each step at the next one: λ − w (λ ΔD + ΔK) v. Those beyond
    ``ceiling`` [rad/s], and all of the last step, are expected where they are."""
    poles = [step.pole for step in steps]
    if len(steps) < 2:
        return poles
    left, stiffness, damping = map(np.stack, zip(*(s.system for s in steps), strict=True))
    frame, fixed = np.array([step.frame for step in steps]), np.stack(poles[:-1])
    slowest = np.argsort(np.abs(fixed.imag), axis=1, kind="stable")
    below = slowest[:, : int((np.abs(fixed.imag) < ceiling).sum(axis=1).max())]
    before = list(zip(below, steps[:-1], left[:-1], strict=True))
    vector = np.stack([step.vector[:, own] for own, step, _ in before])
    left = np.stack([each[own] for own, _, each in before])
    here = np.take_along_axis(fixed, below, axis=1)
    pole = here - 1j * frame[:-1, None]
    damped, held = (times(np.diff(each, axis=0), vector) for each in (damping, stiffness))
    change = pole[:, None] * damped + held
    with np.errstate(invalid="ignore", over="ignore"):
        move = np.einsum("skn,snk->sk", left, change)
        known = np.abs(move) < FARTHEST * np.abs(here)
    there = np.where(known, pole - move + 1j * frame[1:, None], here)
    np.put_along_axis(fixed, below, there, axis=1)
    return [*fixed, poles[-1]]


@dataclass(frozen=True, eq=False, slots=True)
class _Sweep:
    """The steps of one system, ascending in speed."""

    steps: tuple[_Step, ...]

    @classmethod
    def of(cls, scene: Scene, home: str, *, given: bool = True) -> _Sweep:
        """At the usable speeds of a scene; at the first of them, where modes were solved for one
        speed because they are the same at all."""
        found = scene.vibration(home)[1]
        frame = scene.bending.frame if home == "bending" else np.zeros(len(scene.usable))
        free = found.at_rest(frame[: len(found.pole)])
        steps = []
        for row, speed in enumerate(scene.speed[scene.usable][: len(found.pole)]):
            system = found.participation[row], found.stiffness[row], found.damping[row]
            pole = found.pole[row] + 1j * frame[row]
            vector = found.vector[row]
            steps.append(
                _Step(float(speed), pole, vector, free[row], system, float(frame[row]), given)
            )
        return cls(tuple(steps))

    def refined(self, scene: Scene, home: str, speed: list[float]) -> _Sweep:
        """With more speeds, where they have a solution."""
        other = scene.at(np.setdiff1d(speed, [step.speed for step in self.steps]))
        if all(other.outcome):
            return self
        more = _Sweep.of(other, home, given=False)
        return _Sweep(tuple(sorted((*self.steps, *more.steps), key=lambda step: step.speed)))

    def doubts(self, spec: CampbellSpec, side: float) -> list[float]:
        """Speeds that would tell who is who."""
        speed = np.array([step.speed for step in self.steps])
        band = 2.0 * math.pi * spec.max_frequency
        columns = [step.chosen(side, MARGIN * band) for step in self.steps]
        narrowest = NARROWEST * float(np.ptp(speed))
        return doubts(speed, *self._followable(columns, side), WITHIN * band, narrowest)

    def branches(
        self, kind: str, spec: CampbellSpec, side: float, expected: list[Complex]
    ) -> list[Branch]:
        """Those that turn to ``side``, at the speeds of the case; poles ``expected`` at the next
        step."""
        ceiling = 2.0 * math.pi * MARGIN * spec.max_frequency
        columns = [step.chosen(side, ceiling) for step in self.steps]
        ahead = [side * pole.imag[own] for pole, own in zip(expected, columns, strict=True)]
        path = follow(*self._followable(columns, side), ahead)
        given = [k for k, step in enumerate(self.steps) if step.given]
        return [
            self._branch(kind, side, given, columns, path[:, own])
            for own in np.flatnonzero((path[given] >= 0).any(axis=0))
        ]

    def _followable(
        self, columns: list[NDArray[np.intp]], side: float
    ) -> tuple[list[Complex], list[Array]]:
        """Vectors and frequencies of some columns of every step."""
        both = list(zip(self.steps, columns, strict=True))
        vectors = [step.vector[:, own] for step, own in both]
        return vectors, [side * step.pole.imag[own] for step, own in both]

    def _branch(
        self,
        kind: str,
        side: float,
        given: list[int],
        columns: list[NDArray[np.intp]],
        place: NDArray[np.intp],
    ) -> Branch:
        """One path: its ``place`` among the ``columns`` of every step; −1 where it is lost."""
        column = np.array([c[p] if p >= 0 else -1 for c, p in zip(columns, place, strict=True)])
        both = list(zip(self.steps, column, strict=True))
        pole = np.array([step.pole[c] for step, c in both])
        vector = np.array([step.vector[:, c] for step, c in both])
        pole[column < 0] = complex(np.nan, np.nan)
        track = Track(np.array([step.speed for step in self.steps]), pole, vector)
        seen, degree = column[given], side if kind == "bending" else 0.0
        whirl = np.where(seen < 0, np.nan, degree)
        return Branch(kind, pole[given], whirl, seen, vector[given], track)


def knots_between(scene: Scene) -> Array:
    """Speeds [rad/s] of tables of supports between those of the case, where lines bend."""
    speed = scene.speed[scene.usable]
    knots = np.array([at for support in scene.spindle.supports for at in support.speeds])
    inside = np.unique(knots[(knots > speed[0]) & (knots < speed[-1])] if len(knots) else knots)
    return inside[:: 1 + len(inside) // MOST_KNOTS]


def whirl_degree(vector: Complex, lost: NDArray[np.bool_]) -> Array:
    """Forward less backward share of motions (speeds, 2m) of both planes, NaN where ``lost``."""
    y, z = np.split(vector, 2, axis=1)
    forward, backward = np.abs(y + 1j * z), np.abs(y - 1j * z)
    difference = (forward**2 - backward**2).sum(axis=1)
    return np.where(lost, np.nan, difference / (forward**2 + backward**2).sum(axis=1))
