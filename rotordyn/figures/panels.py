"""Variants side by side: a small main figure of an analysis for each variant."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from rotordyn.figures.legends import legend_in, shortened, top_legend
from rotordyn.figures.style import FONT_SIZE, add_axes, grid_boxes, new_figure
from rotordyn.results.described import Shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ON_A_PAGE, MOST_PAGES = 6, 2
FAR = 20.0  # [mm] between panels: at larger gaps each has its tick labels
Box = tuple[float, float, float, float]


def _none(*_: Any) -> None:
    return None


class Panel(NamedTuple):
    """Functions and sizes that draw the main figure of an analysis on given axes.

    ``draw(axes, variant, shared)``, with labels of the axes; ``shared(variants)``: data common to
    all panels, such as limits. ``scale(figure, axes, variant, box)``: the colour scale, drawn once
    next to the ``box`` [mm]. ``margins``: left, right, bottom, top of the figure, and ``gaps``
    across and down between panels ``tall`` high [mm].
    """

    name: str
    draw: Callable[[Axes, Shown, Any], None]
    shared: Callable[[Sequence[Shown]], Any] = _none
    scale: Callable[[Figure, Axes, Shown, Box], None] = _none
    tall: float = 66.0
    margins: tuple[float, float, float, float] = (15.0, 9.0, 12.0, 8.0)
    gaps: tuple[float, float] = (14.0, 13.0)


def pages(variants: Sequence[Shown]) -> list[Sequence[Shown]]:
    """Divide variants into pages; none if there would be too many pages."""
    if len(variants) > ON_A_PAGE * MOST_PAGES:
        return []
    return [variants[k : k + ON_A_PAGE] for k in range(0, len(variants), ON_A_PAGE)]


def panels_figure(panel: Panel, variants: Sequence[Shown], page: Sequence[Shown]) -> Figure:
    """Draw a panel for each variant of the ``page`` on equal axes, in two columns.

    Labels of axes are not repeated; the legend is in the empty cell, or above.
    """
    shared, columns = panel.shared(variants), min(len(page), 2)
    rows = math.ceil(len(page) / columns)
    height = panel.margins[2] + panel.margins[3] + rows * panel.tall + (rows - 1) * panel.gaps[1]
    figure = new_figure(168.0, height)
    boxes = grid_boxes(figure, rows, columns, margins=panel.margins, gaps=panel.gaps)
    drawn = []
    for place, (variant, box) in enumerate(zip(page, boxes, strict=False)):
        axes = add_axes(figure, box)
        panel.draw(axes, variant, shared)
        if not axes.get_title():
            axes.set_title(shortened(variant.title), fontsize=FONT_SIZE, pad=4.0)
        if place == columns - 1:
            panel.scale(figure, axes, variant, box)
        drawn.append(axes)
    for place, axes in enumerate(drawn):
        if place + columns < len(drawn):
            axes.xaxis.label.set_visible(False)
        if place % columns and axes.get_ylabel() == drawn[place - 1].get_ylabel():
            axes.yaxis.label.set_visible(False)
            axes.tick_params(labelleft=panel.gaps[0] > FAR)
    if len(boxes) > len(page):
        legend_in(figure, boxes[-1], *drawn)
    else:
        top_legend(figure, *drawn)
    return figure
