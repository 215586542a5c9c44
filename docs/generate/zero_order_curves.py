"""Error of zero order in stable depths over the immersion, compared with all harmonics."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from docs.generate.pictures import keep_figure
from rotordyn.analyses.stability_lobes import limit_depth
from rotordyn.figures.legends import legend
from rotordyn.figures.style import (
    BLUE,
    FONT_SIZE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    add_axes,
    new_figure,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Complex = NDArray[np.complex128]
NATURAL, RATIO, MASS = 2.0 * math.pi * 922.0, 0.011, 0.03993  # Insperger and Stépán (2004)
CUTTER = (2, 6e8, 2e8)
SPEEDS = {6000.0: BLUE, 10000.0: ORANGE, 14000.0: GREEN, 19000.0: PURPLE}  # rpm
IMMERSIONS = np.geomspace(0.02, 1.0, 61)
RATIOS = (0.3, 0.5, 1.0, 2.0, 5.0, 10.0)


def draw_zero_order() -> None:
    """The figure into the folder of figures."""
    keep_figure(zero_order_figure(), "zero_order")


def zero_order_figure() -> Figure:
    """Limit of zero order over the true one, up-milling and down-milling; marks where period
    doubling is the true loss."""
    figure = new_figure(168.0, 80.0)
    for place, how in enumerate(("up", "down")):
        box = (14.0 + 80.0 * place, 12.0, 70.0, 58.0)
        axes = add_axes(
            figure, box, "immersion [-]", "" if place else "zero order / true limit [-]"
        )
        for rpm, colour in SPEEDS.items():
            found = [_ratio(float(share), how, rpm) for share in IMMERSIONS]
            ratio, flips = (np.array(each) for each in zip(*found, strict=True))
            axes.loglog(IMMERSIONS, ratio, color=colour, lw=1.1, label=f"{rpm:.0f} rpm")
            axes.plot(IMMERSIONS[flips], ratio[flips], "o", ms=2.5, color=colour)
        axes.axhline(1.0, color=GREY, lw=0.7)
        axes.set_ylim(0.3, 10.0)
        axes.set_title(f"{how}-milling", fontsize=FONT_SIZE)
        for axis, ticks in ((axes.xaxis, (0.02, 0.05, 0.1, 0.2, 0.5, 1.0)), (axes.yaxis, RATIOS)):
            axis.set_ticks(ticks, [f"{tick:g}" for tick in ticks])
            axis.set_ticks([], minor=True)
        if place:
            legend(axes, loc="upper left")
    return figure


def _ratio(share: float, how: str, rpm: float) -> tuple[float, bool]:
    """Limit of zero order over that of all harmonics, and whether that is period doubling."""
    ends = (0.0, math.acos(1.0 - 2.0 * share))
    if how == "down":
        ends = (math.acos(2.0 * share - 1.0), math.pi)
    cut = (*CUTTER, *ends, rpm * math.pi / 30.0)
    full, quick = limit_depth(_receptance, *cut), limit_depth(_receptance, *cut, "zero-order")
    return quick.depth / full.depth, full.kind == "flip"


def _receptance(omega: NDArray[np.float64]) -> Complex:
    """One mode along the feed."""
    found = np.zeros((len(omega), 2, 2), dtype=complex)
    swing = NATURAL**2 - omega**2 + 2j * RATIO * NATURAL * omega
    found[:, 0, 0] = 1.0 / MASS / swing
    return found
