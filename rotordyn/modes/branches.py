"""Modes over speed: those of every subsystem, each followed by its shape.

A mode of coupled motions is named after the one with the largest share of its kinetic energy, on
the mean of all speeds: of two modes that veer, what each is over most of the range.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Complex, Flags, Indices
from rotordyn.equation.free_motion import FreeMotions
from rotordyn.equation.linear import Linear
from rotordyn.modes.overdamped import is_overdamped
from rotordyn.numerics.follow import Steps, doubts, follow
from rotordyn.numerics.modes import oscillates
from rotordyn.numerics.products import times
from rotordyn.numerics.repeated import continued_vectors
from rotordyn.scene.scene import Scene

MOTIONS = ("bending", "axial", "torsion")
MARGIN = 1.5  # modes up to this multiple of the highest frequency are followed
WITHIN = 1.1  # doubts about modes above this multiple are ignored
ROUNDS, MOST_STEPS = 12, 400  # of further speeds; of speeds in all
MOST_BREAKPOINTS = 200  # of tables of supports, beyond which only every second (third …) is taken
NARROWEST = 1e-7  # of the range of speeds: no finer steps
FARTHEST = 0.3  # of a pole: a larger predicted change over a step is ignored
MODES_ALONG = {
    "pole": 1,
    "vector": 2,
    "left": 1,
    "followed": 1,
    "whirl": 1,
}  # axis of modes in arrays of a sweep
NO_POLE = complex(np.nan, np.nan)
PLANAR = 1e-6  # whirl degree below which a motion is straight


@dataclass(frozen=True, eq=False, slots=True)
class Track:
    """One mode at every ``speed`` (s,) [rad/s] at which it was solved for, with those between the
    speeds of the case; ``pole`` (s,) is NaN where it is ``lost``; ``vector`` (s, n)."""

    speed: Array
    pole: Complex
    vector: Complex

    @property
    def lost(self) -> Flags:
        """Speeds at which the mode is lost (s,)."""
        return np.isnan(self.pole)


@dataclass(frozen=True, slots=True)
class Branch:
    """One mode over the usable speeds: ``pole`` of Im > 0, whirl ``degree``, column in the modes of
    the subsystem of this number (−1: lost).

    ``degree``: share of the kinetic energy in forward circular motion less that in backward.
    ``vector`` (speeds, n): its displacements in the coordinates of its subsystem; where its pole is
    also that of others, combined as at the nearest speed where it is not (``continued_vectors``).
    ``track``: at more speeds. ``side``: +1 or −1 of whirl where planes are one, else 0.
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

    def frequency_in_frame(self, speed: Array) -> Array:
        """Return the angular frequency [rad/s] in a frame that rotates at ``speed`` (speeds,)."""
        omega = np.abs(self.pole.imag)
        if self.kind != "bending":
            return omega
        return np.abs(omega - np.sign(self.degree) * speed)

    @property
    def whirl(self) -> Array:
        """+1 forward, −1 backward, 0 planar: which circular part of y, z dominates."""
        return np.where(np.abs(self.degree) < PLANAR, 0.0, np.sign(self.degree))

    @property
    def overdamped(self) -> bool:
        """True if it hardly oscillates at most speeds."""
        return bool(is_overdamped((-self.pole.real / np.abs(self.pole))[:, None])[0])

    @property
    def first_row(self) -> int:
        """Index of the first speed at which it exists."""
        return int((self.column >= 0).argmax())


def branches_of(scene: Scene, highest: float, motions: Sequence[str] = MOTIONS) -> list[Branch]:
    """Return modes of the subsystems of ``motions`` that come below the ``highest`` angular
    frequency [rad/s]."""
    branches = [b for k in scene.with_motions(motions) for b in _followed(scene, highest, k)]
    return [b for b in branches if np.nanmin(np.abs(b.track.pole.imag)) <= highest]


def _followed(scene: Scene, highest: float, subsystem: int) -> list[Branch]:
    """Return branches of a subsystem. Where modes are not clearly identified between two speeds,
    the machine is solved at further ones."""
    sweep = _Sweep.of(scene, subsystem, highest)
    breakpoints = breakpoints_between(scene) if "bending" in scene.name_of(subsystem) else ()
    if len(breakpoints):
        sweep = sweep.refined(scene, subsystem, highest, list(breakpoints))
    for _ in range(0 if sweep.constant else ROUNDS):
        further = sweep.doubts(highest)
        if not further or len(sweep.speed) > MOST_STEPS:
            break
        finer = sweep.refined(scene, subsystem, highest, further)
        if len(finer.speed) == len(sweep.speed):
            break
        sweep = finer
    linear = scene.system(subsystem).linear
    expected = sweep.pole if sweep.constant else sweep.ahead(MARGIN * highest)
    return [
        branch
        for side in sweep.sides
        for branch in sweep.branches(linear, subsystem, side, expected)
    ]


