"""The reference of all keys, written from the descriptions that files are read as."""

from __future__ import annotations

import re
from collections.abc import Iterator

from bearings.bearing import BallBearing
from bearings.kinds import KINDS, kind_class
from bearings.materials import Material
from docs.generate.accepted import accepted, default
from docs.generate.marked import table
from rotordyn.analyses.measured_response import Port
from rotordyn.analyses.registry import analysis, built_in, place
from rotordyn.case.case import Case
from rotordyn.case.identification import KINDS as MEASURED
from rotordyn.case.identification import IdentificationFile
from rotordyn.case.keys import Range, extra, keys_of
from rotordyn.case.schema import about, title
from rotordyn.case.study import OptimumFile, StudyFile
from rotordyn.field import Field, descriptions
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.tool import Tool

HEAD = ("key", "takes", "default", "meaning")
# Part of the page -> the description of its file.
PAGES: dict[str, type] = {
    "case": Case,
    "spindle": Spindle,
    "tool": Tool,
    "bearing": BallBearing,
    "material": Material,
    "reference": Reference,
    "study": StudyFile,
    "optimum": OptimumFile,
    "identification": IdentificationFile,
}


def key_tables() -> dict[str, str]:
    """Every part of the page, by name."""
    tables = {name: "\n\n".join(map(_section, kinds)) for name, kinds in pages().items()}
    return {name: _from_reference(text) for name, text in tables.items()}


def _from_reference(text: str) -> str:
    """Links of meanings start at ``docs``; the page is in ``docs/reference``."""
    return re.sub(r"\]\((?=[\w/]+\.md)", "](../", text)


def pages() -> dict[str, list[type]]:
    """The descriptions of every part of the page, each once, in order of reading."""
    seen = {*PAGES.values(), Port, Spindle, BallBearing}
    found: dict[str, list[type]] = {}
    for name, kind in PAGES.items():
        listed = [kind]
        for each in listed:
            for held in _held(each):
                if held not in seen:
                    seen.add(held)
                    listed.append(held)
        found[name] = listed
    return found


def _held(kind: type) -> Iterator[type]:
    """Descriptions of the mappings within a mapping."""
    if kind is BallBearing:
        yield from map(kind_class, KINDS)
        return
    if kind is IdentificationFile:
        yield from MEASURED.values()
    if kind is Case:
        yield Range
        yield from (analysis(name).spec for name in sorted(built_in(), key=place))
    for field in keys_of(kind):
        for held in descriptions(field.annotation) if field.keys else ():
            if not issubclass(held, BallBearing) and held.__module__ != "rotordyn.case.case":
                yield held


def _section(kind: type) -> str:
    fields = extra(BallBearing) if kind is BallBearing else keys_of(kind)
    if issubclass(kind, BallBearing) and kind is not BallBearing:
        fields = fields[len(extra(BallBearing)) :]
    rows = [_row(field) for field in fields if field.keys]
    name = "bearing" if kind is BallBearing else title(kind)
    words = about(kind, plainly=False)
    if kind is BallBearing:
        words = "A ball bearing; its kind adds further keys."
    head = f"### {name}\n\n{words}"
    return f"{head}\n\n{table(HEAD, rows)}" if rows else head


def _row(field: Field) -> tuple[str, str, str, str]:
    material = {Material} & {*descriptions(field.annotation)}
    written = "; name, path or mapping" if material and "path" not in field.meaning else ""
    return (
        f"`{'.'.join(field.keys)}`",
        accepted(field.annotation),
        default(field),
        f"{field.meaning}{written}",
    )
