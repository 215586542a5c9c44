"""Axial measurements: displacement over force on both branches, over speed, and stiffness."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from rotordyn.arrays import Array, Indices
from rotordyn.case.case import Case
from rotordyn.case.identification import BRANCHES
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.field import shown
from rotordyn.quantity import suggestion
from rotordyn.scene.spec import acts_across
from rotordyn.study.identification.joined_speeds import joined
from rotordyn.study.identification.measurement import Data
from rotordyn.study.identification.trial import Trial

SHAFT = "shaft"
RPM = np.pi / 30.0
DRAWN = 61  # forces of a branch in figures
NEAR = 100.0  # N, half of the force range over which a stiffness is measured


@dataclass(frozen=True, kw_only=True)
class Axial:
    """Common part of axial measurements."""

    name: str
    deviation: float

    def analyses(self, case: Case) -> Mapping[str, Any]:
        """No analyses: the axial problem is solved on its own."""
        return {}

    def speeds(self, case: Case) -> Iterator[float]:
        """Yield the distinct speeds of the points, ascending."""
        yield from sorted(set(self._speeds()))

    def _speeds(self) -> list[float]:
        raise NotImplementedError

    def faults(self, case: Case) -> Iterator[str]:
        """Yield faults: no bearings, transverse loads, a history, heat flow, an unknown body."""
        spindle = case.spindle
        if spindle is None or not spindle.seats:
            yield f"measurement {self.name}: needs a spindle with bearings"
            return
        if acts_across(spindle, case.conditions):
            yield f"measurement {self.name}: needs no loads across the axis: leave them out"
        if case.conditions.history:
            yield f"measurement {self.name}: is run up from rest: leave out the history"
        if case.conditions.heat_flow is not None:
            yield f"measurement {self.name}: needs no heat flow: give temperatures"
        body = self._body
        known = (SHAFT, *(sleeve.name for sleeve in spindle.sleeves))
        if body not in known:
            yield (
                f"measurement {self.name}: of {shown(body)}: no such body; allowed: "
                f"{', '.join(known)}{suggestion(body, known)}"
            )

    @property
    def _body(self) -> str:
        return SHAFT


def _as_arrays(measurement: Any, *names: str) -> None:
    """Turn fields that may be given as lists into arrays."""
    for name in names:
        values = np.atleast_1d(np.asarray(getattr(measurement, name), dtype=float))
        object.__setattr__(measurement, name, values)


def row_at(trial: Trial, speed: float) -> int:
    """Index of the axial speed of a trial that is nearest to a speed [rad/s]."""
    return int(np.abs(np.array(trial.axial_speeds) - speed).argmin())


def _require_speeds(name: str, speed: Array) -> None:
    if len(speed) and not (np.isfinite(speed).all() and speed.min() >= 0.0):
        wrong = speed[~(np.isfinite(speed) & (speed >= 0.0))][0] * 30.0 / np.pi
        raise InvalidInput(
            f"measurement {name}: a speed is a number from 0 rpm up, got {wrong:.6g} rpm"
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class AxialCurve(Axial):
    """Displacement of ``of`` ("shaft" or a sleeve) under an axial force that falls and rises.

    ``speed`` [rad/s], ``branch``, ``force`` [N] (added to that of the case) and ``displacement``
    [m] towards +x, from the position at rest under the forces of the case, all (n,), in the order
    of measurement. ``tare`` [m]: standard deviation of an offset of each speed; ``drift`` [m]: of a
    linear drift along the curve of each speed; infinite if unknown, 0 for none. ``lowest``,
    ``highest`` force of the cycle [N], by default of the points. ``when`` (n,): time within the
    curve of its speed, from 0 to 1, by default evenly spaced. ``places`` (n,), if known: file and
    line of each point, for messages. Speeds within 1 % (1 rpm about rest) are taken as one.
    """

    speed: Array
    branch: tuple[str, ...]
    force: Array
    displacement: Array
    of: str = SHAFT
    tare: float = 0.0
    drift: float = 0.0
    lowest: float | None = None
    highest: float | None = None
    when: Array | None = None
    places: tuple[str, ...] = field(default=(), repr=False)  # the same study from another file

    def __post_init__(self) -> None:
        _as_arrays(self, "speed", "force", "displacement")
        if self.when is not None:
            _as_arrays(self, "when")
            if len(self.when) != len(self.speed):
                raise InvalidInput(
                    f"measurement {self.name}: when: given {len(self.when)} times; the curve has "
                    f"{len(self.speed)} points"
                )
        for k, word in enumerate(self.branch):
            if word not in BRANCHES:
                what = f"branch {shown(word)}{self._place(k)}; allowed: {', '.join(BRANCHES)}"
                raise InvalidInput(f"measurement {self.name}: {what}")
        sizes = {len(self.speed), len(self.branch), len(self.force), len(self.displacement)}
        if len(sizes) > 1:
            raise InvalidInput(
                f"measurement {self.name}: as many speeds, branches, forces and displacements are "
                f"needed: got {len(self.speed)}, {len(self.branch)}, {len(self.force)}, "
                f"{len(self.displacement)}"
            )
        _require_speeds(self.name, self.speed)
        given = self.speed
        object.__setattr__(self, "speed", joined(self.name, given))
        for speed, branch, rows in self._curves():
            way = np.diff(self.force[rows]) * (-1.0 if branch == BRANCHES[0] else 1.0)
            if (way > 0.0).all():
                continue
            k = int(np.flatnonzero(way <= 0.0)[0])
            pair = self.force[rows[k : k + 2]]
            what = "repeated" if pair[0] == pair[1] else "out of order"
            of = given[self.speed == speed] / RPM
            one = f" ({of.min():.6g} to {of.max():.6g} rpm, taken as one)" if np.ptp(of) else ""
            raise InvalidInput(
                f"measurement {self.name}: points {what} on the {branch} branch at "
                f"{speed / RPM:.0f} rpm{one}: {pair[1]:g} N after {pair[0]:g} N"
                f"{self._place(int(rows[k + 1]))}"
            )

    def _place(self, k: int) -> str:
        return f" ({self.places[k]})" if self.places else ""

    def _curves(self) -> Iterator[tuple[float, str, Indices]]:
        for speed in sorted(set(self.speed.tolist())):
            for branch in BRANCHES:
                rows = np.flatnonzero((self.speed == speed) & (np.array(self.branch) == branch))
                yield speed, branch, rows

    def reduced(self, count: int) -> AxialCurve:
        """Reduce each branch at each speed to ``count`` points, evenly spaced along the curve.

        Raises InvalidInput if no branch has as many.
        """
        longest = max((len(rows) for _, _, rows in self._curves()), default=0)
        if count > longest > 0:
            raise InvalidInput(
                f"measurement {self.name}: points: given {count}; the longest branch has {longest}"
            )
        parts = [
            rows[_along_curve(self.force[rows], self.displacement[rows], count)]
            for _, _, rows in self._curves()
            if len(rows)
        ]
        rows = np.sort(np.concatenate(parts)) if parts else np.empty(0, dtype=np.intp)
        return replace(
            self,
            when=self._times[rows],
            speed=self.speed[rows],
            branch=tuple(self.branch[k] for k in rows),
            force=self.force[rows],
            displacement=self.displacement[rows],
            places=tuple(self.places[k] for k in rows) if self.places else (),
        )

    @property
    def _times(self) -> Array:
        """Time of each point within its curve, from 0 to 1 (n,)."""
        if self.when is not None:
            return self.when
        times = np.zeros(len(self.speed))
        for speed in set(self.speed.tolist()):
            at_speed = self.speed == speed
            times[at_speed] = np.linspace(0.0, 1.0, int(at_speed.sum()))
        return times

    @cached_property
    def data(self) -> Data:
        """All points, with tare and drift of each speed."""
        columns, deviations, names = [], [], []
        for speed in sorted(set(self.speed.tolist())):
            at_speed = self.speed == speed
            rpm = f"{speed / RPM:.0f} rpm"
            if self.tare:
                columns.append(at_speed.astype(float))
                deviations.append(self.tare)
                names.append(f"tare at {rpm}")
            if self.drift:
                columns.append(np.where(at_speed, self._times - 0.5, 0.0))
                deviations.append(self.drift)
                names.append(f"drift at {rpm}")
        pairs = zip(self.speed, self.branch, strict=True)
        n = len(self.force)
        return Data(
            self.name,
            self.displacement,
            np.full(n, self.deviation),
            "µm",
            1e6,
            self.force,
            "axial force [N]",
            tuple(f"{s / RPM:.0f} rpm, {b}" for s, b in pairs),
            np.stack(columns, axis=1) if columns else np.empty((n, 0)),
            np.array(deviations),
            tuple(names),
        )

    @property
    def finer(self) -> AxialCurve:
        """The same cycle at more forces, for figures; displacements are 0."""
        speeds: list[float] = []
        branches: list[str] = []
        forces: list[float] = []
        for speed, branch, rows in self._curves():
            if len(rows):
                ends = self.force[rows].min(), self.force[rows].max()
                all_forces = np.union1d(self.force[rows], np.linspace(*ends, DRAWN))
                speeds += [speed] * len(all_forces)
                branches += [branch] * len(all_forces)
                forces += all_forces.tolist()[:: -1 if branch == BRANCHES[0] else 1]
        return replace(
            self,
            speed=np.array(speeds),
            branch=tuple(branches),
            force=np.array(forces),
            displacement=np.zeros(len(forces)),
            when=None,
            places=(),
        )

    def _speeds(self) -> list[float]:
        return list(self.speed.tolist())

    @property
    def _body(self) -> str:
        return self.of

    def predicted(self, trial: Trial) -> Array:
        """Predicted displacements of the body (n,) [m]."""
        displacements = np.empty(len(self.force))
        axial = trial.axial
        body = axial.bodies.index(self.of)
        curves = list(self._curves())
        for (speed, _, falling), (_, _, rising) in zip(curves[::2], curves[1::2], strict=True):
            forces = self.force[falling], self.force[rising]
            branches = trial.cycle(row_at(trial, speed), *forces, self.lowest, self.highest)
            for rows, shifts in zip((falling, rising), branches, strict=True):
                displacements[rows] = shifts[:, body]
        return displacements


def _along_curve(force: Array, displacement: Array, count: int) -> Indices:
    """Indices of ``count`` points at equal arc lengths along a curve, its ends included.

    Force and displacement are scaled by their ranges (D. Noël, doctoral thesis, 2013, III.1.3.1).
    """
    if len(force) <= count:
        return np.arange(len(force))
    parts = [np.diff(each) / (np.ptp(each) or 1.0) for each in (force, displacement)]
    arc_length = np.concatenate([[0.0], np.cumsum(np.hypot(*parts))])
    rows = [int(np.abs(arc_length - at).argmin()) for at in np.linspace(0.0, arc_length[-1], count)]
    return np.array(sorted(set(rows)))


@dataclass(frozen=True, eq=False, kw_only=True)
class NoLoad(Axial):
    """Displacement (n,) [m] of ``of`` from its position at rest over ``speed`` [rad/s], without
    additional force; a speed may be measured several times.

    ``tare`` [m]: standard deviation of an offset common to all points.
    """

    speed: Array
    displacement: Array
    of: str = SHAFT
    tare: float = 0.0

    def __post_init__(self) -> None:
        _as_arrays(self, "speed", "displacement")
        _require_speeds(self.name, self.speed)
        speeds, count = len(self.speed), len(self.displacement)
        if speeds != count:
            raise InvalidInput(
                f"measurement {self.name}: one displacement at each speed is needed, got {count} "
                f"at {speeds} speeds"
            )

    @cached_property
    def data(self) -> Data:
        """All points, with the tare."""
        n, tared = len(self.speed), bool(self.tare)
        return Data(
            self.name,
            self.displacement,
            np.full(n, self.deviation),
            "µm",
            1e6,
            self.speed / RPM,
            "speed [rpm]",
            ("",) * n,
            np.ones((n, int(tared))),
            np.array([self.tare] * tared),
            ("tare",) * tared,
        )

    def _speeds(self) -> list[float]:
        return list(self.speed.tolist())

    @property
    def _body(self) -> str:
        return self.of

    def predicted(self, trial: Trial) -> Array:
        """Predicted displacements of the body (n,) [m]."""
        body = trial.axial.bodies.index(self.of)
        rows = [row_at(trial, speed) for speed in self.speed.tolist()]
        return np.asarray(trial.axial.shift[rows, body])


@dataclass(frozen=True, eq=False, kw_only=True)
class AxialStiffness(Axial):
    """Axial stiffness of the shaft [N/m] over ``speed`` [rad/s] on one ``branch``.

    Secant stiffness between the forces ``about`` − ``near`` and ``about`` + ``near`` [N], within a
    cycle from ``lowest`` to ``highest`` [N].
    """

    speed: Array
    stiffness: Array
    branch: str
    lowest: float
    highest: float
    near: float = NEAR
    about: float = 0.0

    def __post_init__(self) -> None:
        _as_arrays(self, "speed", "stiffness")
        _require_speeds(self.name, self.speed)
        if len(self.speed) != len(self.stiffness):
            raise InvalidInput(
                f"measurement {self.name}: one stiffness at each speed is needed, got "
                f"{len(self.stiffness)} at {len(self.speed)} speeds"
            )
        if self.branch not in BRANCHES:
            raise InvalidInput(
                f"measurement {self.name}: branch {shown(self.branch)}; allowed: "
                f"{', '.join(BRANCHES)}"
            )
        if not self.near > 0.0:
            raise InvalidInput(
                f"measurement {self.name}: near: given {self.near:g} N; allowed: above 0 N"
            )
        ends = self.about - self.near, self.about + self.near
        if not self.lowest < ends[0] < ends[1] < self.highest:
            raise InvalidInput(
                f"measurement {self.name}: the cycle goes beyond {ends[0]:g} N to {ends[1]:g} N, "
                f"where the stiffness is read: given lowest {self.lowest:g} N, highest "
                f"{self.highest:g} N"
            )

    @cached_property
    def data(self) -> Data:
        """All points."""
        n = len(self.speed)
        return Data(
            self.name,
            self.stiffness,
            np.full(n, self.deviation),
            "N/µm",
            1e-6,
            self.speed / RPM,
            "speed [rpm]",
            (self.branch,) * n,
        )

    def _speeds(self) -> list[float]:
        return list(self.speed.tolist())

    def predicted(self, trial: Trial) -> Array:
        """Predicted stiffnesses (n,) [N/m]."""
        stiffnesses = []
        for speed in self.speed.tolist():
            forces = self.about + np.array([-self.near, self.near])
            row, ends = row_at(trial, speed), (self.lowest, self.highest)
            falling, rising = trial.cycle(row, forces[::-1], forces, *ends)
            u = (falling if self.branch == BRANCHES[0] else rising)[:, 0]
            if u[1] == u[0]:
                raise NoSolution("the shaft does not move under an axial force")
            stiffnesses.append(2.0 * self.near / abs(u[1] - u[0]))
        return np.array(stiffnesses)
