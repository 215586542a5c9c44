"""Figure of the error of the milled surface and the vibration of the tip over speed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.analyses.stability_lobes.figures import LEAST_SPEEDS
from rotordyn.analyses.stability_lobes.result import StabilityLobesResult
from rotordyn.arrays import Array, Flags
from rotordyn.figures.legends import top_legend
from rotordyn.figures.style import (
    BLACK,
    BLUE,
    GREY,
    ORANGE,
    RED,
    add_axes,
    axis_start,
    head,
    new_figure,
    speed_ticks,
)
from rotordyn.results.display import MICROMETRE, MILLIMETRE, RPM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Look = dict[str, Any]
WALLS: tuple[Look, ...] = (
    {"color": BLUE, "ls": "-", "marker": "o"},
    {"color": ORANGE, "ls": "--", "marker": "s"},
)
WAYS: tuple[Look, ...] = (
    {"color": BLACK, "ls": "-", "marker": "+"},
    {"color": RED, "ls": "--", "marker": "x"},
)
SIZE = 3.0  # of marks


def surface_figure(result: StabilityLobesResult) -> Figure:
    """Draw the errors of every wall from least to largest over its depth; below, the peak-to-peak
    vibration of the tip. Speeds at which the cut is not stable, or not solved, are shaded."""
    rpm = result.milling_speed * RPM.factor
    lines = len(rpm) >= LEAST_SPEEDS
    figure = new_figure(168.0, 106.0)
    upper = add_axes(figure, (15.0, 58.0, 148.0, 44.0), "", "error of the surface [µm]")
    lower = add_axes(figure, (15.0, 11.0, 148.0, 40.0), "speed [rpm]", "vibration [µm]")
    upper.axhline(0.0, color=GREY, lw=0.6)
    for k, wall in enumerate(result.wall):
        least, most = (
            error[:, k] * MICROMETRE.factor
            for error in (result.surface_error_least, result.surface_error_most)
        )
        _draw_range(upper, rpm, least, most, f"{wall}-milled wall", WALLS[k], lines=lines)
    for k, direction in enumerate(result.direction):
        motion = result.tip_vibration[:, k] * MICROMETRE.factor
        _draw(lower, rpm, motion, f"vibration in {direction}, peak to peak", WAYS[k], lines=lines)
    lower.set_ylim(0.0, None)
    upper.tick_params(labelbottom=False)
    for axes in (upper, lower):
        _shade_unstable(axes, rpm, ~result.cut_is_stable)
        speed_ticks(axes, float(rpm[-1]), low=axis_start(float(rpm[0]), float(rpm[-1])))
    top_legend(figure, upper, lower)
    depth, feed = (size * MILLIMETRE.factor for size in (result.planned_depth, result.planned_feed))
    force = float(np.nanmax(result.cutting_force))
    return head(
        figure,
        f"{depth:.4g} mm deep, {feed:.4g} mm per tooth, forces up to {force:.4g} N; positive "
        "errors leave material",
    )


def _draw_range(
    axes: Axes, rpm: Array, least: Array, most: Array, label: str, look: Look, *, lines: bool
) -> None:
    """Draw a range over the depth of a wall, its largest amounts as a line or as marks."""
    if np.nanmax(most - least) > 0.0:
        if lines:
            axes.fill_between(rpm, least, most, color=look["color"], alpha=0.2, lw=0.0)
        else:
            axes.vlines(rpm, least, most, color=look["color"], alpha=0.4, lw=2.0)
    _draw(axes, rpm, np.where(most >= -least, most, least), label, look, lines=lines)


def _draw(axes: Axes, rpm: Array, y: Array, label: str, look: Look, *, lines: bool) -> None:
    if lines:
        axes.plot(rpm, y, color=look["color"], ls=look["ls"], lw=1.0, label=label)
    else:
        axes.plot(rpm, y, look["marker"], color=look["color"], ms=SIZE, label=label)


def _shade_unstable(axes: Axes, rpm: Array, lost: Flags) -> None:
    """Shade speeds at which the cut is not stable or not solved, halfway to adjacent speeds."""
    edges = np.concatenate([rpm[:1], 0.5 * (rpm[1:] + rpm[:-1]), rpm[-1:]])
    label: str | None = "cut not stable, or not solved"
    for row in np.flatnonzero(lost):
        axes.axvspan(edges[row], edges[row + 1], color=GREY, alpha=0.25, lw=0.0, label=label)
        label = None
