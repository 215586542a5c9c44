"""Values in which cases differ, by their dotted paths."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, is_dataclass
from itertools import chain
from typing import Any

from rotordyn.case.case import Case
from rotordyn.case.paths import children
from rotordyn.description import quantity_of
from rotordyn.field import metadata
from rotordyn.quantity import HIDDEN, Quantity
from rotordyn.units import KINDS, parse_unit

OF_CASES = ("spindle", "bearing", "conditions")
APART = (("name",), ("title",), ("references",))  # no result depends on these
Leaf = tuple[Any, Quantity | None]


@dataclass(frozen=True, slots=True)
class Varied:
    """A ``path`` as ``vary`` takes it, and the value of every case there: numbers in ``unit``, None
    if a case lacks the path."""

    path: str
    unit: str
    values: tuple[Any, ...]

    @property
    def label(self) -> str:
        """Path with unit, as a heading."""
        return f"{self.path} [{self.unit}]" if self.unit else self.path

    @property
    def numeric(self) -> bool:
        """Whether every case has a finite number at the path."""
        kinds = (int, float)
        numbers = [v for v in self.values if isinstance(v, kinds) and not isinstance(v, bool)]
        return len(numbers) == len(self.values) and all(map(math.isfinite, numbers))


def varied(cases: Sequence[Case]) -> tuple[Varied, ...]:
    """Differences between the machines and conditions of ``cases``, in the order of the fields;
    names and titles do not count."""
    leaves = [dict(_leaves(case)) for case in cases]
    paths = dict.fromkeys(chain.from_iterable(leaves))
    rows = ((path, [values.get(path, (None, None)) for values in leaves]) for path in paths)
    return tuple(
        _varied(path, row) for path, row in rows if any(leaf[0] != row[0][0] for leaf in row[1:])
    )


def unlike(case: Case, wanted: Case) -> dict[str, Leaf]:
    """Values and quantities of the case ``wanted`` by path, where ``case`` differs; names and
    titles do not count."""
    present = dict(_leaves(case))
    absent = (None, None)
    leaves = {**dict.fromkeys(present, absent), **dict(_leaves(wanted))}
    return {path: leaf for path, leaf in leaves.items() if present.get(path, absent)[0] != leaf[0]}


def _leaves(case: Case) -> Iterator[tuple[str, Leaf]]:
    for name in OF_CASES:
        yield from _within(name, getattr(case, name), None)


def _within(path: str, value: Any, annotation: Any) -> Iterator[tuple[str, Leaf]]:
    """Yield every leaf value below ``path`` with its quantity."""
    fields = is_dataclass(value)
    if not (fields or isinstance(value, Mapping | tuple)):
        yield path, (value, quantity_of(annotation))
    for way, inner, inside in children(value, annotation):
        if not (fields and (way in APART or HIDDEN in metadata(inside))):
            yield from _within(".".join((path, *way)), inner, inside)


def _varied(path: str, row: Sequence[Leaf]) -> Varied:
    values = [value for value, _ in row]
    quantity = next((q for value, q in row if q is not None and isinstance(value, float)), None)
    if quantity is None:
        return Varied(path, "", tuple(values))
    unit = usual_unit(quantity, [v for v in values if isinstance(v, float)])
    scale = parse_unit(unit).scale if unit else 1.0
    scaled = (float(f"{v / scale:.12g}") if isinstance(v, float) else v for v in values)
    return Varied(path, unit, tuple(scaled))


def usual_unit(quantity: Quantity, values: Sequence[float]) -> str:
    """Usual unit in which the largest value lies between 1 and 1000, if there is one; rpm for any
    speed."""
    units = KINDS[quantity.kind]
    if quantity.kind == "speed":
        return units[0]
    top = max((abs(v) for v in values if math.isfinite(v)), default=0.0)
    fits = (u for u in units if 1.0 <= top / (parse_unit(u).scale if u else 1.0) < 1000.0)
    return next(fits, units[0])
