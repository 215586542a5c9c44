"""Provenance of numbers: accuracy, versions, date, digest of the input."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rotordyn.analyses.known import matches
from rotordyn.analyses.registry import analysis
from rotordyn.job.results import Origin, Part
from rotordyn.page.blocks import Block, Table, Text
from rotordyn.report.known import computed_values, known_values


def known_table(parts: Mapping[str, Part]) -> Table | None:
    """Table of published and measured values beside computed ones; None if there are none."""
    rows = []
    for part in parts.values():
        for match in matches(part.case.known, part.results, part.case.spindle):
            reference = match.reference
            named = (part.case.title,) if len(parts) > 1 else ()
            what, _, values = known_values(reference).partition(": ")
            beside = (reference.kind, values, computed_values(match))
            rows.append((what, *named, *beside, reference.remark, reference.source))
    heads = ["quantity", *(["variant"] if len(parts) > 1 else [])]
    heads += ["kind", "known", "computed", "why they may differ", "source"]
    return Table("Published and measured values", heads, rows) if rows else None


def origin_blocks(parts: Mapping[str, Part], origin: Origin) -> Iterator[Block]:
    """Yield tables of accuracy by analysis, versions and files."""
    said = {
        f"{title}{phrase}": None
        for name, part in parts.items()
        for title in [f"{part.case.title or name}: " if len(parts) > 1 else ""]
        for of, result in part.results.items()
        for phrase in analysis(of).accuracy(result)
    }
    if said:
        yield Text(list(said), listed=True, title="Estimated errors, by refinement")
    rows = [(name, version) for name, version in origin.versions.items()]
    rows += [("date", origin.date)] if origin.date else []
    rows += [("files read", ", ".join(origin.inputs))] if origin.inputs else []
    rows += [("SHA-256 of what was read", origin.digest)] if origin.digest else []
    yield Table("Made with", ("", ""), rows)
