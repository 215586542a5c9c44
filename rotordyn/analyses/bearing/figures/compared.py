"""A single bearing in variants over speed: stiffness, pressure, life, required friction, heat."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.bearing.result import BearingMapResult
from rotordyn.analyses.bearing.solve import under
from rotordyn.figures.amplitudes import log_axis
from rotordyn.figures.legends import top_legend
from rotordyn.figures.panels import Shown, colour, dash
from rotordyn.figures.style import BLACK, add_axes, grid_boxes, new_figure, speed_ticks
from rotordyn.results.display import GIGAPASCAL, RPM, STIFFNESS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Panel = tuple[str, NDArray[np.float64]]


def bearing_figure(variants: Sequence[Shown]) -> Figure:
    """A colour per variant, dashes by load: what stands beside the stiffness of a choice."""
    figure = new_figure(168.0, 150.0)
    boxes = grid_boxes(figure, 3, 2, margins=(15.0, 6.0, 12.0, 12.0), gaps=(18.0, 8.0))
    oiled = all(np.isfinite(v.result.viscous_heat).any() for v in variants)
    panels = [_panels(variant.result, oiled) for variant in variants]
    for row, box in enumerate(boxes):
        axes = add_axes(figure, box, "speed [rpm]" if row > 3 else "", panels[0][row][0])
        for place, variant in enumerate(variants):
            _lines(axes, variant, panels[place][row][1], place)
        _named_loads(axes, variants[0].result)
        speed_ticks(axes, float(variants[0].result.speed[-1] * RPM.factor), 4)
        axes.tick_params(labelbottom=row > 3)
        if row == 3:
            log_axis(axes)
        else:
            axes.set_ylim(0.0, axes.get_ylim()[1] * 1.05)
    top_legend(figure, *figure.axes)
    return figure


def _panels(result: BearingMapResult, oiled: bool) -> list[Panel]:
    """Labels and values (speeds, loads)."""
    stiffness = result.stiffness[:, :, 0] * STIFFNESS.factor
    heat = result.contact_heat + result.viscous_heat
    return [
        ("stiffness Kxx [N/µm]", stiffness[..., 0, 0]),
        ("stiffness Kyy [N/µm]", stiffness[..., 1, 1]),
        (
            "peak pressure [GPa]",
            np.fmax(result.inner_pressure, result.outer_pressure) * GIGAPASCAL.factor,
        ),
        ("life L10r [1e6 revolutions]", result.revolutions * 1e-6),
        ("required friction μ [-]", np.fmax(result.inner_grip, result.outer_grip)),
        ("heat [W]", heat) if oiled else ("static safety S0 [-]", result.static_safety),
    ]


def _lines(axes: Axes, variant: Shown, values: NDArray[np.float64], place: int) -> None:
    rpm, several = variant.result.speed * RPM.factor, values.shape[1] > 1
    for column, curve in enumerate(values.T):
        look = dash(column if several else place)
        axes.plot(rpm, curve, color=colour(place), ls=look, label=variant.title)


def _named_loads(axes: Axes, result: BearingMapResult) -> None:
    if len(result.load) > 1:
        for column in range(len(result.load)):
            axes.plot([], [], color=BLACK, ls=dash(column), label=under(result, column, " axial"))
