"""Headline numbers of the results of a case, and of variants beside each other."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from rotordyn.analyses.registry import analysis, in_order
from rotordyn.results.described import Described
from rotordyn.results.headline import Number, cells


def headline_numbers(case: Described, results: Mapping[str, Any]) -> Iterator[tuple[str, Number]]:
    """Every number of tables, led by the name of its analysis, in the order of the analyses."""
    for name in in_order(results):
        for number in analysis(name).numbers(results[name], case):
            if not number.inner:
                yield name, number


def headline_cells(
    name: str, variants: Iterable[tuple[Described, Mapping[str, Any]]]
) -> tuple[list[str], list[list[str]]]:
    """Heads of the numbers of an analysis, and a row for each variant (case and results) that has
    it: its title and its numbers in a few words."""
    rows = [
        (case.title or case.name, cells(analysis(name).numbers(results[name], case)))
        for case, results in variants
        if name in results
    ]
    heads = list(dict.fromkeys(head for _, row in rows for head in row))
    return heads, [[title, *(row.get(head, "–") for head in heads)] for title, row in rows]
