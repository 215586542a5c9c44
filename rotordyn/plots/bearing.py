"""A single bearing over load and speed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.display import DEGREE, GIGAPASCAL, RPM, STIFFNESS
from rotordyn.analysis.results import BearingMapResult
from rotordyn.plots.legends import legend, top_legend
from rotordyn.plots.style import CYCLE, DASHES, add_axes, grid_boxes, new_figure, speed_ticks

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def bearing_figure(result: BearingMapResult) -> Figure:
    """Axial and radial stiffness, contact angles and peak pressures, a colour per axial load."""
    figure = new_figure(168.0, 118.0)
    own = "" if result.tangent[0] == "complete" else f", {result.tangent[0]}"
    names = [f"stiffness Kxx{own} [N/µm]", f"stiffness Kyy{own} [N/µm]"]
    names += ["contact angle [deg]", "peak pressure [GPa]"]
    boxes = grid_boxes(figure, 2, 2, margins=(15.0, 6.0, 12.0, 8.0), gaps=(18.0, 5.0))
    axes = [
        add_axes(figure, box, "speed [rpm]" if place > 1 else "", name)
        for place, (box, name) in enumerate(zip(boxes, names, strict=True))
    ]
    stiffness = result.stiffness * STIFFNESS.factor
    _per_load(axes[0], result, _entry(result, stiffness, "x"), label=True)
    _per_load(axes[1], result, _entry(result, stiffness, "y"))
    for place, (inner, outer), factor in (
        (2, (result.inner_angle, result.outer_angle), DEGREE.factor),
        (3, (result.inner_pressure, result.outer_pressure), GIGAPASCAL.factor),
    ):
        _per_load(axes[place], result, inner * factor)
        _per_load(axes[place], result, outer * factor, dash=1)
    for place, each in enumerate(axes):
        speed_ticks(each, float(result.speed[-1] * RPM.factor))
        each.tick_params(labelbottom=place > 1)
        each.set_ylim(0.0, each.get_ylim()[1] * 1.05)
    for dash, race in enumerate(("inner race", "outer race")):
        axes[2].plot([], [], color="#444444", ls=DASHES[dash], label=race)
    top_legend(figure, axes[0])
    legend(axes[2], loc="lower left")
    return figure


def _entry(
    result: BearingMapResult, stiffness: NDArray[np.float64], freedom: str
) -> NDArray[np.float64]:
    at = result.dof.index(freedom)
    return np.asarray(stiffness[:, :, 0, at, result.dof_other.index(freedom)])


def _per_load(
    axes: Axes,
    result: BearingMapResult,
    values: NDArray[np.float64],
    *,
    dash: int = 0,
    label: bool = False,
) -> None:
    for place, load in enumerate(result.load):
        axes.plot(
            result.speed * RPM.factor,
            values[:, place],
            color=CYCLE[place % len(CYCLE)],
            ls=DASHES[dash],
            label=f"{load:g} N axial" if label else None,
        )
