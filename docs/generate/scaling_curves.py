"""Computing time over the size of machine and analyses, drawn from the last measurement."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from docs.generate.pictures import keep_figure
from docs.generate.precision import plain_ticks
from docs.generate.scaling import MOST_MEGABYTES, MOST_SECONDS, SECTIONS, Lines
from docs.generate.times import measured
from rotordyn.figures.legends import legend
from rotordyn.figures.style import (
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    RED,
    add_axes,
    grid_boxes,
    new_figure,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LOOKS = {
    "speeds": (BLUE, "o-"),
    "frequencies": (RED, "s-"),
    "bearings": (GREEN, "^-"),
    "balls": (ORANGE, "D-"),
}


def draw_scaling() -> None:
    """The curves of the last measurement into the folder of figures."""
    keep_figure(scaling_figure(measured()["scaling"]), "scaling")


def scaling_figure(found: dict[str, Lines]) -> Figure:
    """Time and memory over sections; time of the other sweeps, each over its first size."""
    figure = new_figure(200.0, 76.0)
    boxes = grid_boxes(figure, 1, 3, margins=(16.0, 5.0, 12.0, 8.0), gaps=(18.0, 0.0))
    lines = found["sections"]
    sizes = [line["size"] for line in lines]
    time, memory, others = (
        add_axes(figure, box, *labels)
        for box, labels in zip(
            boxes,
            (
                ("sections [-]", "time of a call [s]"),
                ("sections [-]", "peak memory [MB]"),
                ("size over the smallest [-]", "time over the first [-]"),
            ),
            strict=True,
        )
    )
    time.loglog(sizes, [line["seconds"] for line in lines], "o-", color=BLUE, ms=4.0, label="call")
    _target(time, MOST_SECONDS)
    memory.plot(sizes, [line["memory"] for line in lines], "o-", color=BLUE, ms=4.0)
    memory.set_ylim(bottom=0.0)
    _target(memory, MOST_MEGABYTES)
    _straight(time, sizes, lines[-1]["seconds"])
    for name, (colour, look) in LOOKS.items():
        own = found[name]
        ratio = [line["size"] / own[0]["size"] for line in own]
        spent = [line["seconds"] / own[0]["seconds"] for line in own]
        others.loglog(ratio, spent, look, color=colour, ms=4.0, label=name)
    others.loglog([1.0, 16.0], [1.0, 16.0], ":", color=GREY, lw=1.0, label="linear")
    for axes, title in (
        (time, "modes of a shaft: time"),
        (memory, "modes of a shaft: memory"),
        (others, "other sweeps"),
    ):
        if axes is not memory:
            plain_ticks(axes)
        axes.set_title(title, fontsize=8.0, pad=4.0)
    legend(time, loc="upper left")
    legend(others, loc="upper left")
    return figure


def _target(axes: Axes, most: float) -> None:
    axes.plot([SECTIONS], [most], "v", color=RED, ms=6.0, label="target")


def _straight(axes: Axes, sizes: list[int], last: float) -> None:
    """A line of slope 1 through the last point."""
    ends = np.array([sizes[2], sizes[-1]], dtype=float)
    axes.loglog(ends, last * ends / ends[-1], ":", color=GREY, lw=1.0, label="linear")
