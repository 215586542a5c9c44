"""Measured numbers that analyses of the case compute: stiffness, frequencies, loads over speed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.registry import analysis
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.quantity import suggestion
from rotordyn.study.identification.measurement import Data
from rotordyn.study.identification.trial import Trial
from rotordyn.study.optimum.criterion import Criterion
from rotordyn.units import parse_unit, pretty_unit

Array = NDArray[np.float64]
RPM = np.pi / 30.0


@dataclass(frozen=True, eq=False, kw_only=True)
class Numbers:
    """Numbers ``of`` an analysis over ``speed`` [rad/s].

    ``of``, ``where``: as of ``Criterion``, besides the speed; of a headline number, "analysis:
    words", as many values as the case has at these speeds. ``values`` (n,) and ``deviation`` in
    ``unit``. ``nearest``: of several numbers at a speed the nearest to the measured one counts.
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
        """Every point."""
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
        """An analysis that the case lacks; neither words nor a variable."""
        name = self._criterion.analysis
        if name not in case.analyses:
            yield (
                f"measurement {self.name}: of {shown(self.of)}: begins with an analysis of the "
                f"case; allowed: {', '.join(case.analyses)}{suggestion(name, case.analyses)}"
            )
        elif not ({":", "."} & set(self.of)):
            yield (
                f"measurement {self.name}: of {shown(self.of)}: name a number, '{self.of}: words', "
                f"or a variable, '{self.of}.variable'"
            )

    def speeds(self, case: Case) -> Iterator[float]:
        """Those of the points."""
        yield from sorted(set(self.speed.tolist()))

    def analyses(self, case: Case) -> Mapping[str, Any]:
        """The one whose numbers these are, as the case asks it."""
        name = self._criterion.analysis
        return {name: analysis(name).lean(case.analyses[name])}

    def predicted(self, trial: Trial) -> Array:
        """Numbers of the machine (n,) [SI].

        Raises
        ------
        InvalidInput : other numbers than were measured, or in another unit
        """
        if ":" in self.of:
            return self._at(trial, self.data.observed, {})
        parts = [
            self._at(trial, self.data.observed[[k]], {"speed": speed})
            for k, speed in enumerate(self.speed.tolist())
        ]
        return np.concatenate(parts)

    def _at(self, trial: Trial, observed: Array, where: Mapping[str, object]) -> Array:
        criterion = Criterion(self.of, {**self.where, **where})
        reading = criterion.read(trial.case, trial.results)
        unit = parse_unit(reading.unit) if reading.unit not in ("", "-") else parse_unit("")
        if unit.dimension != parse_unit(self.unit).dimension:
            raise InvalidInput(
                f"measurement {self.name}: in {self.unit}, but {self.of} is in {reading.unit}"
            )
        values = reading.values * unit.scale
        if self.nearest and len(values):
            return values[np.abs(values[:, None] - observed).argmin(axis=0)]
        if len(values) != len(observed):
            raise InvalidInput(
                f"measurement {self.name}: {self.of} has {len(values)} values for "
                f"{len(observed)} measured: select with where, or give nearest: true"
            )
        return values
