"""Which race controls the balls of a single bearing: regions, boundaries, their fits."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.analyses.control.control_map import THIRD
from rotordyn.analyses.control.result import ControlResult
from rotordyn.analyses.control.solve import BOUNDARY_WORDS, fitted
from rotordyn.figures.legends import top_legend
from rotordyn.figures.style import (
    BLACK,
    BLUE,
    DASHES,
    FONT_SIZE,
    GREY,
    RED,
    add_axes,
    new_figure,
    speed_ticks,
)
from rotordyn.results.described import Shown
from rotordyn.results.display import RPM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS = {"inner": RED, "outer": BLUE}
SHADES = {  # neither first: the others lie on it
    "neither": ("#E2E2E2", "neither race controls"),
    "inner": ("#F3C9B2", "inner race controls"),
    "outer": ("#E1F0FA", "outer race controls"),
}


def control_figure(result: ControlResult) -> Figure:
    """Draw regions as shades, boundaries and their quadratic fits as lines."""
    figure = new_figure(168.0, 108.0)
    axes = add_axes(figure, (17.0, 12.0, 143.0, 74.0))
    draw_control(axes, result)
    top_legend(figure, axes)
    return figure


def draw_control(axes: Axes, result: ControlResult, most: int = 6) -> None:
    """Draw regions, boundaries and fits; ``most`` ticks of speed."""
    rpm = result.speed * RPM.factor
    axes.set_xlabel("speed [rpm]", fontsize=FONT_SIZE)
    axes.set_ylabel(f"{load_name(result)} [N]", fontsize=FONT_SIZE)
    axes.set_ylim(0.0, float(result.load[-1]))
    speed_ticks(axes, float(rpm[-1]), most)
    if rpm.size > 1:
        axes.set_xlim(float(rpm[0]), float(rpm[-1]))
        _regions(axes, result)
    for k, (race, label) in enumerate(BOUNDARY_WORDS.items()):
        finite = np.isfinite(result.boundary_load[k])
        if finite.any():
            look: dict[str, Any] = {"color": COLOURS[race], "ls": DASHES[k], "lw": 1.8}
            axes.plot(rpm, result.boundary_load[k], label=label, **look)
        if not result.fit_absence[k]:
            load = np.where(finite, fitted(result, k), np.nan)
            name = f"quadratic fit, {race} race"
            axes.plot(rpm, load, color=BLACK, lw=0.9, ls=DASHES[2 + k], label=name)


def draw_variant(axes: Axes, variant: Shown, _: object) -> None:
    """Draw the boundaries of one variant, small, beside those of others."""
    draw_control(axes, variant.result, 4)


def load_name(result: ControlResult) -> str:
    """Return the name of the load."""
    return "axial load" + (f", radial {result.radial:g} of it" if result.radial else "")


def _regions(axes: Axes, result: ControlResult) -> None:
    """Shade regions by the margins; no state, or a third contact, leaves the background white."""
    rpm = result.speed * RPM.factor
    inner, outer = (np.ma.masked_invalid(m.T) for m in (result.inner_margin, result.outer_margin))
    fields = {"neither": np.ma.ones(inner.shape), "inner": inner, "outer": outer}
    fields["neither"].mask = inner.mask | (not _between(result))
    for name, (colour, text) in SHADES.items():
        if fields[name].count() and fields[name].max() > 0.0:
            above = [0.0, np.inf]
            axes.contourf(rpm, result.load, fields[name], above, colors=[colour], zorder=0.5)
            axes.fill([], [], color=colour, label=text + (" all balls" if result.radial else ""))
    third = result.state == THIRD
    white = {"no state": np.isnan(result.inner_margin) & ~third, THIRD: third}
    if label := " or ".join(text for text, where in white.items() if where.any()):
        axes.fill([], [], facecolor="white", edgecolor=GREY, label=label)


def _between(result: ControlResult) -> bool:
    """Return whether there are states in which neither race controls."""
    neither = (result.inner_margin <= 0.0) & (result.outer_margin <= 0.0)
    return bool(neither.any() or np.isfinite(result.boundary_load).any())
