"""Life, safety, heat and films over speed, a line per bearing or group of identical ones."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.analyses.life.result import HOUR, LifeResult
from rotordyn.arrays import Array
from rotordyn.figures.amplitudes import log_axis
from rotordyn.figures.curves import merged
from rotordyn.figures.legends import top_legend
from rotordyn.figures.over_speed import four_over_speed
from rotordyn.figures.style import (
    GREY,
    line_of,
    mark_few_points,
    marked,
    with_zero,
)
from rotordyn.results.display import GIGAPASCAL, RPM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def life_figure(result: LifeResult) -> Figure:
    """Reference life, static safety, peak pressure, ball orders of the defects."""
    names = ("life L10r [h]", "static safety S0 [-]", "peak pressure [GPa]", "cage over speed [-]")
    figure, axes = four_over_speed(names, result.speed)
    pressure = result.pressure * GIGAPASCAL.factor
    _lines(axes, result, [result.life / HOUR, result.static_safety, pressure, result.cage])
    if np.isfinite(result.target):
        axes[0].axhline(result.target / HOUR, color=GREY, lw=0.9, ls="--", label="target")
    log_axis(axes[0])
    for panel in axes[1:3]:
        with_zero(panel, 1.05)
    top_legend(figure, *axes)
    return figure


def heat_figure(result: LifeResult) -> Figure:
    """Heat of contacts and oil, film, viscosity ratio and modified life."""
    names = ("heat [W]", "of it in contacts [W]", "film h_min [nm]", "modified life [h]")
    figure, axes = four_over_speed(names, result.speed)
    contacts, film = result.inner_heat + result.outer_heat, result.film * 1e9
    _lines(axes, result, [result.heat, contacts, film, result.modified_life / HOUR])
    log_axis(axes[3])
    for panel in axes[:3]:
        with_zero(panel, 1.05)
    top_legend(figure, *axes)
    return figure


def temperature_figure(result: LifeResult) -> Figure:
    """Temperatures of balls and rings, and the life at these."""
    parts = {"balls": "ball", "inner ring": "inner", "outer ring": "outer"}
    names = [f"temperature, {part} [°C]" for part in parts]
    figure, axes = four_over_speed([*names, "life L10r [h]"], result.speed)
    degrees = [getattr(result, f"{name}_temperature") for name in parts.values()]
    _lines(axes, result, [*degrees, result.life / HOUR])
    for panel in axes[:3]:
        with_zero(panel, 1.05)
    log_axis(axes[3])
    top_legend(figure, *axes)
    return figure


def _lines(panels: Sequence[Axes], result: LifeResult, drawn: Sequence[Array]) -> None:
    """Draw a line per bearing in each panel; bearings identical in all panels share one."""
    rpm = result.speed * RPM.factor
    for axes, values in zip(panels, drawn, strict=True):
        shown = np.where(np.isfinite(values), values, np.nan)
        for place, (name, column) in enumerate(merged(result.bearing, *drawn)):
            look = {**line_of(column, place), **marked(place)}
            axes.plot(rpm, shown[:, column], label=name, **look)
        mark_few_points(axes)
