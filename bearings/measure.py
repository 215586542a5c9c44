"""Fields of descriptions with the values they accept: quantity, range, unit and meaning.

``BallBearing``, its kinds and ``Material`` declare their fields with ``measured``; Python, files,
JSON Schema and key reference read them from there.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import MISSING, dataclass, field, fields
from typing import Any

from bearings.arguments import finite
from bearings.errors import shown

# Scale and text of the units in which drawings and tables give a value.
_UNITS = {
    "deg": (math.pi / 180.0, "°"),
    "um": (1e-6, " µm"),
    "mm": (1e-3, " mm"),
    "GPa": (1e9, " GPa"),
    "kg/m^3": (1.0, " kg/m³"),
    "1/K": (1.0, " 1/K"),
}
_SI = {"length": " m", "pressure": " Pa", "density": " kg/m³", "thermal expansion": " 1/K"}
# Units in which a number may be meant that is given where SI is expected: mm, µm; degrees; GPa,
# MPa; g/cm³, t/mm³; µm/(m·K).
WATER = 1000.0  # [kg/m³]
_CONFUSED = {
    "length": (1e-3, 1e-6),
    "angle": (math.pi / 180.0,),
    "pressure": (1e9, 1e6),
    "density": (1e3, 1e12, 0.45359237 / 0.0254**3),  # g/cm³, t/mm³, lb/in³
    "thermal expansion": (1e-6,),
}


@dataclass(frozen=True, slots=True)
class Measure:
    """Values a field accepts.

    Parameters
    ----------
    quantity : a kind of unit ("length", "angle", "pressure" …), "number", "count", or the word for
        an instance of ``kind`` ("material", "text")
    meaning : a phrase for documents and editors
    low, high : bounds [SI]; ``open_low``, ``open_high``: the bound itself is excluded
    unit : in which drawings and tables give it
    kind : class of a value that is not a number
    """

    quantity: str
    meaning: str
    low: float = -math.inf
    high: float = math.inf
    open_low: bool = False
    open_high: bool = False
    unit: str = ""
    kind: type | None = None

    def refusal(self, name: str, value: object) -> str:
        """Return why a field rejects a value; empty where it accepts it."""
        if self.kind is not None:
            accepted = isinstance(value, self.kind)
            what = "text" if self.kind is str else f"a bearings.{self.kind.__name__}"
            return "" if accepted else f"{name} must be {what}, got {shown(value)}"
        if not finite(value):
            return f"{name} must be a finite number, got {shown(value)}"
        number = float(value)
        if self.quantity == "count" and number != int(number):
            return f"{name} must be a whole number from {self.low:g} up, got {shown(value)}"
        if self._holds(number):
            return ""
        low, high = (
            ("above" if self.open_low else "from"),
            ("and below" if self.open_high else "up to"),
        )
        return (
            f"{name} must lie {low} {self._shown(self.low)} {high} {self._shown(self.high)}, got "
            f"{self._given(number)}{self._doubt(number)}"
        )

    def _holds(self, value: float) -> bool:
        above = value > self.low if self.open_low else value >= self.low
        return above and (value < self.high if self.open_high else value <= self.high)

    def _doubt(self, value: float) -> str:
        """Question whether another unit was meant, in which the number would lie in the range."""
        meant = (value * factor for factor in _CONFUSED.get(self.quantity, ()))
        likely = next(filter(self._usual, meant), None)
        if likely is not None:
            return f" (did you mean {self.drawn(likely)}?)"
        return ": is the unit right?" if self.unit else ""

    def _usual(self, value: float) -> bool:
        """Whether a value in another unit is likely; no solid body of a bearing floats."""
        return self._holds(value) and not (self.quantity == "density" and value < WATER)

    def _shown(self, value: float) -> str:
        return self.drawn(value) if self.quantity == "pressure" else self._given(value)

    def _given(self, value: float) -> str:
        if self.quantity == "angle":
            return f"{math.degrees(value):g}° (in rad)"
        return f"{value:g}{_SI.get(self.quantity, '')}"

    def drawn(self, value: float) -> str:
        """Format a value in the unit of drawings."""
        scale, unit = _UNITS[self.unit]
        return f"{value / scale:.4g}{unit}"


def measured(measure: Measure, default: Any = MISSING) -> Any:
    """Declare a dataclass field whose values ``measure`` bounds."""
    return field(default=default, metadata={"measure": measure})


def refusals(description: Any) -> Iterator[str]:
    """Yield why fields of a dataclass reject their values; a default of None is one."""
    for item in fields(description):
        value, measure = getattr(description, item.name), item.metadata.get("measure")
        absent = value is None and item.default is None
        if measure is not None and not absent and (why := measure.refusal(item.name, value)):
            yield why
