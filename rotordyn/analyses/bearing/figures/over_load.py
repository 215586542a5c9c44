"""Curves of a single bearing over load and speed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.analyses.bearing.result import BearingMapResult, along_load, longest, motion
from rotordyn.analyses.bearing.solve import mounted_under
from rotordyn.arrays import Array
from rotordyn.figures.amplitudes import log_axis
from rotordyn.figures.curves import draw_runs
from rotordyn.figures.labels import axis_label
from rotordyn.figures.legends import legend, top_legend
from rotordyn.figures.over_speed import four_over_speed
from rotordyn.figures.style import (
    BLACK,
    DASHES,
    FONT_SIZE,
    add_axes,
    grid_boxes,
    line_of,
    marked,
    new_figure,
    speed_ticks,
    with_zero,
)
from rotordyn.results.display import DEGREE, GIGAPASCAL, RPM, STIFFNESS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def bearing_figure(result: BearingMapResult) -> Figure:
    """Draw axial and radial stiffness, contact angles and peak pressures over speed, per load.

    Where speeds are few, curves run over load. Angles and pressures are those of the most loaded
    ball where balls differ; with several contacts a race, the angle is that of their resultant.
    """
    kind = "" if result.tangent[0] == "complete" else f", {result.tangent[0]}"
    suffix = ", most loaded ball" if result.ball.size > 1 else ""
    names = [f"stiffness Kxx{kind} [N/µm]", f"stiffness Kyy{kind} [N/µm]"]
    angle = "contact angle" if len(result.contact) == 2 else "resultant angle"
    names += [f"{angle}{suffix} [deg]", f"peak pressure{suffix} [GPa]"]
    figure, axes = _panels(names, result)
    stiffness = result.stiffness * STIFFNESS.factor
    _curves(axes[0], result, _entry(result, stiffness, "x"), label=True)
    _curves(axes[1], result, _entry(result, stiffness, "y"))
    for k, (inner, outer), factor in (
        (2, (result.inner_angle, result.outer_angle), DEGREE.factor),
        (3, (result.inner_pressure, result.outer_pressure), GIGAPASCAL.factor),
    ):
        _curves(axes[k], result, inner * factor, of_ball=True)
        _curves(axes[k], result, outer * factor, dash=1, of_ball=True)
    for panel in axes:
        low, high = panel.get_ylim()
        panel.set_ylim(min(0.0, low), high * 1.05)
    for dash, race in enumerate(("inner race", "outer race")):
        axes[2].plot([], [], color="#444444", ls=DASHES[dash], label=race)
    top_legend(figure, axes[0])
    legend(axes[2], loc="lower left")
    return figure


def motion_figure(result: BearingMapResult) -> Figure:
    """Draw deflection, half-length of the contact ellipse, centrifugal force, gyroscopic moment."""
    name, unit, deflection = motion(result)
    names = [f"{name} [{unit}]", "half-length of the ellipse [mm]"]
    names += ["centrifugal force [N]", "gyroscopic moment [N·mm]"]
    figure, axes = _panels(names, result)
    _curves(axes[0], result, deflection, label=True)
    _curves(axes[1], result, longest(result) * 1e3)
    _curves(axes[2], result, result.centrifugal_force, of_ball=True)
    _curves(axes[3], result, result.gyroscopic_moment * 1e3, of_ball=True)
    axes[0].axhline(0.0, color=BLACK, lw=0.6)
    for panel in axes[1:]:
        with_zero(panel, 1.05)
    top_legend(figure, axes[0])
    return figure


def life_figure(result: BearingMapResult) -> Figure:
    """Draw life, inclination β of balls, required friction, and heat or static safety."""
    with_oil = np.isfinite(result.viscous_heat).any()
    names = ["life L10r [1e6 revolutions]", "inclination β [deg]", "required friction μ [-]"]
    names += ["heat, order of magnitude [W]" if with_oil else "static safety S0 [-]"]
    figure, axes = _panels(names, result)
    last = result.contact_heat + result.viscous_heat if with_oil else result.static_safety
    _curves(axes[0], result, result.revolutions * 1e-6, label=True)
    _curves(axes[1], result, result.attitude * DEGREE.factor, of_ball=True)
    friction = np.fmax(result.inner_required_friction, result.outer_required_friction)
    _curves(axes[2], result, friction, of_ball=True)
    _curves(axes[3], result, last)
    log_axis(axes[0])
    for panel in axes[2:]:
        with_zero(panel, 1.05)
    top_legend(figure, axes[0])
    return figure


def heat_figure(result: BearingMapResult) -> Figure:
    """Draw temperatures, operating load and heat of a warm bearing, and its speed limit."""
    names = ["temperature [°C]", "axial load in operation [N]", "heat, order of magnitude [W]"]
    figure, axes = _beside_limit([*names, "speed limit [rpm]"], result)
    _curves(axes[0], result, result.ball_temperature)
    _curves(axes[0], result, result.inner_temperature, dash=1)
    _curves(axes[0], result, result.outer_temperature, dash=2)
    _curves(axes[1], result, result.axial_force, label=True)
    _curves(axes[2], result, result.contact_heat + result.viscous_heat)
    limit = result.speed_limit * RPM.factor
    axes[3].plot(result.load, limit, color=BLACK, lw=1.0, **marked(0))
    axes[3].set_xlim(0.0, float(result.load[-1]) * 1.08)
    top = float(result.speed[-1] * RPM.factor)
    if not np.isfinite(limit).any():
        axes[3].text(
            *(0.5, 0.5, f"none up to {top:.0f} rpm"),
            transform=axes[3].transAxes,
            ha="center",
            fontsize=FONT_SIZE - 1.0,
        )
        axes[3].set_ylim(0.0, top)
    for panel in axes[1:]:
        with_zero(panel, 1.05)
    for dash, part in enumerate(("balls", "inner ring", "outer ring")):
        axes[0].plot([], [], color="#444444", ls=DASHES[dash], label=part)
    top_legend(figure, axes[1])
    legend(axes[0], loc="upper left")
    return figure


def _panels(names: Sequence[str], result: BearingMapResult) -> tuple[Figure, list[Axes]]:
    """Return four panels over speed, or over load."""
    loads = axis_label(result, "load") if along_load(result) else ""
    return four_over_speed(names, result.speed, loads)


def _beside_limit(names: Sequence[str], result: BearingMapResult) -> tuple[Figure, list[Axes]]:
    """Return four panels, the last one over load in any case."""
    if along_load(result):
        return _panels(names, result)
    figure = new_figure(168.0, 126.0)
    boxes = grid_boxes(figure, 2, 2, margins=(15.0, 6.0, 12.0, 8.0), gaps=(18.0, 13.0))
    x_labels = [*["speed [rpm]"] * 3, axis_label(result, "load")]
    axes = [add_axes(figure, *panel) for panel in zip(boxes, x_labels, names, strict=True)]
    for panel in axes[:3]:
        speed_ticks(panel, float(result.speed[-1] * RPM.factor))
    return figure, axes


def _entry(result: BearingMapResult, stiffness: Array, dof: str) -> Array:
    at = result.dof.index(dof)
    return np.asarray(stiffness[:, :, 0, at, result.dof_other.index(dof)])


def _curves(
    axes: Axes,
    result: BearingMapResult,
    values: Array,
    *,
    of_ball: bool = False,
    dash: int = 0,
    label: bool = False,
) -> None:
    """Draw curves over speed by load, or over load by speed; ``of_ball``: of the most loaded."""
    rpm = result.speed * RPM.factor
    ball = result.loaded_ball if of_ball else np.zeros_like(result.loaded_ball)
    if along_load(result):
        for row, speed in enumerate(rpm):
            name = f"{speed:.0f} rpm" if label else None
            look = {**line_of(row, dash), **marked(row)}
            draw_runs(axes, result.load, values[row], ball[row], label=name, **look)
        return
    for column in range(result.load.size):
        name = mounted_under(result, column, " axial") if label else None
        look = {**line_of(column, dash), **marked(column)}
        draw_runs(axes, rpm, values[:, column], ball[:, column], label=name, **look)