@dataclass(frozen=True, eq=False)
class _Sweep:
    """All modes of a subsystem at every ``speed`` (s,), ascending.

    ``pole`` (s, k), ``vector`` (s, n, k), ``left`` (s, k, n), those that are ``followed`` (s, k),
    ``whirl`` (s, k) where planes are one, as they may be at some speeds; NaN where a speed has
    fewer. ``stiffness`` and ``damping`` (s, n, n). ``given`` (s,): the case names the speed.
    ``constant``: all speeds have the same modes.
    """

    speed: Array
    pole: Complex
    vector: Complex
    left: Complex
    followed: Flags
    whirl: Array
    stiffness: Array
    damping: Array
    given: Flags
    constant: bool

    @classmethod
    def of(cls, scene: Scene, subsystem: int, highest: float, *, given: bool = True) -> _Sweep:
        """Return the sweep over the usable speeds of a scene."""
        motions, speed = scene.system(subsystem), scene.speed[scene.usable]
        return cls(
            speed,
            motions.pole,
            motions.vector,
            motions.left,
            found_in(motions, MARGIN * highest),
            motions.whirl,
            motions.linear.stiffness,
            motions.linear.damping,
            np.full(len(speed), given),
            motions.solved_once,
        )

    def refined(self, scene: Scene, subsystem: int, highest: float, speed: list[float]) -> _Sweep:
        """Return the sweep with more speeds, where they have a solution."""
        other = scene.at(np.setdiff1d(speed, self.speed))
        if not len(other.speed) or all(other.outcome):
            return self
        added = _Sweep.of(other, subsystem, highest, given=False)
        order = np.argsort(np.concatenate([self.speed, added.speed]), kind="stable")
        columns = max(self.pole.shape[1], added.pole.shape[1])

        joined = {}
        for name in (field.name for field in fields(self) if field.name != "constant"):
            parts = [getattr(sweep, name) for sweep in (self, added)]
            if name in MODES_ALONG:
                parts = [_filled(part, columns, MODES_ALONG[name]) for part in parts]
            joined[name] = np.concatenate(parts)[order]
        return _Sweep(**joined, constant=False)

    @cached_property
    def sides(self) -> dict[float, tuple[Indices, Steps]]:
        """Followed modes by direction of whirl, 0 of all unless planes are one at every speed:
        columns (s, k) by ascending frequency, those of other modes last where a speed has fewer,
        and the steps that they make."""
        if not (self.whirl != 0.0).any(axis=1).all():
            return {0.0: self._chosen(self.followed)}
        return {side: self._chosen(self.followed & (self.whirl == side)) for side in (-1.0, 1.0)}

    def _chosen(self, wanted: Flags) -> tuple[Indices, Steps]:
        """Return columns and steps of the modes ``wanted`` (s, k)."""
        count = wanted.sum(axis=1, keepdims=True)
        order = np.where(wanted, self.pole.imag, np.inf).argsort(axis=1, kind="stable")
        columns = order[:, : int(count.max(initial=0))]
        present = np.arange(columns.shape[1]) < count
        vectors = np.take_along_axis(self.vector, columns[:, None], axis=2)
        poles = np.where(present, np.take_along_axis(self.pole, columns, axis=1), NO_POLE)
        steps = Steps(np.where(present[:, None], vectors, 0.0), poles)
        return columns, steps

    def doubts(self, highest: float) -> list[float]:
        """Return speeds that would identify modes."""
        narrowest = NARROWEST * float(np.ptp(self.speed))
        within = WITHIN * highest
        parts = [doubts(self.speed, steps, within, narrowest) for _, steps in self.sides.values()]
        return [speed for speeds in parts for speed in speeds]

    def branches(
        self, linear: Linear, subsystem: int, side: float, expected: Complex
    ) -> list[Branch]:
        """Return branches that whirl to ``side``, at the speeds of the case; poles ``expected``
        (s, k) at the next speed."""
        columns, steps = self.sides[side]
        if self.constant:
            path = np.tile(np.arange(columns.shape[1]), (len(columns), 1))
        else:
            path = follow(steps, np.take_along_axis(expected, columns, axis=1))
        given = self.given
        path = path[:, (path[given] >= 0).any(axis=0)]
        lost = path < 0
        column = np.where(lost, -1, np.take_along_axis(columns, path, axis=1))
        pole = np.take_along_axis(self.pole, column, axis=1)
        pole[lost] = NO_POLE
        vector = np.take_along_axis(self.vector, column[:, None], axis=2)
        vector = continued_vectors(self.speed, pole, vector)
        kinds, at_given = _kinds(linear, vector, ~lost), vector[given]
        degree = np.zeros(column[given].shape)
        if bending := [k for k, kind in enumerate(kinds) if kind == "bending"]:
            degree[:, bending] = whirl_degree(linear, at_given[..., bending])
        degree[lost[given]] = np.nan
        return [
            Branch(
                kind,
                subsystem,
                pole[given, k],
                degree[:, k],
                column[given, k],
                at_given[..., k],
                Track(self.speed, pole[:, k], vector[..., k]),
                side,
            )
            for k, kind in enumerate(kinds)
        ]

    def ahead(self, ceiling: float) -> Complex:
        """Return poles (s, k) expected at the next speed: λ − w (λ ΔC + ΔK) v. Columns whose poles
        are all beyond ``ceiling`` [rad/s], and the last speed, keep theirs."""
        expected, columns = self.pole.copy(), (np.abs(self.pole.imag) < ceiling).any(axis=0)
        pole = self.pole[:-1, columns]
        vector, left = self.vector[:-1, :, columns], self.left[:-1, columns]
        damped = times(np.diff(self.damping, axis=0), vector)
        with np.errstate(invalid="ignore", over="ignore"):
            change = pole[:, None] * damped + times(np.diff(self.stiffness, axis=0), vector)
            move = np.einsum("skn,snk->sk", left, change)
            small = np.abs(move) < FARTHEST * np.abs(pole)
        expected[:-1, columns] = np.where(small, pole - move, pole)
        return expected


