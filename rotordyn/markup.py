"""Short tables in HTML, for notebooks: every text is escaped, and there are no scripts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

_CELL = 'style="text-align: left"'


def table(caption: str, rows: Iterable[Sequence[str]], head: Sequence[str] = ()) -> str:
    """Table with a caption; the first column has row headings; cells are escaped."""
    lines = [f"<table><caption {_CELL}><b>{escape(caption)}</b></caption>"]
    if head:
        lines.append(_row(head, len(head)))
    lines += [_row(row, 1) for row in rows]
    return "\n".join([*lines, "</table>"])


def _row(cells: Sequence[str], heads: int) -> str:
    kinds = ["th" if place < heads else "td" for place in range(len(cells))]
    shown = (f"<{k} {_CELL}>{escape(c)}</{k}>" for k, c in zip(kinds, cells, strict=True))
    return f"<tr>{''.join(shown)}</tr>"


def preformatted(title: str, text: str) -> str:
    """Preformatted text, folded under a title."""
    return f"<details><summary>{escape(title)}</summary><pre>{escape(text)}</pre></details>"
