"""Legends: within axes, or at the top of a figure, which grows for them."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from rotordyn.figures.style import FONT_SIZE, grow, mark_lone_points, measuring, text_width

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIZE = FONT_SIZE - 1.0
EM = SIZE * 25.4 / 72.0  # [mm]
HANDLE, BEFORE_TEXT, BETWEEN = 2.4, 0.8, 1.4  # [em] a line, its gap to the text, between columns
EDGE = 0.3  # [em] around the legend
LONGEST = 100  # characters of a line
TITLE = 4.5  # [mm] above the axes


def legend(axes: Axes, **kwargs: Any) -> None:
    """Draw a legend in the report style, where lines leave room unless ``loc`` is given."""
    entries = _entries([axes])
    if entries:
        axes.legend(
            entries.values(),
            entries.keys(),
            frameon=True,
            framealpha=0.85,
            edgecolor="none",
            fontsize=SIZE,
            **kwargs,
        )


def top_legend(figure: Figure, *panels: Axes, above: float = 0.0) -> None:
    """Draw a legend of the lines of ``panels``, each once, at the top of the figure.

    The figure grows if the legend needs more height than there is above the axes and the labels,
    ``above`` [mm] high, on top of them.
    """
    entries = {textwrap.fill(name, LONGEST): h for name, h in _entries(panels).items()}
    if not entries:
        return
    width = figure.get_size_inches()[0] * 25.4
    columns = _columns([_entry_width(name) for name in entries], width)
    ordered = [name for k in range(columns) for name in [*entries][k::columns]]  # row by row
    placed = figure.legend(
        [entries[name] for name in ordered],
        ordered,
        loc="upper center",
        ncols=columns,
        frameon=False,
        fontsize=SIZE,
        borderaxespad=EDGE,
        columnspacing=BETWEEN,
        handlelength=HANDLE,
        handletextpad=BEFORE_TEXT,
        borderpad=EDGE,
    )
    tall = placed.get_window_extent(measuring(figure.dpi)).height
    _make_room(figure, above + tall * 25.4 / figure.dpi + EDGE * EM)
    placed.set_bbox_to_anchor((0.0, 0.0, 1.0, 1.0), transform=figure.transFigure)


def legend_in(figure: Figure, box: Sequence[float], *panels: Axes) -> None:
    """Draw a legend of the lines of ``panels``, each once, centred in an empty ``box`` [mm]."""
    entries = _entries(panels)
    if not entries:
        return
    width, height = figure.get_size_inches() * 25.4
    left, bottom, wide, tall = box
    figure.legend(
        entries.values(),
        entries.keys(),
        loc="center",
        bbox_to_anchor=(left / width, bottom / height, wide / width, tall / height),
        frameon=False,
        fontsize=SIZE,
        handlelength=HANDLE,
    )


def rows_of(handles: Sequence[Any], width: float) -> list[list[Any]]:
    """Arrange ``handles`` in the fewest rows that fit into ``width`` [mm], in their order."""
    rows: list[list[Any]] = []
    used = math.inf
    for handle in handles:
        wide = text_width(handle.get_label(), SIZE)
        wide += (HANDLE + BEFORE_TEXT + BETWEEN) * EM
        if used + wide > width:
            rows.append([])
            used = 0.0
        rows[-1].append(handle)
        used += wide
    return rows


def shortened(title: str, longest: int = 48) -> str:
    """Cut a title to a length that fits above a panel of half the width of a figure."""
    return title if len(title) <= longest else title[: longest - 1].rstrip() + "…"


def _entries(panels: Sequence[Axes]) -> dict[str, Any]:
    """Return handles by name, with the marks of lone points; a name of several curves has the
    handle of the first."""
    entries: dict[str, Any] = {}
    for axes in panels:
        mark_lone_points(axes)
        for handle, name in zip(*axes.get_legend_handles_labels(), strict=True):
            entries.setdefault(name, handle)
    return entries


def _entry_width(name: str) -> float:
    """Return the width of an entry, line and text [mm]."""
    text = max(text_width(line, SIZE) for line in name.split("\n"))
    return text + (HANDLE + BEFORE_TEXT) * EM


def _columns(widths: Sequence[float], width: float) -> int:
    """Return the number of columns of entries, filled row by row, that fit into ``width`` [mm]."""
    return next((n for n in range(len(widths), 1, -1) if _total_width(widths, n) <= width), 1)


def _total_width(widths: Sequence[float], columns: int) -> float:
    total = sum(max(widths[k::columns]) for k in range(columns))
    return total + ((columns - 1) * BETWEEN + 4.0 * EDGE) * EM


def _make_room(figure: Figure, needed: float) -> None:
    """Grow ``figure`` upwards until ``needed`` [mm] are free above its axes."""
    height = figure.get_size_inches()[1] * 25.4
    highest = max(
        axes.get_position().y1 * height + (TITLE if axes.get_title() else 0.0)
        for axes in figure.axes
    )
    more = math.ceil(needed + highest - height)
    if more <= 0:
        return
    grow(figure, more)
