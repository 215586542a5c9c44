"""Unknowns of an identification: bounds, priors and start values of numbers of a case."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from rotordyn.case.case import Case
from rotordyn.case.paths import found_at, from_top
from rotordyn.case.varied import usual_unit
from rotordyn.case.vary import vary
from rotordyn.description import quantity_of
from rotordyn.errors import InvalidInput
from rotordyn.field import Refused, accept, shown
from rotordyn.quantity import Quantity
from rotordyn.units import DIFFERENCE, parse, parse_unit, pretty_unit, unit_of

FLAT = math.sqrt(12.0)  # range of a uniform distribution over its standard deviation


@dataclass(frozen=True, slots=True)
class Unknown:
    """An unknown number between ``low`` and ``high``, in SI units or text with a unit.

    ``prior`` with its standard ``deviation``: prior knowledge; ``start``: start value of the
    search, by default the prior, or the value of the case. ``also``: further paths that take the
    same value. ``name``: short name for figures and tables; by default from the path.
    """

    low: float | str
    high: float | str
    prior: float | str | None = None
    deviation: float | str | None = None
    start: float | str | None = None
    also: tuple[str, ...] = ()
    name: str = ""


@dataclass(frozen=True, slots=True)
class Sought:
    """An unknown that was checked against its case, in SI units; ``written``: unit in which its
    bounds were given, if any."""

    path: str
    name: str
    low: float
    high: float
    start: float
    prior: float | None
    deviation: float | None
    also: tuple[str, ...]
    quantity: Quantity | None
    written: str = field(default="", repr=False, compare=False)

    @property
    def scale(self) -> float:
        """Standard deviation of the prior, or of a uniform distribution between the bounds."""
        flat = (self.high - self.low) / FLAT
        return flat if self.deviation is None else min(self.deviation, flat)

    @property
    def limited(self) -> bool:
        """Whether the lower bound is 0 and the quantity itself cannot be negative."""
        return self.low == 0.0 and self.quantity is not None and self.quantity.low == 0.0

    @property
    def unit(self) -> str:
        """Unit for printing: that in which it was given, or a usual one."""
        if self.quantity is None or self.written:
            return self.written
        return usual_unit(self.quantity, [self.start or self.high])

    @property
    def coherent_unit(self) -> str:
        """SI unit, as files write it."""
        return "" if self.quantity is None else self.quantity.coherent_unit

    def shown(self, value: float) -> float:
        """Convert a value to the unit for printing."""
        return value / (parse_unit(self.unit).scale if self.unit else 1.0)

    @property
    def heading(self) -> str:
        """Name with unit, as printed."""
        return f"{self.name} [{pretty_unit(self.unit)}]" if self.unit else self.name

    def changes(self, value: float) -> dict[str, Any]:
        """The value by each of its paths, as ``vary`` takes them."""
        return dict.fromkeys((self.path, *self.also), value)


def sought(case: Case, asked: Mapping[str, Unknown]) -> tuple[Sought, ...]:
    """Check unknowns against the case.

    Raises
    ------
    InvalidInput : a path that does not exist or holds no number, invalid bounds or prior
    """
    if not asked:
        raise InvalidInput("unknowns: none is given: map at least one dotted path to its ends")
    found = [_sought(case, path, each) for path, each in asked.items()]
    names = [each.name for each in found]
    for each in found:
        if names.count(each.name) > 1:
            raise InvalidInput(f"{each.path}: two unknowns are called {each.name}: name them")
    paths = [path for each in found for path in (each.path, *each.also)]
    for path in paths:
        if paths.count(path) > 1:
            raise InvalidInput(f"{path}: is an unknown twice")
    return tuple(found)


def _sought(case: Case, path: str, asked: Unknown) -> Sought:
    if not isinstance(asked, Unknown):
        raise InvalidInput(f"{path}: an Unknown with two ends is needed, got {shown(asked)}")
    low, high = (_number(case, path, end) for end in (asked.low, asked.high))
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        raise InvalidInput(
            f"{path}: an unknown lies between a lower and a higher end, got "
            f"{_written(case, path, low)} to {_written(case, path, high)}"
        )
    _require_fractions(case, path, low, high)
    for other in asked.also:
        _require_alike(case, path, other)
        _number(case, other, asked.low)
    if (asked.prior is None) != (asked.deviation is None):
        raise InvalidInput(f"{path}: a prior has a value and a deviation: give both or none")
    prior = None if asked.prior is None else _number(case, path, asked.prior)
    deviation = None if asked.deviation is None else _amount(case, path, asked.deviation)
    if deviation is not None and not deviation > 0.0:
        raise InvalidInput(f"{path}: the deviation of a prior is above 0, got {asked.deviation}")
    for word, value in (("prior", prior), ("start", asked.start)):
        if value is not None and not low <= (number := _number(case, path, value)) <= high:
            raise InvalidInput(
                f"{path}: the {word} {_written(case, path, number)} lies outside "
                f"{_written(case, path, low)} to {_written(case, path, high)}"
            )
    held = found_at(case, path)[0][0]
    begin = next((v for v in (asked.start, asked.prior) if v is not None), None)
    start = float(held) if begin is None else _number(case, path, begin)
    if not low <= start <= high:
        start = min(max(start, low), high) if math.isfinite(start) else 0.5 * (low + high)
    quantity = quantity_of(found_at(case, path)[0][1])
    name = asked.name or _short(path)
    unit = unit_of(asked.high) or unit_of(asked.low)
    also = tuple(asked.also)
    return Sought(path, name, low, high, start, prior, deviation, also, quantity, unit)


def _require_fractions(case: Case, path: str, low: float, high: float) -> None:
    """Raise InvalidInput if the field takes only whole numbers."""
    try:
        accept(found_at(case, path)[0][1], low + (high - low) / math.pi)
    except Refused:
        raise InvalidInput(
            f"{path}: holds whole numbers, between which there are no values: give them as "
            "hypotheses"
        ) from None


def _require_alike(case: Case, path: str, other: str) -> None:
    """Raise InvalidInput if two paths hold different kinds of quantity."""
    kinds = [{getattr(quantity_of(a), "kind", "number") for _, a in found_at(case, one)}
             for one in (path, other)]  # fmt: skip
    if kinds[1] and kinds[0] != kinds[1]:
        raise InvalidInput(
            f"{path}: also: {other} holds a {min(kinds[1])}, no {min(kinds[0])}, and cannot take "
            "the same value"
        )


def _written(case: Case, path: str, value: float) -> str:
    """Text of a value of a path in a usual unit."""
    quantity = quantity_of(found_at(case, path)[0][1])
    unit = "" if quantity is None else usual_unit(quantity, [value])
    return f"{value / (parse_unit(unit).scale if unit else 1.0):g} {unit}".rstrip()


def _short(path: str) -> str:
    """Short name from a path: steps common to most paths are dropped."""
    _, *within = from_top(path, spindle=True).split(".")
    steps = [step for step in within if step not in ("sleeves", "bearings", "model", "*")]
    return " ".join(steps).replace("_", " ") or path


def _number(case: Case, path: str, value: object) -> float:
    places = found_at(case, path)
    if not places:
        vary(case, {path: value})  # raises with the part of the path that does not exist
        raise InvalidInput(f"{path}: does not exist")
    try:
        accepted = accept(places[0][1], value)
    except Refused as refusal:
        raise InvalidInput(f"{path}{refusal.place}: {refusal.why}") from None
    if isinstance(accepted, bool) or not isinstance(accepted, float | int):
        raise InvalidInput(
            f"{path}: holds no number, so that it cannot be identified: {shown(accepted)}"
        )
    return float(accepted)


def _amount(case: Case, path: str, value: float | str) -> float:
    """Convert a deviation, a difference of the quantity of the path; its range does not apply."""
    if not isinstance(value, str):
        return float(value)
    quantity = quantity_of(found_at(case, path)[0][1])
    if quantity is None:
        return float(value)
    return parse(value, DIFFERENCE.get(quantity.kind, quantity.kind))
