"""Table of the variants: varied values, headline numbers, their changes from the first."""

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

MOST_VARIED = 12  # columns of varied values
Parts = Mapping[str, tuple[Case, Mapping[str, Any]]]


def scale_of(cases: Sequence[Case]) -> Scale | None:
    """Scale of the only number that differs among ``cases``, or of the first of several that change
    together; None if more differs."""
    numeric = [each for each in varied(cases) if each.numeric]
    if not numeric or len(numeric) < len(varied(cases)):
        return None
    first, *others = ([*map(each.values.index, each.values)] for each in numeric)
    return Scale(numeric[0].label, numeric[0].values) if all(o == first for o in others) else None


def write_comparison(folder: Path, parts: Parts) -> None:
    """Write ``variants.csv``, a row for each variant, and ``variants_change.csv`` with relative
    changes [%]."""
    cases = [case for case, _ in parts.values()]
    by_variant = [
        {f"{name}: {number.heading}": number for name, number in headline_numbers(*part)}
        for part in parts.values()
    ]
    numbers = [{name: each.value for name, each in row.items()} for row in by_variant]
    head: list[Column] = [("variant", list(parts)), ("title", [case.title for case in cases])]
    for each in varied(cases)[:MOST_VARIED]:
        head.append((each.label, ["" if value is None else value for value in each.values]))
    columns = [*_columns(numbers, lambda name: name), *_absent(by_variant)]
    write_table(folder / "variants.csv", [*head, *columns])
    relative = [changes(values, numbers[0]) for values in numbers]
    write_table(folder / "variants_change.csv", [*head, *_columns(relative, _relative)])


def _absent(rows: Sequence[Mapping[str, Number]]) -> list[Column]:
    """Column with reasons for empty cells; none if no cell is empty."""
    reasons = [
        " | ".join(f"{k}: {each.absent}" for k, each in row.items() if math.isnan(each.value))
        for row in rows
    ]
    return [("absent", reasons)] if any(reasons) else []


def _columns(rows: Sequence[Mapping[str, float]], heading: Callable[[str], str]) -> list[Column]:
    names = dict.fromkeys(name for row in rows for name in row)
    return [(heading(n), number_cells(row.get(n, math.nan) for row in rows)) for n in names]


def _relative(heading: str) -> str:
    """Heading of the relative change of a number."""
    return f"{heading.partition(' [')[0]}, change [%]"
