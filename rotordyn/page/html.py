"""Write a page as one HTML file: sections, tables, charts and the library that draws them."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from rotordyn.errors import InvalidInput
from rotordyn.markup import preformatted
from rotordyn.page.blocks import (
    Block,
    Chart,
    Control,
    Markup,
    Printed,
    Section,
    Shapes,
    Table,
    Text,
)
from rotordyn.page.packed import compressed, packed
from rotordyn.whole import whole_files

ARROW = "\u00a0→ "  # allows a line break only after the arrow
LONG = 50  # characters from which a cell is wide
FEW_COLUMNS = 3  # tables with fewer columns are placed side by side
MOST_COLUMNS = 12  # a folded table with more is printed smaller
STARTS = "0123456789-+−<>. "  # first characters of cells with numbers
ENDINGS = (".html", ".htm")
_FRAME = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="generator" content="rotordyn">
<title>{title}</title>
<style>
{style}</style>
</head>
<body>
<header>
<h1>{title}</h1>
{about}
</header>
<nav aria-label="Sections">
<ul>
{contents}
</ul>
</nav>
<main>
{body}
</main>
<footer><p>{footer}</p></footer>
<noscript><p>Charts need JavaScript; verdict and tables do not.</p></noscript>
<script type="text/plain" id="library">{library}</script>
<script type="text/plain" id="content">{content}</script>
<script>
{script}</script>
</body>
</html>
"""


@dataclass(frozen=True, slots=True)
class Page:
    """Content of a page: ``title``, lines ``about`` it, sections, footer.

    ``verdict``: short result; ``grave``: whether it states a failure.
    """

    title: str
    about: Sequence[str]
    verdict: str
    grave: bool
    sections: Sequence[Section]
    footer: str = ""


def html(page: Page) -> str:
    """Return the page as HTML.

    Raises
    ------
    ModuleNotFoundError : plotly, which contains the chart library, is not installed
    """
    drawn: dict[str, Any] = {}
    body = [_section(place, each, drawn) for place, each in enumerate(page.sections)]
    named = [f"<p>{escape(line)}</p>" for line in page.about if line]
    grave = "grave" if page.grave else "plain"
    named.append(f'<p class="verdict {grave}" role="status">{escape(page.verdict)}</p>')
    links = (f'<li><a href="#s{k}">{escape(s.title)}</a></li>' for k, s in enumerate(page.sections))
    return _FRAME.format(
        title=escape(page.title),
        style=_resource("page.css"),
        about="\n".join(named),
        contents="\n".join(links),
        body="\n".join(body),
        footer=escape(page.footer),
        library=packed_library() if drawn else "",
        content=packed(drawn),
        script=_resource("page.js"),
    )


def write(path: Path, page: Page) -> None:
    """Write a page to a file.

    Raises
    ------
    ModuleNotFoundError : plotly is not installed
    InvalidInput : the name of the file does not end as one of HTML, or it cannot be written
    """
    given, path = path, Path(os.path.realpath(path))
    stream = path.exists() and not path.is_file()  # a pipe or a device is written to, not replaced
    if not stream and given.suffix.lower() not in ENDINGS:
        raise InvalidInput(f"{given}: the name of a page ends in {' or '.join(ENDINGS)}")
    text = html(page)
    try:
        if stream:
            path.write_text(text, encoding="utf-8")
        else:
            with whole_files(path.parent) as place:
                (place / path.name).write_text(text, encoding="utf-8")
    except OSError as error:
        raise InvalidInput(f"{path} cannot be written: {error.strerror}") from error


@cache
def packed_library() -> str:
    """Compressed ``library``, made once per process."""
    return compressed(library())


def library() -> bytes:
    """Return plotly.js from the package plotly.

    Raises
    ------
    ModuleNotFoundError : the package is not installed
    """
    return (files("plotly") / "package_data" / "plotly.min.js").read_bytes()


def _resource(name: str) -> str:
    return (files("rotordyn.page") / name).read_text(encoding="utf-8")


def _section(place: int, section: Section, drawn: dict[str, Any]) -> str:
    """HTML of a section; data of its charts are added to ``drawn`` by their ``id``."""
    parts = [f'<section id="s{place}" aria-labelledby="h{place}">']
    parts.append(f'<h2 id="h{place}">{escape(section.title)}</h2>')
    around = ""
    for block in section.blocks:
        wanted = _around(block)
        if wanted != around:
            parts += ["</div>"] * bool(around)
            parts += [f'<div class="{wanted}">'] * bool(wanted)
            around = wanted
        parts += _block(block, section.title, drawn)
    parts += ["</div>"] * bool(around)
    return "\n".join([*parts, "</section>"])


def _around(block: Block) -> str:
    """CSS class of the container in which adjacent small blocks are placed; empty for others."""
    if isinstance(block, Chart) and not block.wide:
        return "grid"
    return "tables" if isinstance(block, Table) and len(block.head) < FEW_COLUMNS else ""


