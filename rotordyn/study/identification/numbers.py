"""Measured numbers that an analysis computes, such as stiffness, frequency or load over speed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from rotordyn.analyses.registry import analysis
from rotordyn.arrays import Array
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.quantity import suggestion
from rotordyn.study.identification.measurement import Data
from rotordyn.study.identification.trial import Trial
from rotordyn.study.optimum.criterion import Criterion, variables
from rotordyn.units import parse_unit, pretty_unit

RPM = np.pi / 30.0
ALIKE = 1e-8  # relative difference up to which speeds are equal


@dataclass(frozen=True, eq=False, kw_only=True)
class Numbers:
    """Measured ``values`` (n,) of numbers of an analysis over ``speed`` [rad/s], and their standard
    ``deviation``, in ``unit``.

    ``of``, ``where``: see ``Criterion``; the speed is selected by ``speed``. Headline numbers,
    "analysis: words", exist at the first and the last of the speeds of all measurements; those
    without a speed, such as a limit, are taken in the order of the analysis and may depend on all
    speeds. ``nearest``: of several numbers at a speed, the one nearest to the measured value is
    compared.
    """

    name: str
    of: str
    speed: Array
    values: Array
    deviation: float
    unit: str
    where: Mapping[str, object] = field(default_factory=dict)
    nearest: bool = False

    def __post_init__(self) -> None:
        for name in ("speed", "values"):
            object.__setattr__(self, name, np.atleast_1d(np.asarray(getattr(self, name), float)))
        if len(self.speed) != len(self.values):
            raise InvalidInput(
                f"measurement {self.name}: one value at each speed is needed, got "
                f"{len(self.values)} at {len(self.speed)} speeds"
            )
        if len(set(self.speed.tolist())) < len(self.speed) and not self.nearest:
            raise InvalidInput(f"measurement {self.name}: has a speed twice: nearest is needed")

    @property
    def _criterion(self) -> Criterion:
        return Criterion(self.of, self.where)

    @cached_property
    def data(self) -> Data:
        """All points."""
        scale, n = parse_unit(self.unit).scale, len(self.values)
        return Data(
            self.name,
            self.values * scale,
            np.full(n, self.deviation * scale),
            pretty_unit(self.unit),
            1.0 / scale,
            self.speed / RPM,
            "speed [rpm]",
            ("",) * n,
        )

    def faults(self, case: Case) -> Iterator[str]:
        """Yield faults: an analysis that the case lacks; no number or variable named."""
        name = self._criterion.analysis
        if name not in case.analyses:
            yield (
                f"measurement {self.name}: of {shown(self.of)}: begins with an analysis of the "
                f"case; allowed: {', '.join(case.analyses)}{suggestion(name, case.analyses)}"
            )
        elif not ({":", "."} & set(self.of)):
            yield (
                f"measurement {self.name}: of {shown(self.of)}: names an analysis alone: a number "
                "of it follows after a colon, a variable of its dataset after a point"
            )

    def speeds(self, case: Case) -> Iterator[float]:
        """Yield the distinct speeds of the points, ascending."""
        yield from sorted(set(self.speed.tolist()))

    def analyses(self, case: Case) -> Mapping[str, Any]:
        """The analysis of the numbers, with the spec of the case."""
        name = self._criterion.analysis
        return {name: analysis(name).lean(case.analyses[name])}

    def predicted(self, trial: Trial) -> Array:
        """Predicted numbers (n,) [SI].

        Raises
        ------
        InvalidInput : the analysis has another count of numbers, or another unit
        """
        observed = self.data.observed
        if ":" in self.of:
            return self._by_words(trial, observed)
        parts = [
            self._picked(self._read(trial, {"speed": speed})[0], observed[[k]])
            for k, speed in enumerate(self.speed.tolist())
        ]
        return np.concatenate(parts)

    def _by_words(self, trial: Trial, observed: Array) -> Array:
        """Predicted headline numbers, each at its measured speed."""
        values, speeds, names = self._read(trial, {})
        if not speeds:
            return self._picked(values, observed)
        if None in speeds:
            if len({*names}) < len(names) or {*speeds} != {None}:  # of several speeds
                self._require_ends(trial)
            return self._picked(values, observed)
        rpm = np.array(speeds, dtype=float)
        at = [np.isclose(rpm, asked, ALIKE, ALIKE) for asked in (self.speed / RPM).tolist()]
        for asked, here in zip(self.speed / RPM, at, strict=True):
            if not here.any():
                raise InvalidInput(
                    f"measurement {self.name}: {self.of} is given at "
                    f"{' and '.join(f'{each:.6g}' for each in sorted(set(rpm.tolist())))} rpm, the "
                    f"first and the last of all speeds measured, not at {asked:.6g} rpm: "
                    f"{self._variables(trial)}"
                )
        parts = [self._picked(values[here], observed[[k]]) for k, here in enumerate(at)]
        return np.concatenate(parts)

    def _require_ends(self, trial: Trial) -> None:
        """Go on only where the speeds are the first and the last of all that are solved."""
        ends = np.array(sorted({trial.speeds[0], trial.speeds[-1]}))
        if len(ends) != len(self.speed) or not np.allclose(self.speed, ends, ALIKE, ALIKE):
            listed = ", ".join(f"{each:.6g} rpm" for each in ends / RPM)
            raise InvalidInput(
                f"measurement {self.name}: {self.of} consists of several numbers, not one for each "
                f"speed: give as speeds the first and the last of all measured, {listed}, or "
                f"{self._variables(trial)}"
            )

    def _variables(self, trial: Trial) -> str:
        """What may be named instead: variables over speed."""
        name = self._criterion.analysis
        known = [key for key, dims in variables(trial.results[name]).items() if "speed" in dims]
        return f"name a variable of {name} after a point instead of words: {', '.join(known)}"

    def _read(
        self, trial: Trial, where: Mapping[str, object]
    ) -> tuple[Array, tuple[float | None, ...], tuple[str, ...]]:
        """Values [SI] of the machine, speeds [rpm] of headline numbers, and names."""
        criterion = Criterion(self.of, {**self.where, **where})
        reading = criterion.read(trial.case, trial.results)
        unit = parse_unit(reading.unit) if reading.unit not in ("", "-") else parse_unit("")
        if unit.dimension != parse_unit(self.unit).dimension:
            raise InvalidInput(
                f"measurement {self.name}: in {self.unit}, but {self.of} is in {reading.unit}"
            )
        return reading.values * unit.scale, reading.speeds, reading.names

    def _picked(self, values: Array, observed: Array) -> Array:
        """Select one computed value for each observed one."""
        if self.nearest and len(values):
            return values[np.abs(values[:, None] - observed).argmin(axis=0)]
        if len(values) != len(observed):
            count = f"{len(values)} value{'s' if len(values) != 1 else ''}"
            select = "name one of them" if ":" in self.of else "select with where"
            remedy = f": {select}, or give nearest: true" if len(values) > len(observed) else ""
            raise InvalidInput(
                f"measurement {self.name}: {self.of} has {count} for {len(observed)} measured"
                f"{remedy}"
            )
        return values
