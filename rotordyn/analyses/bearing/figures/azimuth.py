"""Contacts of a single bearing around the ring, where balls differ."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rotordyn.analyses.bearing.figures.groove_ends import (
    COLOURS,
    MARKS,
    groove_ends,
    loaded_contacts,
)
from rotordyn.analyses.bearing.result import BearingMapResult
from rotordyn.analyses.bearing.solve import mounted_under
from rotordyn.figures.legends import top_legend
from rotordyn.figures.style import FONT_SIZE, add_axes, evenly, grid_boxes, new_figure
from rotordyn.results.display import DEGREE, RPM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_COLUMNS = 3


def azimuth_figure(result: BearingMapResult) -> Figure:
    """Draw load and angle of every contact over the azimuth of its ball, at the last speed; and the
    deflection of raceways where rings are flexible.

    Columns: first, middle and last load that have a state; bars are the extents of the contact
    ellipses, lines the ends of grooves.
    """
    rows = 3 if np.nanmax(np.abs(result.ring_deflection)) > 0.0 else 2
    figure = new_figure(168.0, 22.0 + 50.0 * rows)
    solved = np.flatnonzero(result.outcome[-1] == "")
    columns = solved[evenly(solved.size, MOST_COLUMNS)].tolist() if solved.size else [0]
    boxes = grid_boxes(figure, rows, len(columns), margins=(15.0, 4.0, 12.0, 10.0), gaps=(5.0, 6.0))
    top = np.nanmax(result.contact_load[-1], initial=0.0) / 1e3
    panels = []
    for panel, load in enumerate(columns):
        first = panel == 0
        x_label = "azimuth of the ball, from y to z [deg]" if len(columns) < 3 else "azimuth [deg]"
        upper = add_axes(figure, boxes[panel], "", "contact load [kN]" if first else "")
        lower = add_axes(
            figure,
            boxes[len(columns) + panel],
            "" if rows > 2 else x_label,
            "contact angle [deg]" if first else "",
        )
        _loads(upper, result, load)
        _angles(lower, result, load)
        column = [upper, lower]
        if rows > 2:
            y_label = "ring deflection [µm]" if first else ""
            column.append(add_axes(figure, boxes[2 * len(columns) + panel], x_label, y_label))
            _deflections(column[-1], result, load)
        upper.set_ylim(0.0, max(top, 1e-9) * 1.06)
        title = f"{mounted_under(result, load, ' axial')}, {result.speed[-1] * RPM.factor:.0f} rpm"
        upper.set_title(title, fontsize=FONT_SIZE, pad=3.0)
        for axes in column:
            axes.set_xlim(-8.0, 368.0)
            axes.set_xticks([0.0, 90.0, 180.0, 270.0, 360.0])
            axes.tick_params(labelbottom=axes is column[-1], labelleft=first)
        panels += column
    top_legend(figure, *panels)
    return figure


def _loads(axes: Axes, result: BearingMapResult, load: int) -> None:
    for k, name in loaded_contacts(result):
        values = result.contact_load[-1, load, :, k]
        axes.plot(
            result.ball * DEGREE.factor,
            np.where(values > 0.0, values, np.nan) / 1e3,
            color=COLOURS[name],
            marker=MARKS[name],
            ms=2.6,
            lw=0.9,
            label=f"contact {name}",
        )


def _deflections(axes: Axes, result: BearingMapResult, load: int) -> None:
    for k, name in loaded_contacts(result):
        values = result.ring_deflection[-1, load, :, k] * 1e6
        axes.plot(
            result.ball * DEGREE.factor,
            values,
            color=COLOURS[name],
            marker=MARKS[name],
            ms=2.6,
            lw=0.9,
        )
    deflection = result.ring_deflection[-1] * 1e6
    low, high = np.nanmin(deflection, initial=0.0), np.nanmax(deflection, initial=0.0)
    axes.set_ylim(low - 0.06 * (high - low), high + 0.06 * (high - low))


def _angles(axes: Axes, result: BearingMapResult, load: int) -> None:
    for k, name in loaded_contacts(result):
        low, middle, high = (
            values[-1, load, :, k] * DEGREE.factor
            for values in (result.ellipse_lower, result.contact_angle, result.ellipse_upper)
        )
        azimuth, colour = result.ball * DEGREE.factor, COLOURS[name]
        axes.plot(azimuth, middle, color=colour, marker=MARKS[name], ms=2.6, lw=0.9)
        axes.vlines(azimuth, low, high, color=colour, lw=2.2, alpha=0.28)
    axes.vlines([], [], [], color="#888888", lw=2.2, alpha=0.5, label="extent of the ellipse")
    groove_ends(axes, result)
