"""Temperatures of a running spindle: shaft, housing, rings and balls."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from rotordyn.description import Description, Faults, Path, ascending
from rotordyn.machine.support import beside
from rotordyn.quantity import Name, Speed, Temperature, ThermalExpansion

if TYPE_CHECKING:
    from rotordyn.arrays import Array

MEASURED = 20.0  # °C, at which lengths are measured (ISO 1)
Values = Temperature | tuple[Temperature, ...]
HousingExpansion = Annotated[
    ThermalExpansion | None,
    "thermal expansion of the housing along the axis; by default that of the `housing_material` "
    "of the fits, where that is the same for all bearings, else that of steel",
]
OF_BEARING = ("inner_ring", "outer_ring", "balls")


class Rises(NamedTuple):
    """Temperature rises above the reference at every speed (speeds,) [K]."""

    shaft: Array
    housing: Array
    inner: Array
    outer: Array
    balls: Array


@dataclass(frozen=True, slots=True)
class BearingTemperatures(Description):
    """Temperatures of one bearing [°C]; each may be a list over speed."""

    inner_ring: Annotated[
        Values | None, "temperature of its inner ring; by default that of all inner rings"
    ] = None
    outer_ring: Annotated[
        Values | None, "temperature of its outer ring; by default that of all outer rings"
    ] = None
    balls: Annotated[Values | None, "temperature of its balls; by default that of all balls"] = None


@dataclass(frozen=True, slots=True)
class Temperatures(Description):
    """Temperatures [°C], each one value or a list over ``speeds``, linear in between.

    Rings take the temperature of their seats unless given, balls the mean of both rings.
    """

    shaft: Annotated[Values | None, "temperature of the shaft; by default the reference"] = None
    housing: Annotated[Values | None, "temperature of the housing; by default the reference"] = None
    inner_rings: Annotated[
        Values | None, "temperature of all inner rings; by default that of the shaft"
    ] = None
    outer_rings: Annotated[
        Values | None, "temperature of all outer rings; by default that of the housing"
    ] = None
    balls: Annotated[
        Values | None, "temperature of all balls; by default the mean of both rings"
    ] = None
    bearings: Annotated[
        Mapping[Name, BearingTemperatures], "bearing -> its temperatures, instead of these"
    ] = field(default_factory=dict)
    speeds: Annotated[tuple[Speed, ...], "speeds of the values in lists, ascending"] = ()
    reference: Annotated[
        Temperature, "temperature of assembly, for which fits and preloads are given"
    ] = MEASURED
    housing_expansion: HousingExpansion = None

    def _faults(self) -> Faults:
        yield from ascending("speeds", self.speeds)
        named = ("shaft", "housing", "inner_rings", "outer_rings", "balls")
        entries: list[tuple[Path, Any]] = [((key,), getattr(self, key)) for key in named]
        for name, bearing in self.bearings.items():
            entries += [(("bearings", name, key), getattr(bearing, key)) for key in OF_BEARING]
        if all(value is None for _, value in entries):
            yield (
                (),
                "no temperature is given: give shaft, housing, inner_rings, outer_rings, balls or "
                "bearings",
            )
        tables = [(path, value) for path, value in entries if isinstance(value, tuple)]
        for path, value in tables:
            if len(value) != len(self.speeds):
                yield (
                    path,
                    f"needs one value for each of speeds: given {len(value)} values for "
                    f"{len(self.speeds)} speeds",
                )
        if self.speeds and not tables:
            yield ("speeds",), "speeds without a table: no temperature has a list of values"

    def turning_warmer(self, difference: float) -> Temperatures:
        """Return temperatures with shaft, inner rings and balls warmer by ``difference`` [K]."""
        shaft = self.reference if self.shaft is None else self.shaft
        bearings = {
            name: replace(
                bearing,
                inner_ring=_warmer(bearing.inner_ring, difference),
                balls=_warmer(bearing.balls, difference),
            )
            for name, bearing in self.bearings.items()
        }
        return replace(
            self,
            shaft=_warmer(shaft, difference),
            inner_rings=_warmer(self.inner_rings, difference),
            balls=_warmer(self.balls, difference),
            bearings=bearings,
        )

    def unknown_at(self, speeds: tuple[float, ...]) -> float | None:
        """Return the first of ``speeds`` [rad/s] outside a table, if any."""
        return next(iter(beside(self.speeds, speeds)), None)

    def rises(self, name: str, speed: Array) -> Rises:
        """Return the rises of a bearing and its seats at every ``speed`` (speeds,) [rad/s]."""
        bearing = self.bearings.get(name, BearingTemperatures())
        shaft, housing = self._rise(speed, self.shaft), self._rise(speed, self.housing)
        inner = self._rise(speed, bearing.inner_ring, self.inner_rings, self.shaft)
        outer = self._rise(speed, bearing.outer_ring, self.outer_rings, self.housing)
        ball_values = bearing.balls, self.balls
        mean = 0.5 * (inner + outer)
        balls = mean if ball_values == (None, None) else self._rise(speed, *ball_values)
        return Rises(shaft, housing, inner, outer, balls)

    def _rise(self, speed: Array, *given: Values | None) -> Array:
        """Return the rise by the first value that is given; zero where none is."""
        import numpy as np

        values = next((value for value in given if value is not None), self.reference)
        if isinstance(values, tuple):
            return np.interp(speed, self.speeds, values) - self.reference
        return np.full(len(speed), values - self.reference)


def _warmer(values: Values | None, difference: float) -> Values | None:
    if isinstance(values, tuple):
        return tuple(value + difference for value in values)
    return None if values is None else values + difference
