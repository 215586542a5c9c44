"""Input of a case: all values of descriptions that differ from their defaults, with units."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import is_dataclass
from typing import Annotated, Any

from bearings.bearing import BallBearing
from rotordyn.analyses.measured_response import Port
from rotordyn.case.case import Case
from rotordyn.case.varied import usual_unit
from rotordyn.description import quantity_of
from rotordyn.field import declared, found_in
from rotordyn.machine.matrix import Matrix, entry_name
from rotordyn.page.blocks import Block, Printed, Table, Text
from rotordyn.results.display import RPM
from rotordyn.units import parse_unit

KEPT_BY_FILES = ("own", "sizes", "by_set", "preloads", "override")  # of bearings and sections
APART = ("name", "title", "references", "note", "stated", *KEPT_BY_FILES)
LONGEST = 110  # of a value in a table
Row = tuple[str, str, str]


def input_blocks(cases: Sequence[Case]) -> Iterator[Block]:
    """Yield folded tables of speeds, conditions, analyses, machine and sources, of the first
    variant if there are variants."""
    case = cases[0]
    ends = " to ".join(dict.fromkeys(f"{case.speeds[k] * RPM.factor:.6g}" for k in (0, -1)))
    asked = ", ".join(name.replace("_", " ") for name in case.analyses)
    says = "What follows differs from the defaults; numbers without a unit are in SI units."
    if len(cases) > 1:
        says += f" Machine and conditions are those of {case.title or case.name}."
    count = f"{len(case.speeds)} speed{'s' * (len(case.speeds) > 1)}"
    yield Text([f"{count}, {ends} rpm; analyses: {asked}. {says}"])
    yield from _tables("Conditions", case.conditions)
    for name, spec in case.analyses.items():
        yield from _tables(f"Analysis {name.replace('_', ' ')}", spec)
    machine = case.spindle if case.spindle is not None else case.bearing
    note = getattr(machine, "note", "")
    if note.strip():
        yield Printed("Note of the machine", note.strip())
    yield from _tables("Spindle" if case.spindle is not None else "Bearing", machine)
    rows = [[file, of[0], " ".join(of[1:])] for file, of in case.sources.items()]
    if rows:
        yield Table("Sources", ("file", "what it is", "where its values come from"), rows)


def _tables(title: str, value: Any) -> Iterator[Table]:
    """Yield a table of the plain values of a description, and one for each list of descriptions."""
    rows: list[Row] = []
    lists: list[Table] = []
    for field, held in _given(value):
        words = _called(field)
        if _listed(held):
            lists.append(_list(f"{title}: {words}", held))
        elif is_dataclass(held) and (
            len(_written(held, None)) > LONGEST or any(_listed(each) for _, each in _given(held))
        ):
            lists += _tables(f"{title}: {words}", held)
        else:
            meaning = field.meaning.partition(" ([")[0]
            rows.append((words, _written(held, field.annotation), meaning))
    if rows:
        yield Table(title, ("key", "value", "meaning"), rows, folded=True)
    yield from lists


def _called(field: Any) -> str:
    """Key of a field in files."""
    return " ".join(field.keys or [field.name]).replace("_", " ")


def _listed(held: Any) -> bool:
    """Whether a value is a list of descriptions, which becomes a table."""
    return isinstance(held, tuple) and bool(held) and all(map(is_dataclass, held))


def _given(value: Any) -> Iterator[tuple[Any, Any]]:
    kind: Any = type(value)
    for field in declared(kind):
        held = getattr(value, field.name) if field.name else field.default
        shown = field.name not in APART and not isinstance(held, BallBearing)  # in their own table
        if field.name and shown and held != field.default:
            yield field, held


def _list(title: str, items: Sequence[Any]) -> Table:
    """Table with a row for each item, and a column for each value that any of them has."""
    rows = [
        {_called(f): _written(held, f.annotation) for f, held in _given(item)} for item in items
    ]
    heads = list(dict.fromkeys(name for row in rows for name in row))
    named = [getattr(item, "name", "") or str(k) for k, item in enumerate(items, start=1)]
    cells = [
        [name, *(row.get(h, "") for h in heads)] for name, row in zip(named, rows, strict=True)
    ]
    return Table(title, ["", *heads], cells, folded=True)


def _written(value: Any, annotation: Any) -> str:
    """Text of a value as in a file."""
    if isinstance(value, float):
        return _number(value, annotation)
    if isinstance(value, bool) or value is None:
        return {True: "yes", False: "no", None: "none"}[value]
    if isinstance(value, Mapping | tuple | list):
        return _several(value, annotation)
    if is_dataclass(value) and not isinstance(value, Port):
        name = getattr(value, "name", "")
        inner = ", ".join(f"{_called(f)} {_written(v, f.annotation)}" for f, v in _given(value))
        return str(name) if name and len(inner) > LONGEST else f"{name} {inner}".strip()
    return str(value)


def _several(value: Any, annotation: Any) -> str:
    """Text of the values of a mapping or a list; entries of matrices with units."""
    if isinstance(value, Mapping) and (matrix := found_in(annotation, Matrix)):
        every = {pair: Annotated[float, matrix.quantity(*pair)] for pair in value}
        return "; ".join(f"{entry_name(*k)}: {_written(v, every[k])}" for k, v in value.items())
    if isinstance(value, Mapping):
        return "; ".join(f"{k}: {_written(v, annotation)}" for k, v in value.items())
    inner = " / " if any(isinstance(each, Port) for each in value) else ", "
    words = [_written(each, annotation) for each in value[:8]]
    return inner.join(words) + (f", … ({len(value)} in all)" if len(value) > len(words) else "")


def _number(value: float, annotation: Any) -> str:
    quantity = quantity_of(annotation)
    if not math.isfinite(value):
        return (quantity and quantity.infinite) or "infinite"
    if quantity is None:
        return f"{value:.6g}"
    unit = usual_unit(quantity, [value])
    scale = parse_unit(unit).scale if unit else 1.0
    return f"{value / scale:.6g} {unit}".rstrip()
