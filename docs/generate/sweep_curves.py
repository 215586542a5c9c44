"""Time against true error of a preload sweep and an FRF map, drawn from the last measurement."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from docs.generate.pictures import keep_figure
from docs.generate.precision import plain_ticks
from docs.generate.sweeps import Lines
from docs.generate.times import measured
from rotordyn.figures.legends import legend
from rotordyn.figures.style import BLUE, RED, add_axes, grid_boxes, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LOOKS = {"any degree": (BLUE, "o-"), "standard": (RED, "s--")}


def draw_sweeps() -> None:
    """The curves into the folder of figures."""
    keep_figure(sweeps_figure(measured()["sweeps"]), "sweeps")


def sweeps_figure(found: dict[str, Lines]) -> Figure:
    """Preload states, and the map with both kinds of elements."""
    figure = new_figure(168.0, 78.0)
    boxes = grid_boxes(figure, 1, 2, margins=(16.0, 5.0, 12.0, 8.0), gaps=(16.0, 0.0))
    preload, responses = (
        add_axes(figure, box, "time [ms]", name)
        for box, name in zip(boxes, ("largest relative error [-]", ""), strict=True)
    )
    _curve(preload, found["preload"], "tolerance", (BLUE, "o-"))
    for way, look in LOOKS.items():
        _curve(responses, [r for r in found["map"] if r["way"] == way], way, look)
    for axes, title in ((preload, "preload states"), (responses, "FRF map")):
        low, high = axes.get_xlim()
        axes.set_xlim(0.5 * low, 2.0 * high)
        plain_ticks(axes)
        axes.set_title(title, fontsize=8.0, pad=4.0)
        legend(axes, loc="lower left")
    return figure


def _curve(axes: Any, lines: Lines, name: str, look: tuple[str, str]) -> None:
    seconds, errors = ([line[key] for line in lines] for key in ("seconds", "error"))
    axes.loglog([1e3 * s for s in seconds], errors, look[1], color=look[0], ms=4.0, label=name)
