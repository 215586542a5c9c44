"""Comparison of variants: varied values, and the headline numbers of every analysis."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rotordyn.analyses.registry import in_order
from rotordyn.case.varied import varied
from rotordyn.job.pages.asked import MOST, numbers_table
from rotordyn.job.results import Part
from rotordyn.page.blocks import Block, Table, Text

MOST_VARIED = 12


def variant_blocks(parts: Mapping[str, Part]) -> Iterator[Block]:
    """Yield a table of the differences, and one for each analysis with headline numbers."""
    cases = [part.case for part in parts.values()]
    differ = varied(cases)[:MOST_VARIED]
    if differ:
        heads = ["variant", *(each.label for each in differ)]
        rows = [
            [case.title or case.name, *(_word(each.values[k]) for each in differ)]
            for k, case in enumerate(cases)
        ]
        yield Table("What differs", heads, rows)
    for name in in_order(*(part.results for part in parts.values())):
        table = numbers_table(list(parts.values()), name)
        if table is not None:
            yield table
    if len(parts) > MOST:
        yield Text([f"Charts show the first {MOST} of {len(parts)} variants."])


def _word(value: object) -> str:
    return "–" if value is None else f"{value:.6g}" if isinstance(value, float) else str(value)
