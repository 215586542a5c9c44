"""Time against true error, drawn from the last measurement."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from docs.generate.pictures import keep_figure
from docs.generate.times import measured
from rotordyn.figures.legends import legend
from rotordyn.figures.style import BLUE, RED, add_axes, grid_boxes, log_ticks, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LOOKS = {"any degree": (BLUE, "o-"), "standard": (RED, "s--")}


def draw_precision() -> None:
    """The curves of the last measurement into the folder of figures."""
    keep_figure(precision_figure(measured()["precision"]), "precision")


def precision_figure(lines: list[dict[str, Any]]) -> Figure:
    """A panel per machine, a curve per kind of elements."""
    machines = list(dict.fromkeys(line["machine"] for line in lines))
    figure = new_figure(168.0, 78.0)
    boxes = grid_boxes(figure, 1, len(machines), margins=(16.0, 5.0, 12.0, 8.0), gaps=(16.0, 0.0))
    for place, (machine, box) in enumerate(zip(machines, boxes, strict=True)):
        axes = add_axes(figure, box, "time [ms]", "" if place else "largest relative error [-]")
        for kind, (colour, look) in LOOKS.items():
            own = [r for r in lines if r["machine"] == machine and r["elements"] == kind]
            seconds = [1e3 * r["seconds"] for r in own]
            axes.loglog(seconds, [r["error"] for r in own], look, color=colour, ms=4.0, label=kind)
        plain_ticks(axes)
        axes.set_title(machine, fontsize=8.0, pad=4.0)
        if not place:
            legend(axes, loc="lower left")
    return figure


def plain_ticks(axes: Axes) -> None:
    """Both scales logarithmic, with few ticks written out."""
    from matplotlib.ticker import NullFormatter, NullLocator

    for axis, limits in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        ticks = log_ticks(*limits)
        axis.set_minor_locator(NullLocator())
        axis.set_minor_formatter(NullFormatter())
        axis.set_ticks([v for v, _ in ticks], [name for _, name in ticks])
