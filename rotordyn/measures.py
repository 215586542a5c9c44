"""Limits of the fields of bearings and materials (``bearings.measure.Measure``), with units."""

from __future__ import annotations

import math
from dataclasses import fields
from typing import Annotated, Any

from bearings.measure import Measure
from rotordyn.quantity import HIDDEN, Quantity, Whole
from rotordyn.units import parse_unit


def limits(measure: Measure) -> Quantity | Whole:
    """Range of a numeric measure, its bounds in the units of drawings."""
    if measure.quantity == "count":
        return Whole(int(measure.low), int(measure.high))
    low, high = (_written(bound, measure.unit) for bound in (measure.low, measure.high))
    bounds = {"above" if measure.open_low else "at_least": low}
    bounds["below" if measure.open_high else "at_most"] = high
    return Quantity(measure.quantity, **bounds)


def measured_fields(kind: Any) -> dict[str, Any]:
    """Annotations with limits of the fields of a dataclass that declare a measure. If some do, the
    other fields are hidden: a bearing gets its rings from its seat."""
    declared = {f.name: (f.metadata.get("measure"), f.default is None) for f in fields(kind)}
    some = any(measure is not None for measure, _ in declared.values())
    hidden = {
        name: Annotated[Any, HIDDEN] for name, (measure, _) in declared.items() if not measure
    }
    return (hidden if some else {}) | {
        name: _annotation(measure, optional=optional)
        for name, (measure, optional) in declared.items()
        if measure is not None and measure.kind is None
    }


def meaning_of(field: Any) -> str:
    """Meaning that a field declares by its measure; empty if none."""
    measure = field.metadata.get("measure")
    return "" if measure is None else measure.meaning


def _annotation(measure: Measure, *, optional: bool) -> Any:
    within = limits(measure)
    plain: Any = int if isinstance(within, Whole) else float
    annotation: Any = Annotated[plain, within]
    return annotation | None if optional else annotation


def _written(bound: float, unit: str) -> str:
    if math.isinf(bound):
        return ""
    return f"{bound / parse_unit(unit).scale:.12g} {unit}".strip()
