"""Figure of profiles: χ² above the best over each unknown, with the linear parabola."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rotordyn.figures.legends import shortened, top_legend
from rotordyn.figures.style import (
    BLUE,
    FONT_SIZE,
    GREY,
    ORANGE,
    add_axes,
    grid_boxes,
    head,
    new_figure,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from rotordyn.study.identification.identification import Identification
    from rotordyn.study.identification.profile import Profile

COLUMNS, ROW = 3, 44.0  # mm
TOP = 2.0  # upper end of an axis over the threshold


def profiles(result: Identification) -> Figure:
    """Draw a panel for each profile."""
    count = len(result.profiles)
    columns = min(COLUMNS, count)
    rows = -(-count // columns)
    figure = new_figure(height=12.0 + ROW * rows)
    boxes = grid_boxes(figure, rows, columns, margins=(15.0, 5.0, 11.0, 8.0), gaps=(11.0, 14.0))
    panels = [add_axes(figure, box) for box in boxes[:count]]
    for axes, profile in zip(panels, result.profiles.values(), strict=True):
        _profile(axes, result, profile)
    for axes in panels[::columns]:
        axes.set_ylabel("χ² above the best", fontsize=FONT_SIZE - 1.0)
    top_legend(figure, *panels)
    words = "all others identified again at each value"
    return head(figure, f"{result.title or result.name}: {words}")


def _profile(axes: Axes, result: Identification, profile: Profile) -> None:
    best, k = result.explained, profile.number
    unknown, sure = best.problem.unknowns[k], best.sure
    scale = unknown.shown(1.0)
    limit, value, deviation = sure.quantile**2, float(sure.values[k]), float(sure.deviation[k])
    ends = [*profile.values, *profile.interval]
    along = np.linspace(min(ends), max(ends), 101)
    if deviation > 0.0:
        parabola = ((along - value) / deviation) ** 2
        axes.plot(along * scale, parabola, "--", lw=0.8, color=GREY, label="linear")
    root = np.sign(profile.values - value) * np.sqrt(np.maximum(profile.excess, 0.0))
    interpolated = np.interp(along, profile.values, root) ** 2  # as the crossing is found
    axes.plot(along * scale, interpolated, lw=0.9, color=BLUE, label="profile")
    axes.plot(profile.values * scale, profile.excess, "o", ms=2.2, color=BLUE)
    axes.axhline(limit, color=ORANGE, lw=0.8, label="95 %")
    axes.axvspan(*(end * scale for end in profile.interval), color=BLUE, alpha=0.1, lw=0.0)
    axes.set_ylim(min(0.0, float(profile.excess.min())), TOP * limit)
    axes.locator_params(axis="x", nbins=4)
    axes.set_xlabel(shortened(unknown.heading, 28), fontsize=FONT_SIZE - 1.0)
