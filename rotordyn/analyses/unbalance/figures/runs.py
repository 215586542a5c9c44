"""Figures of motion and forces on runs through the speeds, with those of steady rotation."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.analyses.unbalance.result import RUNAWAY, UnbalanceResult
from rotordyn.arrays import Array
from rotordyn.figures.amplitudes import decades
from rotordyn.figures.legends import top_legend
from rotordyn.figures.style import (
    FONT_SIZE,
    GREY,
    add_axes,
    grid_boxes,
    line_of,
    new_figure,
    speed_ticks,
)
from rotordyn.results.display import MICROMETRE, RPM

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST = 4  # panels


def runs_figure(result: UnbalanceResult) -> Figure:
    """Draw the half axis of the orbit over speed on runs, a panel for each of the first points."""
    steady, moved = (
        values * MICROMETRE.factor for values in (result.fine_major_axis, result.run_amplitude)
    )
    return _figure(result, result.point, steady, moved, "half axis of the orbit [µm]")


def run_forces_figure(result: UnbalanceResult) -> Figure:
    """Draw the amplitude of the force of each of the first bearings and supports."""
    steady, pushed = result.fine_force_amplitude, result.run_force
    return _figure(result, result.support, steady, pushed, "force, zero to peak [N]")


def _figure(
    result: UnbalanceResult, names: Sequence[str], steady: Array, moved: Array, label: str
) -> Figure:
    """Draw values in steady rotation (speeds, names) and on runs (runs, speeds, names)."""
    picked = range(min(len(names), MOST))
    figure = new_figure(168.0, 26.0 + 56.0 * len(picked))
    boxes = grid_boxes(figure, len(picked), 1, margins=(17.0, 6.0, 12.0, 9.0), gaps=(0.0, 8.0))
    turns = "" if result.speed_ratio == 1.0 else " of the spindle"
    for place, (box, column) in enumerate(zip(boxes, picked, strict=True)):
        last = place == len(picked) - 1
        axes = add_axes(figure, box, f"speed{turns} [rpm]" * last, label)
        look: Any = {"color": GREY, "lw": 2.2, "label": "steady"}
        axes.plot(result.fine_speed * RPM.factor, _positive(steady[:, column]), **look)
        for k, name in enumerate(result.run):
            if result.run_outcome[k]:
                continue
            values = _positive(moved[k, :, column])
            axes.plot(result.run_speed * RPM.factor, values, label=name, **line_of(k))
        largest = np.nan_to_num(moved[:, :, column]).max(axis=1)
        top = np.nan_to_num(steady[:, column]).max()
        runaway = largest > (RUNAWAY * top or np.inf)
        names_beyond = [f"{result.run[k]} (to {largest[k]:.2g})" for k in np.flatnonzero(runaway)]
        beyond = f", beyond the axis: {', '.join(names_beyond)}" if names_beyond else ""
        more = f" ({len(names) - MOST} more in the table)" if last and len(names) > MOST else ""
        axes.set_title(f"{names[column]}{beyond}{more}", fontsize=FONT_SIZE, pad=3.0)
        decades(axes, max([top, *largest[~runaway]]) if names_beyond else np.inf)
        axes.tick_params(labelbottom=last)
        speed_ticks(axes, float(result.speed[-1]) * RPM.factor, 8)
    top_legend(figure, figure.axes[0])
    return figure


def _positive(size: Array) -> Array:
    """Return sizes, NaN where they have no logarithm."""
    return np.where(size > 0.0, size, np.nan)