def _filled(values: NDArray[Any], columns: int, axis: int) -> NDArray[Any]:
    """Return values padded to ``columns`` along an axis, with those of absent modes."""
    padding = [(0, 0)] * values.ndim
    padding[axis] = 0, columns - values.shape[axis]
    absent: Any = complex(np.nan, np.nan) if np.iscomplexobj(values) else np.nan
    return np.pad(values, padding, constant_values=False if values.dtype == bool else absent)


def _kinds(linear: Linear, vector: Complex, there: Flags) -> list[str]:
    """Return the motion with the largest share of the kinetic energy of modes (s, n, k), at the
    speeds where they are ``there`` (s, k)."""
    names = sorted(linear.kinds)
    if len(names) == 1:
        return names * there.shape[1]
    squares = np.where(there[:, None], vector.real**2 + vector.imag**2, 0.0)
    share = squares / np.where(there, squares.sum(axis=1), 1.0)[:, None]
    energy = [share[:, linear.energy_of(name)].sum(axis=(0, 1)) for name in names]
    return [names[k] for k in np.argmax(energy, axis=0).tolist()]


def breakpoints_between(scene: Scene) -> Array:
    """Return speeds [rad/s] of support tables between those of the case, where lines bend."""
    speed = scene.speed[scene.usable]
    table = np.array([at for support in scene.spindle.supports for at in support.speeds])
    inside = np.unique(table[(table > speed[0]) & (table < speed[-1])] if len(table) else table)
    return inside[:: 1 + len(inside) // MOST_BREAKPOINTS]


def whirl_degree(linear: Linear, vector: Complex) -> Array:
    """Return forward less backward share (s, …) of motions (s, n, …) in both planes."""
    y, z = linear.planes
    return circular_share(vector[:, y], vector[:, z])


def circular_share(y: Complex, z: Complex) -> Array:
    """Return forward less backward share of motions (s, n, …) in plane y and plane z."""
    forward, backward = np.abs(y + 1j * z) ** 2, np.abs(y - 1j * z) ** 2
    return np.asarray((forward - backward).sum(axis=1) / (forward + backward).sum(axis=1))


def found_in(motions: FreeMotions, ceiling: float) -> Flags:
    """Return which motions (s, k) oscillate below ``ceiling`` [rad/s] and are not free."""
    with np.errstate(invalid="ignore"):
        return np.asarray(
            oscillates(motions.pole) & (motions.pole.imag < ceiling) & ~motions.at_rest
        )
