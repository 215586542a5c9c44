"""Chart and error map of Debongnie's approximation."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bearings.debongnie import LIFE, distribution, equivalent_factors, peak, power_law, race_weights
from docs.generate.debongnie_errors import RATIOS, SHARES, Errors, errors
from docs.generate.pictures import keep_figure
from rotordyn.figures.style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    RED,
    add_axes,
    grid_boxes,
    log_ticks,
    new_figure,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
SIZE_RATIO = math.pi / 16.0  # D/dm of his example
EXAMPLE = 0.2  # Fr/(z Fc) for which the chart shows how it is read
RADIAL = {0.5: ":", 1.0: "-", 2.0: "--"}  # ki/ke
LOADS = {  # colour, and how far the label is moved [pt]
    "z Qe,max / Fr": (ORANGE, 0.0),
    "P0 / Fr": (RED, 3.0),
    "P / Fr": (GREEN, -5.0),
    "z Qi,max / Fr": (PURPLE, 0.0),
}
LEVELS = (0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 75.0)  # of the error map [%]
SHOWN = (16, 10, 7)


def draw_debongnie() -> None:
    """The chart and the error map into the folder of figures."""
    keep_figure(chart(), "debongnie_chart")
    keep_figure(error_map(), "debongnie_errors")


def chart() -> Figure:
    """Displacement from the load, above; loads of balls and equivalent loads, below."""
    figure = new_figure(168.0, 128.0)
    upper = add_axes(figure, (16.0, 78.0, 124.0, 46.0), "", "Fr / (z Fc) [-]")
    lower = add_axes(figure, (16.0, 12.0, 124.0, 60.0), "δc / δr [-]", "load / Fr [-]")
    share = np.linspace(0.1, 0.9, 161)
    for ratio, look in RADIAL.items():
        radial = distribution(1.0 / share - 1.0, power_law(ratio)).radial
        upper.semilogy(share, radial, look, color=BLUE)
        _label(upper, f"ki/ke = {ratio:g}", radial[-1], BLUE)
    over = {ratio: _loads(share, ratio) for ratio in RADIAL}
    for name, (colour, shift) in LOADS.items():
        lower.semilogy(share, over[1.0][name], color=colour)
        lower.fill_between(share, over[0.5][name], over[2.0][name], color=colour, alpha=0.15, lw=0)
        _label(lower, name, over[1.0][name][-1], colour, shift)
    _example(upper, lower)
    for axes, limits in ((upper, (5e-4, 10.0)), (lower, (0.9, 1e3))):
        axes.set_xlim(0.1, 0.9)
        axes.set_ylim(limits)
        ticks = log_ticks(*limits)
        axes.minorticks_off()
        axes.set_yticks([value for value, _ in ticks], [name for _, name in ticks])
    return figure


def error_map() -> Figure:
    """Errors of displacement and of the largest ball load over δc/δr and ki/ke."""
    figure = new_figure(168.0, 108.0)
    boxes = grid_boxes(figure, 2, len(SHOWN), margins=(15.0, 22.0, 12.0, 8.0), gaps=(6.0, 9.0))
    found = {balls: errors(balls) for balls in SHOWN}
    for place, box in enumerate(boxes):
        row, column = divmod(place, len(SHOWN))
        axes = add_axes(figure, box, "δc / δr [-]" if row else "", "" if column else "ki / ke [-]")
        balls = SHOWN[column]
        filled = _panel(
            axes, found[balls], found[balls].inner if row else found[balls].displacement
        )
        axes.set_title(f"{'largest Qi' if row else 'δr'}, {balls} balls", fontsize=8.0, pad=3.0)
        if column:
            axes.set_yticklabels([])
    bar = add_axes(figure, (150.0, 12.0, 3.5, 88.0))
    figure.colorbar(filled, cax=bar, ticks=LEVELS, spacing="uniform", format="%g")
    bar.set_ylabel("relative error [%]", fontsize=8.0)
    bar.grid(visible=False)
    return figure


def _panel(axes: Axes, ring: Errors, error: Array) -> object:
    from matplotlib.colors import BoundaryNorm

    filled = axes.contourf(
        SHARES,
        RATIOS,
        100.0 * np.abs(error),
        LEVELS,
        cmap="YlGnBu",
        norm=BoundaryNorm(LEVELS, 256),
    )
    axes.set_yscale("log")
    axes.set_yticks([0.5, 1.0, 2.0], ["0.5", "1", "2"])
    axes.minorticks_off()
    axes.set_xticks([0.1, 0.3, 0.5, 0.7, 0.9])
    in_zone = ring.in_zone[0]
    for count, look in ((3.0, "--"), (1.5, "-")):
        if in_zone.min() < count < in_zone.max():
            at = float(np.interp(-count, -in_zone, SHARES))
            axes.axvline(at, color=BLACK, lw=0.9, ls=look)
    return filled


def _loads(share: Array, ratio: float) -> dict[str, Array]:
    """Curves of the lower panel of the chart at δc/δr = ``share``."""
    around = distribution(1.0 / share - 1.0, power_law(ratio))
    static, *races = equivalent_factors()
    means = np.array(races)[:, None] * [around.inner_mean, around.outer_mean]
    life = np.dot(race_weights(SIZE_RATIO), means**LIFE) ** (1.0 / LIFE)
    outer = 1.0 + around.inner_peak
    over = (outer, static * outer, life, around.inner_peak)
    return {name: load / around.radial for name, load in zip(LOADS, over, strict=True)}


def _example(upper: Axes, lower: Axes) -> None:
    """From the load across to the curve, then down to the loads of the balls."""
    share = 1.0 / (1.0 + float(peak(EXAMPLE, power_law(1.0))))
    dashes = {"color": GREY, "lw": 0.9, "ls": (0, (4, 2))}
    upper.plot([0.1, share, share], [EXAMPLE, EXAMPLE, 5e-4], **dashes)
    lower.axvline(share, **dashes)
    upper.plot([share], [EXAMPLE], "o", color=BLUE, ms=3.5)
    for name, load in _loads(np.array([share]), 1.0).items():
        lower.plot([share], load, "o", color=LOADS[name][0], ms=3.5)


def _label(axes: Axes, name: str, height: float, colour: str, shift: float = 0.0) -> None:
    axes.annotate(
        name,
        (0.9, height),
        xytext=(4.0, shift),
        textcoords="offset points",
        va="center",
        fontsize=7.0,
        color=colour,
    )
