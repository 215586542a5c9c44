"""The dynamic preload state over speed: loads, sleeves, contacts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.analyses.preload.known import preload_sum, sum_words
from rotordyn.analyses.preload.result import PreloadResult
from rotordyn.arrays import Array
from rotordyn.figures.curves import draw_columns, draw_references, merged
from rotordyn.figures.legends import legend, top_legend
from rotordyn.figures.over_speed import four_over_speed
from rotordyn.figures.style import (
    BLUE,
    CYCLE,
    GREY,
    line_of,
    mark_few_points,
    marked,
    with_zero,
)
from rotordyn.machine.limits import WARNING_PRESSURE
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle
from rotordyn.results.display import DEGREE, GIGAPASCAL, MICROMETRE, RPM
from rotordyn.results.headline import LEAST_POINTS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

STOP: Any = {"color": GREY, "lw": 0.9, "ls": ":", "label": "a stop closes"}


def preload_figure(
    result: PreloadResult, spindle: Spindle, references: Sequence[Reference] = ()
) -> Figure:
    """Load per bearing, sum of preloads, axial shifts, forces of springs and stops."""
    total = f"{sum_words(spindle)} [N]"
    labels = "axial load along thrust [N]", total, "axial shift [µm]", "spring and stop force [N]"
    figure, axes = four_over_speed(labels, result.speed)
    rpm = result.speed * RPM.factor
    draw_columns(axes[0], rpm, result.axial_load, result.bearing)
    axes[1].plot(rpm, preload_sum(result, spindle), color=BLUE, label="computed")
    draw_references(axes[1], references, "preload_sum", float(rpm[-1]))
    _shifts(axes[2], result)
    draw_references(axes[2], references, "sleeve_displacement", float(rpm[-1]), subject=True)
    _forces(axes[3], result)
    for place in (0, 1, 3):
        with_zero(axes[place], 1.08)
    _finish(axes, result)
    return figure


def contacts_figure(result: PreloadResult) -> Figure:
    """Contact angles, peak pressures, ball loads and required friction per bearing."""
    figure, axes = four_over_speed(
        ("contact angle [deg]", "peak pressure [GPa]", "ball load [N]", "required friction μ [-]"),
        result.speed,
    )
    giga = GIGAPASCAL.factor
    drawn = [
        [factor * values for values in pair]
        for pair, factor in (
            ((result.inner_angle, result.outer_angle), DEGREE.factor),
            ((result.inner_pressure, result.outer_pressure), giga),
            ((result.inner_load, result.outer_load), 1.0),
            ((result.inner_required_friction, result.outer_required_friction), 1.0),
        )
    ]
    names = merged(result.bearing, *(values for pair in drawn for values in pair))
    for panel, pair in zip(axes, drawn, strict=True):
        _inner_outer(panel, result.speed * RPM.factor, names, pair)
    if np.nanmax(result.outer_pressure * giga, initial=0.0) > 0.8 * WARNING_PRESSURE * giga:
        axes[1].axhline(WARNING_PRESSURE * giga, color=GREY, lw=0.9, ls="--", label="limit 4.2 GPa")
    for panel in axes:
        with_zero(panel, 1.05)
        mark_few_points(panel)
    top_legend(figure, *axes)
    return figure


def _shifts(axes: Axes, result: PreloadResult) -> None:
    """Draw the shift of every body, identical ones once. Where a stop closes between two speeds,
    its sleeve keeps its position from there on, and the lines of other bodies are broken."""
    position = result.position * MICROMETRE.factor
    for name, column in merged(result.body, position):
        body = result.body[column]
        line = result.speed * RPM.factor, position[:, column]
        for place, sleeve in enumerate(result.sleeve):
            line = from_closing(*line, result, place, None if sleeve == body else np.nan)
        axes.plot(*line, label=name, **line_of(column))


def _forces(axes: Axes, result: PreloadResult) -> None:
    """Draw forces of springs solid, of stops dashed, of friction dotted; mark closing speeds."""
    rpm = result.speed * RPM.factor
    for place, name in enumerate(result.sleeve):
        look = {"color": CYCLE[place % len(CYCLE)], **marked(place)}
        spring = from_closing(rpm, result.spring_force[:, place], result, place)
        axes.plot(*spring, label=f"{name}, spring", **look)
        if result.friction_limit[place] > 0.0:
            axes.plot(
                rpm, result.friction_force[:, place], ls=":", label=f"{name}, friction", **look
            )
        if np.isfinite(result.stop_speed[place]):
            stop = from_closing(rpm, result.stop_force[:, place], result, place, 0.0)
            axes.plot(*stop, ls="--", label=f"{name}, stop", **look)
            axes.axvline(float(result.stop_speed[place] * RPM.factor), **STOP)


def from_closing(
    rpm: Array, values: Array, result: PreloadResult, sleeve: int, there: float | None = None
) -> tuple[Array, Array]:
    """Insert the speed at which the stop of a sleeve closes, with the value ``there``; None: the
    value at the next speed, as for its shift and spring force, which then stay constant."""
    closes, speed = float(result.stop_speed[sleeve]), result.speed
    k = int(np.searchsorted(speed, closes))
    inside = 0 < k < len(speed) and speed[k] > closes and len(speed) >= LEAST_POINTS
    if not inside or result.stop_force[k - 1, sleeve] or not result.stop_reached[k, sleeve]:
        return rpm, values
    k = int(np.searchsorted(rpm, closes * RPM.factor))
    value = values[k] if there is None else there
    return np.insert(rpm, k, closes * RPM.factor), np.insert(values, k, value)


def _inner_outer(
    axes: Axes, rpm: Array, names: Sequence[tuple[str, int]], races: Sequence[Array]
) -> None:
    """Draw inner races solid, outer ones dashed, a colour per bearing or identical group."""
    for place, (name, column) in enumerate(names):
        for dash, (race, values) in enumerate(zip(("inner", "outer"), races, strict=True)):
            look = {**line_of(column, dash), **marked(place)}
            axes.plot(rpm, values[:, column], label=f"{name}, {race}", **look)


def _finish(axes: Sequence[Axes], result: PreloadResult) -> None:
    for speed in result.stop_speed[np.isfinite(result.stop_speed)]:
        for panel in axes[:3]:
            panel.axvline(speed * RPM.factor, **STOP)
    for panel in axes:
        mark_few_points(panel)
        legend(panel)
