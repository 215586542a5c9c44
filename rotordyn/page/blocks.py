"""Parts of a page as plain data: tables, charts, animated shapes, sentences, in sections.

A block with an empty ``section`` belongs to the section of its analysis. Tables of a section with
the same title and the same heading of the first column are joined by that column, so that several
analyses share one table of the bearings.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from rotordyn.arrays import Array, Complex
from rotordyn.surface.body import Whole

BEARINGS, BEARING = "Bearings", "bearing"  # section and first column that analyses share


class Markup(str):
    """Text that is not escaped: a template, or text set by the script."""

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
    """Preformatted text, folded at first."""

    title: str
    text: str
    section: str = ""


@dataclass(frozen=True, slots=True)
class Table:
    """Cells as text; the first column labels the rows. ``folded``: hidden at first."""

    title: str
    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    note: str = ""
    folded: bool = False
    section: str = ""

    def joined(self, other: Table) -> Table:
        """Join the columns of ``other``, matching rows by their first cells."""
        beside = {row[0]: row[1:] for row in other.rows}
        blank = [""] * (len(other.head) - 1)
        rows = [[*row, *beside.pop(row[0], blank)] for row in self.rows]
        rows += [[key, *[""] * (len(self.head) - 1), *cells] for key, cells in beside.items()]
        note = " ".join(dict.fromkeys(n for n in (self.note, other.note) if n))
        return replace(self, head=[*self.head, *other.head[1:]], rows=rows, note=note)


@dataclass(frozen=True, slots=True)
class Control:
    """Selection of one of ``options``, by a slider or from a list; ``start``: initial index."""

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
    """Group blocks by section; tables of the same title and first column are joined."""
    by_title: dict[str, list[Block]] = {}
    for title, block in named:
        listed = by_title.setdefault(block.section or title, [])
        place = next((k for k, other in enumerate(listed) if _alike(other, block)), None)
        if place is None:
            listed.append(block)
        else:
            listed[place] = listed[place].joined(block)  # type: ignore[union-attr, arg-type]
    return [Section(title, blocks) for title, blocks in by_title.items()]


def _alike(one: Block, other: Block) -> bool:
    if not isinstance(one, Table) or not isinstance(other, Table):
        return False
    return one.title == other.title and one.head[0] == other.head[0] != ""
