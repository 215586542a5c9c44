"""Variants side by side: the main figure of an analysis, small, once for each of them."""

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
FAR = 20.0  # [mm] between panels: each has numbers of its own
Box = tuple[float, float, float, float]


def _none(*_: Any) -> None:
    return None


class Panel(NamedTuple):
    """How the main figure of an analysis is drawn onto axes that it is given.

    ``draw(axes, variant, shared)``, with labels of the axes; ``shared(variants)``: what all panels
    have in common, such as limits. ``scale(figure, axes, variant, box)``: what its colours mean,
    drawn once, beside the ``box`` [mm]. ``margins``: left, right, bottom, top of the figure and
    ``gaps`` across and down between panels ``tall`` high [mm].
    """

    name: str
    draw: Callable[[Axes, Shown, Any], None]
    shared: Callable[[Sequence[Shown]], Any] = _none
    scale: Callable[[Figure, Axes, Shown, Box], None] = _none
    tall: float = 66.0
    margins: tuple[float, float, float, float] = (15.0, 9.0, 12.0, 8.0)
    gaps: tuple[float, float] = (14.0, 13.0)


def pages(variants: Sequence[Shown]) -> list[Sequence[Shown]]:
    """Variants by page; none of so many that they would not be read."""
    if len(variants) > ON_A_PAGE * MOST_PAGES:
        return []
    return [variants[k : k + ON_A_PAGE] for k in range(0, len(variants), ON_A_PAGE)]


def panels_figure(panel: Panel, variants: Sequence[Shown], page: Sequence[Shown]) -> Figure:
    """A panel per variant of the ``page`` on equal axes, two beside each other.

    Labels of axes are not repeated; the legend stands in the cell that is left over, or above.
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