def _block(block: Block, section: str, drawn: dict[str, Any]) -> Iterator[str]:
    match block:
        case Text():
            yield from _text(block)
        case Printed():
            yield preformatted(block.title, block.text)
        case Table():
            yield from _table(block, section)
        case _:
            name = f"c{len(drawn)}"
            drawn[name] = _chart(block) if isinstance(block, Chart) else _shapes(block)
            yield from _figure(name, block)


def _text(text: Text) -> Iterator[str]:
    if text.title:
        yield f"<h3>{escape(text.title)}</h3>"
    if text.listed:
        yield "<ul>"
        yield from (f"<li>{escape(each)}</li>" for each in text.sentences)
        yield "</ul>"
    else:
        yield from (f"<p>{escape(each)}</p>" for each in text.sentences)


def _table(table: Table, section: str) -> Iterator[str]:
    if table.folded:
        yield f"<details><summary>{escape(table.title)}</summary>"
    columns = [[row[k] for row in table.rows] for k in range(len(table.head))]
    kinds = ["", *map(_kind, columns[1:])]
    label = escape(table.title)
    shown = f'<span class="spoken">{label}</span>' if table.title == section else label
    caption = "" if table.folded else f"<caption>{shown}</caption>"
    many = ' class="many"' if table.folded and len(table.head) > MOST_COLUMNS else ""
    yield f'<div class="table" tabindex="0" role="region" aria-label="{label}">'
    yield f"<table{many}>{caption}"
    if any(table.head):
        heads = "".join(f'<th scope="col">{escape(each)}</th>' for each in table.head)
        yield f"<thead><tr>{heads}</tr></thead>"
    yield "<tbody>"
    for row in table.rows:
        cells = [
            f'<th scope="row">{escape(cell)}</th>'
            if k == 0
            else f"<td{kinds[k]}>{escape(cell).replace(' → ', ARROW)}</td>"
            for k, cell in enumerate(row)
        ]
        yield f"<tr>{''.join(cells)}</tr>"
    yield "</tbody></table></div>"
    if table.note:
        yield f'<p class="note">{escape(table.note)}</p>'
    if table.folded:
        yield "</details>"


def _kind(column: Sequence[str]) -> str:
    """CSS class of the cells of a column: numbers, long texts, or neither."""
    filled = [cell for cell in column if cell]
    if filled and all(cell[0] in STARTS or cell == "none" for cell in filled):
        return ' class="n"'
    return ' class="long"' if max(map(len, filled), default=0) > LONG else ""


def _figure(name: str, block: Chart | Shapes) -> Iterator[str]:
    wide = " wide" if isinstance(block, Shapes) or block.wide else ""
    tall, least = (block.tall, block.least) if isinstance(block, Chart) else (460, 0)
    yield f'<figure class="chart{wide}" id="{name}">'
    yield f"<h3>{escape(block.title)}</h3>"
    if block.controls or isinstance(block, Shapes):
        yield '<div class="controls">'
        for number, control in enumerate(block.controls):
            yield from _control(f"{name}_{number}", control)
        if isinstance(block, Shapes):
            yield '<button type="button" class="play" aria-pressed="false">Play</button>'
        yield "</div>"
    label = escape(block.title, quote=True)
    style = f"height:{tall}px" + (f";min-width:{least}px" if least else "")
    yield f'<div class="across"><div class="plot" role="img" aria-label="{label}" style="{style}">'
    yield "</div></div>"
    if block.words:
        yield '<p class="words" aria-live="polite"></p>'
    if block.note:
        yield f"<figcaption>{escape(block.note)}</figcaption>"
    yield "</figure>"


def _control(name: str, control: Control) -> Iterator[str]:
    """HTML of a slider or a list; hidden if it has one option only."""
    hidden = " hidden" if len(control.options) < 2 else ""
    yield f'<label for="{name}"{hidden}>{escape(control.label)}'
    if control.slider:
        last = len(control.options) - 1
        yield f'<input type="range" id="{name}" min="0" max="{last}" value="{control.start}">'
        yield f'<output for="{name}">{escape(control.options[control.start])}</output>'
    else:
        options = (
            f"<option{' selected' * (k == control.start)}>{escape(word)}</option>"
            for k, word in enumerate(control.options)
        )
        yield f'<select id="{name}">{"".join(options)}</select>'
    yield "</label>"


def _controls(controls: Sequence[Control]) -> list[Mapping[str, Any]]:
    """Data of the controls for the script, which sets them as text, so that nothing is escaped."""
    return [{"options": [*map(Markup, c.options)], "start": c.start} for c in controls]


def _chart(chart: Chart) -> dict[str, Any]:
    return {
        "kind": "chart",
        "traces": list(chart.traces),
        "layout": chart.layout,
        "controls": _controls(chart.controls),
        "words": [*map(Markup, chart.words)],
    }


def _shapes(shapes: Shapes) -> dict[str, Any]:
    motion = shapes.motion
    return {
        "kind": "shapes",
        "controls": _controls(shapes.controls),
        "words": [*map(Markup, shapes.words)],
        "points": shapes.points,
        "triangles": shapes.triangles,
        "place": shapes.place,
        "station": shapes.station,
        "motion": np.stack([motion.real, motion.imag], axis=-1),
        "still_points": shapes.still_points,
        "still_triangles": shapes.still_triangles,
    }
