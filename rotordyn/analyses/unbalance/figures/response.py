"""Figures of the response to unbalance: amplitude, phase, shape of orbits, forces of supports."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.analyses.unbalance.result import UnbalanceResult
from rotordyn.arrays import Array
from rotordyn.figures import stations
from rotordyn.figures.amplitudes import decades, phase_axis, wrapped_phase
from rotordyn.figures.legends import shortened, top_legend
from rotordyn.figures.style import (
    CYCLE,
    FONT_SIZE,
    GREY,
    add_axes,
    grid_boxes,
    line_of,
    marked,
    new_figure,
    speed_ticks,
)
from rotordyn.results.display import MICROMETRE, RPM, number

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ROUND = 1e-6  # of an orbit: tolerance of a circle
DASH = {"y": "-", "z": "--"}
_LETTER = 0.58 * (FONT_SIZE - 1.5) * 25.4 / 72.0  # [mm]: mean width of a letter above the panels


def response_figure(result: UnbalanceResult) -> Figure:
    """Draw amplitude above phase, and above the shape of the orbits where they are no circles.

    Each point has a line, or one for y and one for z where they differ. Critical speeds are marked.
    """
    ellipses = not round_orbits(result)
    rows = 3 if ellipses else 2
    figure = new_figure(168.0, 18.0 + 48.0 * rows)
    boxes = grid_boxes(figure, rows, 1, margins=(17.0, 6.0, 12.0, 14.0), gaps=(0.0, 5.0))
    names = ["amplitude, zero to peak [µm]", "phase lead [deg]", "half axes, backward < 0 [-]"]
    panels = [
        _panel(figure, box, name, result, last=place == rows - 1)
        for place, (box, name) in enumerate(zip(boxes, names, strict=False))
    ]
    moved = result.fine_displacement
    for column, point in enumerate(result.point):
        for axis, letter in enumerate(result.axis if ellipses else result.axis[:1]):
            label = f"{point}.{letter}" if ellipses else point
            look: dict[str, Any] = {
                "color": CYCLE[column % len(CYCLE)],
                "ls": DASH[letter],
                "label": label,
                **marked(column),
            }
            amplitude = np.abs(moved[:, column, axis]) * MICROMETRE.factor
            panels[0].plot(*_positive(result, amplitude), **look)
            phase = wrapped_phase(np.degrees(np.angle(moved[:, column, axis])))
            panels[1].plot(*_rotating(result, phase), **look)
        if ellipses:
            with np.errstate(invalid="ignore", divide="ignore"):
                ratio = result.fine_minor_axis[:, column] / result.fine_major_axis[:, column]
            panels[2].plot(
                *_rotating(result, ratio), color=CYCLE[column % len(CYCLE)], **marked(column)
            )
    decades(panels[0])
    phase_axis(panels[1])
    if ellipses:
        panels[2].set_ylim(-1.08, 1.08)
        panels[2].set_yticks([-1.0, -0.5, 0.0, 0.5, 1.0])
    top_legend(figure, panels[0], above=_criticals(panels, result, boxes[0][2]))
    return figure


def forces_figure(result: UnbalanceResult) -> Figure:
    """Draw the amplitude of the force of every bearing and support."""
    figure = new_figure(168.0, 88.0)
    axes = _panel(figure, (17.0, 12.0, 145.0, 62.0), "force, zero to peak [N]", result, last=True)
    for column, name in enumerate(result.support):
        x, values = _positive(result, result.fine_force_amplitude[:, column])
        axes.plot(x, values, label=name, **line_of(column))
    decades(axes)
    top_legend(figure, axes, above=_criticals([axes], result, 145.0))
    return figure


def round_orbits(result: UnbalanceResult) -> bool:
    """Return whether every orbit is a circle of forward whirl."""
    gap = result.major_axis - result.minor_axis
    with np.errstate(invalid="ignore"):
        return not bool((gap > ROUND * np.nanmax(result.major_axis)).any())


def _panel(
    figure: Figure,
    box: Sequence[float],
    name: str,
    result: UnbalanceResult,
    *,
    last: bool,
) -> Axes:
    label = "speed [rpm]" if result.speed_ratio == 1.0 else "speed of the spindle [rpm]"
    axes = add_axes(figure, box, label if last else "", name)
    axes.tick_params(labelbottom=last)
    speed_ticks(axes, float(result.speed[-1]) * RPM.factor, 8)
    return axes


def _positive(result: UnbalanceResult, values: Array) -> tuple[Array, Array]:
    """Return speeds [rpm] and values, NaN where they have no logarithm."""
    return result.fine_speed * RPM.factor, np.where(values > 0.0, values, np.nan)


def _rotating(result: UnbalanceResult, values: Array) -> tuple[Array, Array]:
    """Return speeds [rpm] and values, NaN at rest."""
    return result.fine_speed * RPM.factor, np.where(result.fine_speed > 0.0, values, np.nan)


def _criticals(panels: Sequence[Axes], result: UnbalanceResult, width: float) -> float:
    """Draw a thin line at every critical speed; above the first panel its value in rpm and Hz, and
    its name where there is room. Return the height of these labels [mm]."""
    rpm = result.critical_speed * RPM.factor
    hertz = rpm / 60.0 * abs(result.speed_ratio)
    for axes in panels:
        for place, speed in enumerate(rpm):
            name = None if place else "critical speed"
            axes.axvline(speed, color=GREY, lw=0.7, ls=":", zorder=1, label=name)
    if not rpm.size:
        return 0.0
    values = list(zip(result.critical, rpm.tolist(), hertz.tolist(), strict=True))
    full = [f"{shortened(n, 20)}\n{s:.0f} rpm\n{number(f)} Hz" for n, s, f in values]
    short = [f"{s:.0f} rpm\n{number(f)} Hz" for _, s, f in values]
    bare = [f"{s:.0f}\n{number(f)}" for _, s, f in values]  # too many: units are at the left
    labels = next((each for each in (full, short) if _width(each) <= width), bare)
    if labels is bare:
        look: dict[str, Any] = dict(ha="right", va="bottom", fontsize=FONT_SIZE - 1.5, color=GREY)
        panels[0].annotate(
            "rpm\nHz", (0.0, 1.0), (-8.0, 2.0), "axes fraction", "offset points", **look
        )
    stations.words_above(panels[0], rpm.tolist(), labels, [_width([x]) for x in labels], width)
    return 1.0 + 3.0 * (1 + max(word.count("\n") for word in labels))


def _width(words: Sequence[str]) -> float:
    """Return the width of labels in a row [mm], by the longest line of each."""
    return sum(max(map(len, word.split("\n"))) * _LETTER + 2.0 for word in words)
