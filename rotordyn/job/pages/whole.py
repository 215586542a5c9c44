"""The page of a case, from the verdict to the provenance of numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

import rotordyn
from rotordyn.job.pages.asked import analysis_blocks, numbers_table
from rotordyn.job.pages.inputs import input_blocks
from rotordyn.job.pages.intervals import interval_blocks
from rotordyn.job.pages.machine import bearings_table, machine_blocks, single_table
from rotordyn.job.pages.origin import known_table, origin_blocks
from rotordyn.job.pages.variants import variant_blocks
from rotordyn.job.results import Origin, Part, Results
from rotordyn.job.values import machine_of
from rotordyn.page.blocks import BEARINGS, Block, Printed, Table, Text, sections
from rotordyn.page.html import Page, write


def write_page(path: Path, results: Results) -> None:
    """Write the page of ``results`` to ``path``.

    Raises
    ------
    ModuleNotFoundError : plotly is not installed
    InvalidInput : the file cannot be written; the case of an opened folder cannot be read
    """
    write(path, page_of(results))


def page_of(results: Results) -> Page:
    """Build the page of ``results``."""
    case, origin = results.case, results.origin
    named = [*_verdict(results), *_blocks(results, origin)]
    machines = dict.fromkeys(machine_of(part.case) for part in results.parts.values())
    return Page(
        title=case.title or case.name,
        about=[", ".join(filter(None, machines)), f"Case {case.name}; {origin.date}".rstrip("; ")],
        verdict=verdict(results),
        grave=bool(results.unsolved),
        sections=sections(named),
        footer=f"rotordyn {origin.versions.get('rotordyn', rotordyn.__version__)}. {origin.date}",
    )


def verdict(results: Results) -> str:
    """Short text: whether all was solved, and the number of warnings."""
    count, lost = len(results.warnings), len(results.unsolved)
    warned = f"{count or 'No'} warning{'' if count == 1 else 's'}"
    if lost:
        reasons = f"{lost} reason{'' if lost == 1 else 's'}"
        return f"✕ Not everything is solved ({reasons} below). {warned}."
    return f"{'⚠' if count else '✓'} Everything is solved. {warned}."


def _verdict(results: Results) -> Iterator[tuple[str, Block]]:
    title = "Verdict"
    said = {"Not solved": results.unsolved, "Warnings": results.warnings, "Notes": results.notes}
    for heading, sentences in said.items():
        if sentences:
            yield title, Text(sentences, listed=True, title=heading)
    for name, part in results.parts.items():
        for each in part.results if not name else ():
            table = numbers_table([part], each)
            if table is not None:
                yield title, table
    yield title, Printed("Summary", results.summary)


def _blocks(results: Results, origin: Origin) -> Iterator[tuple[str, Block]]:
    parts = results.parts
    cases = [part.case for part in parts.values()]
    if "" not in parts:
        yield from (("Variants", block) for block in variant_blocks(parts))
    yield from (("Machine", block) for block in machine_blocks(cases))
    yield from (("Inputs", block) for block in input_blocks(cases))
    yield from ((BEARINGS, table) for table in _bearings(parts))
    yield from analysis_blocks(list(parts.values()))
    yield from (("Uncertainty", block) for block in interval_blocks(parts, results.held_intervals))
    if (table := known_table(parts)) is not None:
        yield table.title, table
    yield from (("Accuracy and origin", block) for block in origin_blocks(parts, origin))


def _bearings(parts: Mapping[str, Part]) -> Iterator[Table]:
    """Tables of the bearings of every part."""
    for part in parts.values():
        case, title = part.case, BEARINGS if "" in parts else f"{part.case.title}: bearings"
        if case.spindle is not None and case.spindle.seats:
            yield bearings_table(case.spindle, title)
        if case.bearing is not None:
            yield single_table(case.bearing, case.speeds[-1], title)
