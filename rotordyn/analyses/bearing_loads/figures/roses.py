"""Roses of each bearing: the inner load of every ball, and the deflection of raceways."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.analyses.bearing_loads.result import BearingLoadsResult
from rotordyn.arrays import Array
from rotordyn.figures.style import (
    FONT_SIZE,
    add_axes,
    evenly,
    grid_boxes,
    line_of,
    new_figure,
)
from rotordyn.results.display import RPM

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ACROSS = 3
SIDE = 52.0  # mm
CLEAR = 0.08  # of the radius, between a name and a curve
MOST_NAMED = 4  # circles; of more, every second one
LEGEND = 4.0  # mm, above the line of words


def rose_figure(result: BearingLoadsResult, speeds: int = 3) -> Figure:
    """Draw a rose per bearing, seen from +x, y to the right and z up: first, middle, last speed."""
    loads = result.ball_inner_load
    return _roses(result, loads, "inner load of every ball [N]", speeds)


def ring_figure(result: BearingLoadsResult, speeds: int = 3) -> Figure:
    """Draw roses of the raceways' deflection, inner plus outer, which brings rings closer."""
    both = (result.inner_ring_deflection + result.outer_ring_deflection) * 1e6
    return _roses(result, both, "deflection of both raceways at every ball [µm]", speeds)


def _roses(result: BearingLoadsResult, values: Array, what: str, speeds: int) -> Figure:
    solved = np.flatnonzero(~np.isnan(result.axial_load).any(axis=1))
    picked = solved[evenly(solved.size, speeds)]
    across = min(ACROSS, len(result.bearing))
    rows = -(-len(result.bearing) // across)
    height = SIDE * rows + 18.0
    figure = new_figure(SIDE * across + 10.0, height)
    boxes = grid_boxes(figure, rows, across, margins=(9.0, 9.0, 18.0, 10.0), gaps=(14.0, 17.0))
    for k, (name, box) in enumerate(zip(result.bearing, boxes, strict=False)):
        axes: Any = add_axes(figure, box, projection="polar")
        for style, index in enumerate(picked):
            _rose(axes, result, values[index, k], (index, k), style)
        axes.set_title(f"bearing {name}", fontsize=FONT_SIZE, pad=6.0)
        axes.tick_params(labelsize=FONT_SIZE - 1.5, pad=1.0)
        axes.set_ylim(bottom=min(0.0, np.nanmin(values[picked, k], initial=0.0)))
        _name_circles(axes, result.ball_azimuth[k], values[picked, k])
    caption = f"{what}; y at 0°, z at 90°, seen from +x"
    figure.text(0.02, 0.015, caption, fontsize=FONT_SIZE)
    lines, labels = axes.get_legend_handles_labels()
    figure.legend(
        lines,
        labels,
        loc="lower right",
        bbox_to_anchor=(1.0, LEGEND / height),
        fontsize=FONT_SIZE,
        frameon=False,
        ncols=3,
    )
    return figure


def _name_circles(axes: Any, azimuth: Array, values: Array) -> None:
    """Label circles along the ray that curves reach least, where no curve is near; where all are
    near one, label the circle farthest from them."""
    rays = np.radians(np.arange(22.5, 360.0, 45.0))
    adjacent = np.cos(azimuth[:, None] - rays) > np.cos(np.radians(25.0))  # (balls, rays)
    size = np.nan_to_num(values).max(axis=0)
    ray = rays[np.argmin([size[mask].max(initial=0.0) for mask in adjacent.T])]
    low, high = axes.get_ylim()
    circles = [float(r) for r in axes.get_yticks() if low < r <= high and r != 0.0]
    axes.set_yticks(circles, labels=[""] * len(circles))
    paper: Any = {"boxstyle": "square,pad=0.1", "fc": "white", "ec": "none", "alpha": 0.75}
    look: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": FONT_SIZE - 2.0}
    finite = np.isfinite(azimuth)
    rows = np.nan_to_num(values)[:, finite]
    crossings = [np.interp(ray, azimuth[finite], row, period=2.0 * np.pi) for row in rows]
    gap = {r: min((abs(r - at) for at in crossings), default=high) for r in circles}
    candidates = circles if len(circles) <= MOST_NAMED else circles[1::2]
    clear = [r for r in candidates if gap[r] > CLEAR * (high - low)]
    for r in clear or sorted(circles, key=gap.__getitem__)[-1:]:
        axes.text(ray, r, f"{r:g}", zorder=5, bbox=paper, **look)


def _rose(
    axes: Any, result: BearingLoadsResult, load: Array, at: tuple[int, int], place: int
) -> None:
    index, k = at
    azimuth = result.ball_azimuth[k]
    finite = np.flatnonzero(np.isfinite(load))
    order = finite[np.argsort(azimuth[finite])]
    closed = np.append(order, order[:1])
    axes.plot(
        azimuth[closed],
        load[closed],
        **line_of(place),
        marker="o",
        ms=2.0,
        lw=1.0,
        label=f"{result.speed[index] * RPM.factor:.0f} rpm",
    )
