"""Blocks of every analysis of a case."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from rotordyn.analyses.contract import Analysis
from rotordyn.analyses.headline import headline_cells
from rotordyn.analyses.registry import analysis, in_order
from rotordyn.job.results import Part
from rotordyn.job.values import shown_of
from rotordyn.page.blocks import Block, Table
from rotordyn.page.curves import curve_charts
from rotordyn.page.declared import declared_blocks
from rotordyn.results.described import Shown
from rotordyn.results.display import RPM
from rotordyn.results.text import from_to

MOST = 12  # variants whose curves a page shows


def analysis_blocks(parts: Sequence[Part]) -> Iterator[tuple[str, Block]]:
    """Yield section and block of every analysis, in the order of their places."""
    for name in in_order(*(part.results for part in parts)):
        record = analysis(name)
        title = record.title or name.replace("_", " ").capitalize()
        held = [part for part in parts if name in part.results][:MOST]
        shown = [shown_of(part.case, part.results[name]) for part in held]
        good = [each for each in shown if np.any(np.ravel(each.result.outcome) == "")]
        for block in _blocks(record, parts[0].case.analyses.get(name), good) if good else ():
            yield title, block


def _blocks(record: Analysis, spec: Any, variants: Sequence[Shown]) -> Iterator[Block]:
    if record.page is not None:
        yield from record.page(spec, variants)
        return
    charts = list(curve_charts(record.curves, spec, variants))
    yield from charts or declared_blocks(variants)


def numbers_table(parts: Sequence[Part], name: str) -> Table | None:
    """Table of headline numbers of an analysis, a row for each variant; None if it has none."""
    heads, rows = headline_cells(name, parts)
    if not heads:
        return None
    heading = analysis(name).heading
    title = f"{heading[:1].upper()}{heading[1:]}"
    if len(rows) > 1:
        return Table(title, ("variant", *heads), rows)
    result = next(part.results[name] for part in parts if name in part.results)
    speed = getattr(result, analysis(name).over)
    ends = from_to(speed * RPM.factor, 0)
    return Table(title, ("", f"{ends} rpm"), list(zip(heads, rows[0][1:], strict=True)))
