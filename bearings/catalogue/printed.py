"""Printed catalogue values of an angular-contact bearing, and those that can be compared."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import NamedTuple

from bearings.arguments import check_fields
from bearings.bearing import (
    BALL_DIAMETER,
    BALLS,
    CONFORMITY,
    MATERIAL,
    PITCH_DIAMETER,
)
from bearings.errors import InvalidBearing
from bearings.kinds.angular_contact import CONTACT_ANGLE
from bearings.materials import SILICON_NITRIDE, STEEL, Material
from bearings.measure import Measure, measured, refusals

BORE = Measure("length", "of the inner ring", 1e-3, 5.0, unit="mm")
OUTSIDE = Measure("length", "of the outer ring", 2e-3, 5.0, unit="mm")
WIDTH = Measure("length", "of the rings", 5e-4, 1.0, unit="mm")
RATING = Measure("number", "load rating", 1.0, 1e8)
LISTS = {
    "preloads": "N",
    "rigidities": "N/m",
    "unloading": "N",
}


class Value(NamedTuple):
    """One printed value: its kind, its number [SI], the preload it belongs to [N] or NaN."""

    kind: str
    number: float
    preload: float = math.nan

    @property
    def words(self) -> str:
        """Name, preload and value as text for messages."""
        at = "" if math.isnan(self.preload) else f" at {self.preload:g} N"
        return f"{_NAMES[self.kind]}{at} {self.shown(self.number)}"

    def shown(self, number: float) -> str:
        """Format a number of this kind in the unit of catalogues."""
        if self.kind == "rigidity":
            return f"{number * 1e-6:.4g} N/µm"
        return f"{number:.4g} N"


_NAMES = {
    "rigidity": "rigidity",
    "unloading": "unloading force",
    "dynamic": "dynamic rating C",
    "static": "static rating C0",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Catalogue:
    """Values as printed, SI units; see ``bearings.estimate`` for what each means."""

    bore: float = measured(BORE)
    outside_diameter: float = measured(OUTSIDE)
    width: float | None = measured(WIDTH, None)
    contact_angle: float = measured(CONTACT_ANGLE)
    ball_material: Material = measured(MATERIAL, SILICON_NITRIDE)
    ring_material: Material = measured(MATERIAL, STEEL)
    preloads: tuple[float, ...] = ()
    rigidities: tuple[float | None, ...] = ()
    unloading: tuple[float | None, ...] = ()
    dynamic_rating: float | None = measured(RATING, None)
    static_rating: float | None = measured(RATING, None)
    ball_diameter: float | None = measured(BALL_DIAMETER, None)
    balls: int | None = measured(BALLS, None)
    pitch_diameter: float | None = measured(PITCH_DIAMETER, None)
    inner_conformity: float | None = measured(CONFORMITY, None)
    outer_conformity: float | None = measured(CONFORMITY, None)

    def __post_init__(self) -> None:
        check_fields(self)
        for fault in chain(refusals(self), self._list_faults(), self._size_faults()):
            raise InvalidBearing(fault)

    def _list_faults(self) -> Iterator[str]:
        for name, unit in LISTS.items():
            values: Sequence[float | None] = getattr(self, name)
            positive = all(v is None or (math.isfinite(v) and v > 0.0) for v in values)
            if not positive or (name == "preloads" and None in values):
                yield f"{name} must be positive numbers [{unit}], got {list(values)}"
            elif name != "preloads" and len(values) and len(values) != len(self.preloads):
                yield (
                    f"{name} must have one value for each of preloads: given {len(values)} for "
                    f"{len(self.preloads)}"
                )
        if any(v is not None and v < 1e5 for v in self.rigidities):
            low = min(v for v in self.rigidities if v is not None)
            yield f"rigidities must be in N/m, got {low:g}: is the unit right?"
        for force, preload in zip(self.unloading, self.preloads, strict=False):
            if force is not None and force <= 2.0 * preload:
                yield (
                    f"an unloading force of {force:g} N at a preload of {preload:g} N: that of a "
                    "pair back to back is about three times the preload"
                )

    def _size_faults(self) -> Iterator[str]:
        if self.outside_diameter <= 1.1 * self.bore:
            yield (
                f"outside_diameter {self.outside_diameter * 1e3:g} mm must be well above bore "
                f"{self.bore * 1e3:g} mm"
            )
        if self.contact_angle < math.radians(5.0):
            yield f"contact_angle must be at least 5°, got {math.degrees(self.contact_angle):g}°"
        pitch = self.pitch_diameter
        if pitch is not None and not self.bore < pitch < self.outside_diameter:
            yield f"pitch_diameter {pitch * 1e3:g} mm must lie between bore and outside_diameter"
        ball, section = self.ball_diameter, 0.5 * (self.outside_diameter - self.bore)
        if ball is not None and ball >= section:
            yield f"ball_diameter {ball * 1e3:g} mm does not fit a section of {section * 1e3:g} mm"

    @property
    def values(self) -> tuple[Value, ...]:
        """Printed values that can be compared with those of an internal geometry."""
        values = []
        for kind, column in (("rigidity", self.rigidities), ("unloading", self.unloading)):
            for number, preload in zip(column, self.preloads, strict=False):
                if number is not None:
                    values.append(Value(kind, float(number), float(preload)))
        if self.dynamic_rating is not None:
            values.append(Value("dynamic", float(self.dynamic_rating)))
        if self.static_rating is not None:
            values.append(Value("static", float(self.static_rating)))
        return tuple(values)
