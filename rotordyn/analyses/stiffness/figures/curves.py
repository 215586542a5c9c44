"""Radial stiffness of a point in its variants."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.analyses.stiffness.result import StiffnessResult
from rotordyn.figures.curves import draw_columns, draw_references
from rotordyn.figures.legends import legend
from rotordyn.figures.style import (
    CYCLE,
    FONT_SIZE,
    GREY,
    add_axes,
    evenly,
    grid_boxes,
    line_of,
    mark_few_points,
    new_figure,
    speed_ticks,
)
from rotordyn.machine.reference import Reference
from rotordyn.results.display import MICROMETRE, RPM, STIFFNESS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

STOP: Any = {"color": GREY, "lw": 0.9, "ls": ":", "zorder": 1.0}
APART, BESIDE = 0.06, 0.68  # of the height and width of axes: labels of lost contacts


def stiffness_figure(
    result: StiffnessResult, references: Sequence[Reference] = (), point: str = ""
) -> Figure:
    """Tangent stiffness at no load over speed, a line per variant."""
    figure = new_figure(168.0, 100.0)
    where = f" at {point}" if point else ""
    axes = add_axes(
        figure, (15.0, 11.0, 147.0, 84.0), "speed [rpm]", f"radial stiffness{where} [N/µm]"
    )
    rpm, tangent = result.curves[0] * RPM.factor, result.curves[1]
    speed_ticks(axes, float(rpm[-1]))
    names = [name.replace("_", " ") for name in result.variant]
    draw_columns(axes, rpm, tangent * STIFFNESS.factor, names)
    for k, closing in enumerate(result.stop_speed[::2]):
        axes.axvline(float(closing * RPM.factor), label="" if k else "a stop closes", **STOP)
    colours = {name: CYCLE[k % len(CYCLE)] for k, name in enumerate(result.variant)}
    mark_few_points(axes)
    draw_references(
        axes, references, "radial_stiffness", float(rpm[-1]), subject=True, colours=colours
    )
    axes.set_ylim(0.0, axes.get_ylim()[1] * 1.05)
    legend(axes, loc="lower left")
    return figure


def force_figure(result: StiffnessResult, point: str = "", speeds: int = 3) -> Figure:
    """Deflection under force at the first, the middle and the last speed with a state, a line per
    variant.

    Marks on the line of the full bearing model: balls that lose their contact there.
    """
    figure = new_figure(168.0, 80.0)
    solved = np.flatnonzero(np.isfinite(result.deflection).any(axis=(1, 2)))
    picked = solved[evenly(solved.size, speeds)]
    boxes = grid_boxes(figure, 1, len(picked), margins=(15.0, 6.0, 12.0, 9.0), gaps=(6.0, 0.0))
    largest = float(np.nanmax(result.deflection[picked])) * MICROMETRE.factor
    where = f" at {point}" if point else ""
    for place, (index, box) in enumerate(zip(picked, boxes, strict=True)):
        label = "" if place else f"radial force{where} [N]"
        axes = add_axes(figure, box, f"deflection{where} [µm]", label)
        for variant, name in enumerate(result.variant):
            axes.plot(
                result.deflection[index, variant] * MICROMETRE.factor,
                result.force,
                label=name.replace("_", " "),
                **line_of(variant),
            )
        axes.set(xlim=(0.0, largest * 1.04), ylim=(0.0, float(result.force[-1])))
        _contact_losses(axes, result, index)
        axes.tick_params(labelleft=not place)
        axes.set_title(f"{result.speed[index] * RPM.factor:.0f} rpm", fontsize=FONT_SIZE, pad=4.0)
        if place == len(picked) - 1:
            legend(axes, loc="lower right")
    return figure


def _contact_losses(axes: Axes, result: StiffnessResult, index: int) -> None:
    """Mark where the first ball of each bearing loses contact, with its number, if the curve of the
    full bearing model is drawn; labels are to the right of the curves or below them, in the order
    of forces, with legible spacing."""
    if "nonlinear" not in result.variant:
        return
    force = result.unloading_force[index]
    height = 0.0
    for k in [k for k in np.argsort(force) if np.isfinite(force[k])]:
        curve = result.deflection[index, result.variant.index("nonlinear")]
        x = float(np.interp(force[k], result.force, curve)) * MICROMETRE.factor
        axes.plot(x, force[k], color=CYCLE[0], marker="o", ms=3.0, mfc="white", zorder=3.0)
        height = max(float(force[k] / result.force[-1]), height + APART)
        axes.annotate(
            f"{result.bearing[k]}: ball {result.unloaded_ball[index, k]:.0f}",
            xy=(x, force[k]),
            xytext=(BESIDE, height - (0.5 if x < 0.5 * axes.get_xlim()[1] else 2.5) * APART),
            textcoords="axes fraction",
            va="center",
            fontsize=0.85 * FONT_SIZE,
            arrowprops={"arrowstyle": "-", "lw": 0.4, "color": CYCLE[0], "relpos": (0.0, 0.5)},
        )
