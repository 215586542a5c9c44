"""Diagrams of the section forces along the shaft, and its elastic line with the stresses."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from rotordyn.analyses.section_forces.result import SectionForcesResult
from rotordyn.arrays import Array
from rotordyn.figures import stations
from rotordyn.figures.labels import axis_label
from rotordyn.figures.legends import shortened, top_legend
from rotordyn.figures.style import (
    BLACK,
    CYCLE,
    FONT_SIZE,
    add_axes,
    evenly,
    grid_boxes,
    line_of,
    new_figure,
)
from rotordyn.machine.spindle import Spindle
from rotordyn.results.declaration import declared
from rotordyn.results.display import MILLIMETRE, RPM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FORCES = (
    "normal_force",
    "shear_force_y",
    "shear_force_z",
    "torque",
    "bending_moment_y",
    "bending_moment_z",
)
LINES = (
    ("deflection_y", "deflection_z"),
    ("twist",),
    ("normal_stress", "torsion_stress", "von_mises_stress"),
)
SPEEDS = 3
ALIKE = 1e-9  # of the largest: smaller differences are invisible
_LONGEST = 16  # letters of a name
_LEGEND = 6.0  # [mm] above the names


class Curve(NamedTuple):
    """A result at one of its speeds, with its name in the legend."""

    name: str
    result: SectionForcesResult
    row: int

    @property
    def x(self) -> Array:
        """Stations [mm] of both ends of every element, so that values may jump at a node."""
        return self.result.cut * MILLIMETRE.factor

    def values(self, quantity: str) -> Array:
        """Values in printed units; a twist of no more than rounding of the deflection is zero."""
        factor = declared(self.result)[quantity].metadata["printed"].factor
        values = getattr(self.result, quantity)[self.row] * factor
        if quantity == "twist":
            bent = np.hypot(*(getattr(self.result, name)[self.row] for name in LINES[0]))
            arc = np.abs(self.result.twist[self.row]) * np.ptp(self.result.cut)
            values = np.where(arc > ALIKE * bent.max(), values, 0.0)
        return np.asarray(values)


def diagrams_figure(result: SectionForcesResult, spindle: Spindle | None) -> Figure:
    """Draw N, Ty, Tz above Mt, My, Mz over the station, at up to three speeds if they differ."""
    return curves_figure(speeds_shown(result), spindle)


def curves_figure(curves: Sequence[Curve], spindle: Spindle | None) -> Figure:
    """The six diagrams, a line per curve."""
    marks, x = stations_of(curves[0].result, spindle), curves[0].x
    upright = stations.upright(marks, 39.0, float(x[0]), float(x[-1]))
    top = stations.room(marks, upright) + (_LEGEND if len(curves) > 1 else 0.0)
    figure = new_figure(168.0, 97.0 + top)
    boxes = grid_boxes(figure, 2, 3, margins=(16.0, 4.0, 12.0, top), gaps=(15.0, 6.0))
    panels = []
    for place, (box, name) in enumerate(zip(boxes, FORCES, strict=True)):
        low = place > 2
        axes = add_axes(figure, box, "station [mm]" if low else "", "")
        _draw(axes, curves, (name,), fill=len(curves) == 1)
        axes.tick_params(labelbottom=low)
        stations.mark(axes, marks)
        if not low:
            stations.name(axes, marks, box[2], upright)
        axes.set_ylabel(axis_label(curves[0].result, name), fontsize=FONT_SIZE, labelpad=1.5)
        panels.append(axes)
    if len(curves) > 1:
        top_legend(figure, panels[0])
    return figure


def elastic_line_figure(result: SectionForcesResult, spindle: Spindle | None) -> Figure:
    """Deflections, twist and stresses over the station at the last speed with a solution."""
    curve = speeds_shown(result)[-1]
    marks = stations_of(result, spindle)
    upright = stations.upright(marks, 104.0, float(curve.x[0]), float(curve.x[-1]))
    top = stations.room(marks, upright)
    figure = new_figure(168.0, 118.0 + top)
    boxes = grid_boxes(figure, 3, 1, margins=(18.0, 46.0, 12.0, top), gaps=(0.0, 5.0))
    names = ("deflection [µm]", "twist θx [deg]", "stress [MPa]")
    for place, (box, quantities, name) in enumerate(zip(boxes, LINES, names, strict=True)):
        axes = add_axes(figure, box, "station [mm]" if place == 2 else "", name)
        _draw(axes, [curve], quantities, fill=False)
        axes.tick_params(labelbottom=place == 2)
        stations.mark(axes, marks)
        if place == 0:
            stations.name(axes, marks, box[2], upright)
        if len(quantities) > 1:
            axes.legend(
                loc="upper left",
                bbox_to_anchor=(1.01, 1.0),
                frameon=False,
                fontsize=FONT_SIZE - 1.0,
                title=curve.name if result.speed.size > 1 and place == 0 else None,
                title_fontsize=FONT_SIZE - 1.0,
            )
    return figure


def speeds_shown(result: SectionForcesResult) -> list[Curve]:
    """First, middle and last speed with a solution; the last alone where all are equal."""
    rows = np.flatnonzero(np.isfinite(result.torque).all(axis=1))
    picked = rows[evenly(rows.size, SPEEDS)]
    if all(_equal(getattr(result, name)[picked]) for name in FORCES):
        picked = picked[-1:]
    return [Curve(f"{result.speed[k] * RPM.factor:.0f} rpm", result, int(k)) for k in picked]


def _equal(values: Array) -> bool:
    return float(np.ptp(values, axis=0).max()) <= ALIKE * float(np.abs(values).max())


def _draw(axes: Axes, curves: Sequence[Curve], quantities: Sequence[str], *, fill: bool) -> None:
    """Draw polylines through both ends of every element, which makes jumps vertical."""
    axes.axhline(0.0, color=BLACK, lw=0.7)
    largest = 0.0
    for place, (curve, quantity) in enumerate((c, q) for c in curves for q in quantities):
        values = curve.values(quantity)
        label = declared(curve.result)[quantity].metadata["label"]
        name = label if len(quantities) > 1 else curve.name
        axes.plot(curve.x, values, label=name, **line_of(place))
        if fill:
            axes.fill_between(curve.x, values, color=CYCLE[0], alpha=0.12, lw=0.0)
        largest = max(largest, float(np.abs(values).max()))
    low, high = axes.dataLim.y0, axes.dataLim.y1
    room = 0.08 * (high - low) if largest > 0.0 else 1.0
    axes.set(xlim=(curves[0].x[0], curves[0].x[-1]), ylim=(low - room, high + room))


def stations_of(result: SectionForcesResult, spindle: Spindle | None) -> list[stations.Mark]:
    """Stations [mm] of supports, joints and named points; names at one station are joined."""
    by_station: dict[float, list[str]] = {}
    for name, x in zip(result.support, result.support_station, strict=True):
        by_station.setdefault(round(float(x) * 1e3, 6), []).append(name)
    joints = {joint.name: joint.x for joint in spindle.joints} if spindle else {}
    for name, x in (joints | dict(spindle.points) if spindle else {}).items():
        names = by_station.setdefault(round(x * 1e3, 6), [])
        if name not in names:
            names.append(name)
    return [(x, shortened(", ".join(names), _LONGEST)) for x, names in sorted(by_station.items())]
