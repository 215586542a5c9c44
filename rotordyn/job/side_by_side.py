"""Variants in one table: what was varied, the headline numbers, their changes from the first."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from rotordyn.analyses.headline import headline_numbers
from rotordyn.case.case import Case
from rotordyn.case.varied import varied
from rotordyn.figures.overlays import Scale
from rotordyn.report.tables import Column, number_cells, write_table
from rotordyn.results.headline import Number, changes

MOST_VARIED = 12  # columns of what was varied
Parts = Mapping[str, tuple[Case, Mapping[str, Any]]]


def scale_of(cases: Sequence[Case]) -> Scale | None:
    """Scale of the one number that differs among ``cases``, of several that change in step the
    first; None where more differs."""
    numeric = [each for each in varied(cases) if each.numeric]
    if not numeric or len(numeric) < len(varied(cases)):
        return None
    first, *others = ([*map(each.values.index, each.values)] for each in numeric)
    return Scale(numeric[0].label, numeric[0].values) if all(o == first for o in others) else None


def write_comparison(folder: Path, parts: Parts) -> None:
    """``variants.csv``: a row for each variant; ``variants_change.csv``: relative changes [%]."""
    cases = [case for case, _ in parts.values()]
    found = [
        {f"{name}: {number.heading}": number for name, number in headline_numbers(*part)}
        for part in parts.values()
    ]
    numbers = [{name: each.value for name, each in row.items()} for row in found]
    head: list[Column] = [("variant", list(parts)), ("title", [case.title for case in cases])]
    for each in varied(cases)[:MOST_VARIED]:
        head.append((each.label, ["" if value is None else value for value in each.values]))
    columns = [*_columns(numbers, lambda name: name), *_absent(found)]
    write_table(folder / "variants.csv", [*head, *columns])
    relative = [changes(values, numbers[0]) for values in numbers]
    write_table(folder / "variants_change.csv", [*head, *_columns(relative, _relative)])


def _absent(rows: Sequence[Mapping[str, Number]]) -> list[Column]:
    """Why cells are empty, or at which speeds there are such numbers; no column where none is."""
    said = [
        " | ".join(f"{k}: {each.absent}" for k, each in row.items() if math.isnan(each.value))
        for row in rows
    ]
    return [("absent", said)] if any(said) else []


def _columns(rows: Sequence[Mapping[str, float]], heading: Callable[[str], str]) -> list[Column]:
    names = dict.fromkeys(name for row in rows for name in row)
    return [(heading(n), number_cells(row.get(n, math.nan) for row in rows)) for n in names]


def _relative(heading: str) -> str:
    """Heading of the change of a number."""
    return f"{heading.partition(' [')[0]}, change [%]"
