"""Modes over speed: those of every subsystem, each followed by its shape.

A mode of motions that something couples is named after the one with the largest share of its
kinetic energy, on the mean of all speeds: of two modes that veer, what each is over most of the
range.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotordyn.arrays import Array, Complex, Flags, Indices
from rotordyn.equation.free_motion import FreeMotions
from rotordyn.equation.linear import Linear
from rotordyn.modes.band import Band
from rotordyn.modes.overdamped import is_overdamped
from rotordyn.numerics.follow import doubts, follow
from rotordyn.numerics.modes import swings
from rotordyn.numerics.products import times
from rotordyn.scene.scene import Scene

MOTIONS = ("bending", "axial", "torsion")
MARGIN = 1.5  # modes up to this multiple of the highest frequency are followed
WITHIN = 1.1  # doubts about modes above this multiple are left
ROUNDS, MOST_STEPS = 12, 400  # of further speeds; of speeds in all
MOST_BREAKPOINTS = 200  # of tables of supports, beyond which only every second (third …) is taken
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
    def lost(self) -> Flags:
        """(s,)"""
        return np.isnan(self.pole)


@dataclass(frozen=True, slots=True)
class Branch:
    """One mode over the usable speeds: ``pole`` of Im > 0, whirl ``degree``, column in the modes of
    the subsystem of this number (−1: lost).

    ``degree``: share of the kinetic energy in forward circular motion less that in backward.
    ``vector`` (speeds, n): its displacements in the coordinates of its subsystem. ``track``: at
    more speeds. ``side``: +1 or −1 of whirl where planes are one, else 0.
    """

    kind: str
    subsystem: int
    pole: Complex
    degree: Array
    column: Indices
    vector: Complex
    track: Track
    side: float

    @property
    def frequency(self) -> Array:
        """|Im pole| / 2π [Hz], NaN where the mode is lost."""
        return np.abs(self.pole.imag) / (2.0 * math.pi)

    @property
    def whirl(self) -> Array:
        """+1 forward, −1 backward, 0 planar: which circular part of y, z dominates."""
        return np.where(np.abs(self.degree) < PLANAR, 0.0, np.sign(self.degree))

    @property
    def overdamped(self) -> bool:
        """It hardly swings at most speeds."""
        return bool(is_overdamped((-self.pole.real / np.abs(self.pole))[:, None])[0])

    @property
    def born(self) -> int:
        """First speed at which it is there."""
        return int((self.column >= 0).argmax())


def branches_of(scene: Scene, band: Band, motions: Sequence[str] = MOTIONS) -> list[Branch]:
    """Modes of the subsystems of ``motions`` that come below ``band.max_frequency``."""
    branches = [b for k in scene.with_motions(motions) for b in _followed(scene, band, k)]
    return [b for b in branches if np.nanmin(np.abs(b.track.pole.imag)) <= band.highest]


def _followed(scene: Scene, band: Band, subsystem: int) -> list[Branch]:
    """Branches of a subsystem. Where it is not clear between two speeds who is who, the machine is
    solved at further ones."""
    sweep = _Sweep.of(scene, subsystem, band)
    breakpoints = breakpoints_between(scene) if "bending" in scene.name_of(subsystem) else ()
    if len(breakpoints):
        sweep = sweep.refined(scene, subsystem, band, list(breakpoints))
    sides = (-1.0, 1.0) if sweep.steps[0].whirl.any() else (0.0,)
    for _ in range(0 if sweep.constant else ROUNDS):
        wanted = [x for side in sides for x in sweep.doubts(band, side)]
        if not wanted or len(sweep.steps) > MOST_STEPS:
            break
        finer = sweep.refined(scene, subsystem, band, wanted)
        if len(finer.steps) == len(sweep.steps):
            break
        sweep = finer
    expected = [] if sweep.constant else _ahead(sweep.steps, MARGIN * band.highest)
    linear = scene.system(subsystem).linear
    return [b for side in sides for b in sweep.branches(linear, subsystem, side, expected)]


@dataclass(frozen=True, eq=False, slots=True)
class _Step:
    """All modes of a subsystem at one ``speed``: ``pole`` (k,), ``vector`` (n, k), ``left`` (k, n),
    which are ``followed`` (k,), and ``whirl`` (k,) where planes are one; ``stiffness`` and
    ``damping`` (n, n); ``given``: the case names the speed."""

    speed: float
    pole: Complex
    vector: Complex
    left: Complex
    followed: Flags
    whirl: Array
    stiffness: Array
    damping: Array
    given: bool

    def chosen(self, side: float) -> Indices:
        """Columns of followed modes that whirl to ``side``, ascending."""
        columns = np.flatnonzero(self.followed & (self.whirl == side))
        return columns[np.argsort(self.pole.imag[columns])]


def _ahead(steps: Sequence[_Step], ceiling: float) -> list[Complex]:
    """Poles (k,) to be expected of each step at the next one: λ − w (λ ΔC + ΔK) v. Those beyond
    ``ceiling`` [rad/s], and all of the last step, are expected where they are."""
    expected = [step.pole.copy() for step in steps]
    for step, after, pole in zip(steps[:-1], steps[1:], expected[:-1], strict=True):
        below = np.flatnonzero(np.abs(step.pole.imag) < ceiling)
        vector, left, here = step.vector[:, below], step.left[below], step.pole[below]
        damped = times(after.damping - step.damping, vector)
        change = here * damped + times(after.stiffness - step.stiffness, vector)
        with np.errstate(invalid="ignore", over="ignore"):
            move = (left * change.T).sum(axis=1)
            known = np.abs(move) < FARTHEST * np.abs(here)
        pole[below] = np.where(known, here - move, here)
    return expected


@dataclass(frozen=True, eq=False, slots=True)
class _Sweep:
    """The steps of one subsystem, ascending in speed; ``constant``: all are the same."""

    steps: tuple[_Step, ...]
    constant: bool

    @classmethod
    def of(cls, scene: Scene, subsystem: int, band: Band, *, given: bool = True) -> _Sweep:
        """At the usable speeds of a scene."""
        motions = scene.system(subsystem)
        linear, followed = motions.linear, found_in(motions, MARGIN * band.highest)
        return cls(
            tuple(
                _Step(
                    float(speed),
                    motions.pole[row],
                    motions.vector[row],
                    motions.left[row],
                    followed[row],
                    motions.whirl[row],
                    linear.stiffness[row],
                    linear.damping[row],
                    given,
                )
                for row, speed in enumerate(scene.speed[scene.usable])
            ),
            motions.solved_once,
        )

    def refined(self, scene: Scene, subsystem: int, band: Band, speed: list[float]) -> _Sweep:
        """With more speeds, where they have a solution."""
        other = scene.at(np.setdiff1d(speed, [step.speed for step in self.steps]))
        if not len(other.speed) or all(other.outcome):
            return self
        more = _Sweep.of(other, subsystem, band, given=False)
        steps = sorted((*self.steps, *more.steps), key=lambda step: step.speed)
        return _Sweep(tuple(steps), constant=False)

    def doubts(self, band: Band, side: float) -> list[float]:
        """Speeds that would tell who is who."""
        speed = np.array([step.speed for step in self.steps])
        columns = [step.chosen(side) for step in self.steps]
        narrowest = NARROWEST * float(np.ptp(speed))
        return doubts(speed, *self._followable(columns), WITHIN * band.highest, narrowest)

    def branches(
        self, linear: Linear, subsystem: int, side: float, expected: list[Complex]
    ) -> list[Branch]:
        """Those that whirl to ``side``, at the speeds of the case; poles ``expected`` at the next
        step."""
        if self.constant:
            columns = [self.steps[0].chosen(side)] * len(self.steps)
            path = np.tile(np.arange(len(columns[0])), (len(columns), 1))
        else:
            columns = [step.chosen(side) for step in self.steps]
            ahead = [pole.imag[chosen] for pole, chosen in zip(expected, columns, strict=True)]
            path = follow(*self._followable(columns), ahead)
        given = [k for k, step in enumerate(self.steps) if step.given]
        return [
            self._branch(linear, subsystem, side, given, columns, path[:, k])
            for k in np.flatnonzero((path[given] >= 0).any(axis=0))
        ]

    def _followable(self, columns: list[Indices]) -> tuple[list[Complex], list[Array]]:
        """Vectors and frequencies of some columns of every step."""
        both = list(zip(self.steps, columns, strict=True))
        return [s.vector[:, known] for s, known in both], [s.pole.imag[known] for s, known in both]

    def _branch(
        self,
        linear: Linear,
        subsystem: int,
        side: float,
        given: list[int],
        columns: list[Indices],
        place: Indices,
    ) -> Branch:
        """One path: its ``place`` among the ``columns`` of every step; −1 where it is lost."""
        column = np.array([c[p] if p >= 0 else -1 for c, p in zip(columns, place, strict=True)])
        both = list(zip(self.steps, column, strict=True))
        pole = np.array([step.pole[c] for step, c in both])
        vector = np.array([step.vector[:, c] for step, c in both])
        pole[column < 0] = complex(np.nan, np.nan)
        track = Track(np.array([step.speed for step in self.steps]), pole, vector)
        kind = _kind(linear, vector[column >= 0])
        columns_given = column[given]
        degree = np.where(columns_given < 0, np.nan, 0.0)
        if kind == "bending":
            degree = np.where(columns_given < 0, np.nan, whirl_degree(linear, vector[given]))
        return Branch(
            kind, subsystem, pole[given], degree, columns_given, vector[given], track, side
        )


def _kind(linear: Linear, vector: Complex) -> str:
    """The motion with the largest share of the kinetic energy."""
    squares = np.abs(vector) ** 2
    squares = squares / squares.sum(axis=1, keepdims=True)
    energy = {m: float(squares[:, linear.energy_of(m)].sum()) for m in sorted(linear.kinds)}
    return max(energy, key=lambda motion: energy[motion])


def breakpoints_between(scene: Scene) -> Array:
    """Speeds [rad/s] of tables of supports between those of the case, where lines bend."""
    speed = scene.speed[scene.usable]
    every = np.array([at for support in scene.spindle.supports for at in support.speeds])
    inside = np.unique(every[(every > speed[0]) & (every < speed[-1])] if len(every) else every)
    return inside[:: 1 + len(inside) // MOST_BREAKPOINTS]


def whirl_degree(linear: Linear, vector: Complex) -> Array:
    """Forward less backward share (s,) of motions (s, n) of a subsystem in both planes."""
    y, z = linear.planes
    return circular_share(vector[:, y], vector[:, z])


def circular_share(y: Complex, z: Complex) -> Array:
    """Of motions (s, k) in plane y and in plane z."""
    forward, backward = np.abs(y + 1j * z) ** 2, np.abs(y - 1j * z) ** 2
    return np.asarray((forward - backward).sum(axis=1) / (forward + backward).sum(axis=1))


def found_in(motions: FreeMotions, ceiling: float) -> Flags:
    """Motions (s, k) that swing below ``ceiling`` [rad/s] and are held."""
    with np.errstate(invalid="ignore"):
        return np.asarray(swings(motions.pole) & (motions.pole.imag < ceiling) & ~motions.at_rest)
