"""What a page is made of: tables, charts, moving shapes, sentences, in sections. Plain data.

A block whose ``section`` is empty stands in the section of its analysis. Tables of one title in one
section whose first column has the same head are joined by that column: so several analyses tell of
the bearings in one table.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from rotordyn.results.kinds import Array, Complex
from rotordyn.surface.body import Whole

BEARINGS, BEARING = "Bearings", "bearing"  # section and first column that analyses share


class Markup(str):
    """Text that is not escaped: a template, or what a script sets as text."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class Text:
    """Sentences, a paragraph each, or items of a list."""

    sentences: Sequence[str]
    listed: bool = False
    title: str = ""
    section: str = ""


@dataclass(frozen=True, slots=True)
class Printed:
    """Text of a terminal, shown when asked for."""

    title: str
    text: str
    section: str = ""


@dataclass(frozen=True, slots=True)
class Table:
    """Cells as printed; the first column heads its rows. ``folded``: shown when asked for."""

    title: str
    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    note: str = ""
    folded: bool = False
    section: str = ""

    def joined(self, other: Table) -> Table:
        """This table with the further columns of ``other``, rows by their first cells."""
        beside = {row[0]: row[1:] for row in other.rows}
        blank = [""] * (len(other.head) - 1)
        rows = [[*row, *beside.pop(row[0], blank)] for row in self.rows]
        rows += [[key, *[""] * (len(self.head) - 1), *cells] for key, cells in beside.items()]
        note = " ".join(dict.fromkeys(n for n in (self.note, other.note) if n))
        return replace(self, head=[*self.head, *other.head[1:]], rows=rows, note=note)


@dataclass(frozen=True, slots=True)
class Control:
    """One of ``options`` is chosen, by a slider or from a list; ``start``: at first."""

    label: str
    options: Sequence[str]
    slider: bool = False
    start: int = 0


@dataclass(frozen=True, slots=True)
class Chart:
    """A chart in the terms of plotly.js: ``traces``, ``layout``.

    Values may be numpy arrays. ``controls``: what the reader chooses; entries of a trace, or of the
    layout, under ``moving`` then have a leading axis for each control, or, written as ``{"by":
    (0,), "values": …}``, for some. ``wide``: across the page; ``tall`` and ``least`` width [px].
    ``words``: what is said below it, one for every combination of the controls.
    """

    title: str
    traces: Sequence[Mapping[str, Any]]
    layout: Mapping[str, Any] = field(default_factory=dict)
    controls: Sequence[Control] = ()
    words: Sequence[str] = ()
    note: str = ""
    wide: bool = False
    tall: int = 340
    least: int = 0
    section: str = ""


@dataclass(frozen=True, slots=True)
class Shapes:
    """Bodies whose cross-sections move: ``points`` (n, 3) [m], ``triangles`` (m, 3).

    ``place`` (n,): the cross-section of a point among ``station`` (sections,) [m]; ``motion``
    (first control, second control, sections, 6): complex displacements as drawn [m, rad], NaN where
    there is none. ``still_points`` and ``still_triangles``: what does not move.
    """

    title: str
    controls: Sequence[Control]
    points: Array
    triangles: Whole
    place: Whole
    station: Array
    motion: Complex
    still_points: Array
    still_triangles: Whole
    words: Sequence[str] = ()
    note: str = ""
    section: str = ""


Block = Text | Printed | Table | Chart | Shapes


@dataclass(frozen=True, slots=True)
class Section:
    """A part of a page under a heading."""

    title: str
    blocks: Sequence[Block]


def sections(named: Sequence[tuple[str, Block]]) -> list[Section]:
    """Blocks by the title of their section, tables joined where they are of the same things."""
    found: dict[str, list[Block]] = {}
    for title, block in named:
        held = found.setdefault(block.section or title, [])
        place = next((k for k, other in enumerate(held) if _alike(other, block)), None)
        if place is None:
            held.append(block)
        else:
            held[place] = held[place].joined(block)  # type: ignore[union-attr, arg-type]
    return [Section(title, blocks) for title, blocks in found.items()]


def _alike(one: Block, other: Block) -> bool:
    if not isinstance(one, Table) or not isinstance(other, Table):
        return False
    return one.title == other.title and one.head[0] == other.head[0] != ""
