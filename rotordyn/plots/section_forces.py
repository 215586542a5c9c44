"""Diagrams of the section forces along the shaft, and its elastic line with the stresses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.display import MILLIMETRE, RPM
from rotordyn.analysis.result import declared
from rotordyn.analysis.results import SectionForcesResult
from rotordyn.machine.spindle import Spindle
from rotordyn.plots.labels import axis_label, spread
from rotordyn.plots.legends import top_legend
from rotordyn.plots.style import (
    BLACK,
    CYCLE,
    DASHES,
    FONT_SIZE,
    GREY,
    add_axes,
    grid_boxes,
    new_figure,
)

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
ALIKE = 1e-9  # of the largest: nothing that could be seen
_NAMES = 9.0  # [mm] above the panels, for names of stations


class Curve(NamedTuple):
    """A result at one of its speeds, and what the legend calls it."""

    name: str
    result: SectionForcesResult
    row: int

    @property
    def x(self) -> NDArray[np.float64]:
        """Stations [mm]; where a load jumps, twice."""
        return self.result.cut * MILLIMETRE.factor

    def values(self, quantity: str) -> NDArray[np.float64]:
        """A quantity as printed."""
        factor = declared(self.result)[quantity].metadata["printed"].factor
        return np.asarray(getattr(self.result, quantity)[self.row] * factor)


def diagrams_figure(result: SectionForcesResult, spindle: Spindle | None) -> Figure:
    """N, Ty, Tz above Mt, My, Mz over the station, at up to three speeds where they differ."""
    return curves_figure(speeds_shown(result), spindle)


def curves_figure(curves: Sequence[Curve], spindle: Spindle | None) -> Figure:
    """The six diagrams, a line per curve."""
    figure = new_figure(168.0, 112.0)
    margins = (16.0, 4.0, 12.0, 5.0 + _NAMES)
    boxes = grid_boxes(figure, 2, 3, margins=margins, gaps=(15.0, 6.0))
    marks = _stations(curves[0].result, spindle)
    panels = []
    for place, (box, name) in enumerate(zip(boxes, FORCES, strict=True)):
        low = place > 2
        axes = add_axes(figure, box, "station [mm]" if low else "", "")
        _draw(axes, curves, (name,), fill=len(curves) == 1)
        axes.tick_params(labelbottom=low)
        _mark(axes, marks, box[2], named=not low)
        axes.set_ylabel(axis_label(curves[0].result, name), fontsize=FONT_SIZE, labelpad=1.5)
        panels.append(axes)
    if len(curves) > 1:
        top_legend(figure, panels[0])
    return figure


def elastic_line_figure(result: SectionForcesResult, spindle: Spindle | None) -> Figure:
    """Deflections, twist and stresses over the station at the last speed with a solution."""
    curve = speeds_shown(result)[-1]
    figure = new_figure(168.0, 130.0)
    margins = (18.0, 46.0, 12.0, 3.0 + _NAMES)
    boxes = grid_boxes(figure, 3, 1, margins=margins, gaps=(0.0, 5.0))
    names = ("deflection [µm]", "twist θx [deg]", "stress [MPa]")
    marks = _stations(result, spindle)
    for place, (box, quantities, name) in enumerate(zip(boxes, LINES, names, strict=True)):
        axes = add_axes(figure, box, "station [mm]" if place == 2 else "", name)
        _draw(axes, [curve], quantities, fill=False)
        axes.tick_params(labelbottom=place == 2)
        _mark(axes, marks, box[2], named=place == 0)
        if len(quantities) > 1:
            axes.legend(
                loc="upper left", bbox_to_anchor=(1.01, 1.0), frameon=False, fontsize=FONT_SIZE - 1
            )
    return figure


def speeds_shown(result: SectionForcesResult) -> list[Curve]:
    """First, middle and last speed with a solution; one where all are alike."""
    rows = np.flatnonzero(np.isfinite(result.torque).all(axis=1))
    picked = rows[np.unique(np.linspace(0, rows.size - 1, SPEEDS).round().astype(int))]
    if all(_alike(getattr(result, name)[picked]) for name in FORCES):
        picked = picked[-1:]
    return [Curve(f"{result.speed[k] * RPM.factor:.0f} rpm", result, int(k)) for k in picked]


def _alike(values: NDArray[np.float64]) -> bool:
    return float(np.ptp(values, axis=0).max()) <= ALIKE * float(np.abs(values).max())


def _draw(axes: Axes, curves: Sequence[Curve], quantities: Sequence[str], *, fill: bool) -> None:
    """Broken lines through both ends of every element: jumps come out upright."""
    axes.axhline(0.0, color=BLACK, lw=0.7)
    largest = 0.0
    for place, (curve, quantity) in enumerate((c, q) for c in curves for q in quantities):
        values = curve.values(quantity)
        label = declared(curve.result)[quantity].metadata["label"]
        look: Mapping[str, Any] = {
            "color": CYCLE[place % len(CYCLE)],
            "ls": DASHES[place % len(DASHES)],
            "label": label if len(quantities) > 1 else curve.name,
        }
        axes.plot(curve.x, values, **look)
        if fill:
            axes.fill_between(curve.x, values, color=CYCLE[0], alpha=0.12, lw=0.0)
        largest = max(largest, float(np.abs(values).max()))
    low, high = axes.dataLim.y0, axes.dataLim.y1
    room = 0.08 * (high - low) if largest > 0.0 else 1.0
    axes.set(xlim=(curves[0].x[0], curves[0].x[-1]), ylim=(low - room, high + room))


def _stations(result: SectionForcesResult, spindle: Spindle | None) -> list[tuple[float, str]]:
    """What holds the shaft and named points [mm]; names at one station share it."""
    named: dict[float, list[str]] = {}
    for name, x in zip(result.support, result.support_station, strict=True):
        named.setdefault(round(float(x) * 1e3, 6), []).append(name)
    for name, x in (spindle.points if spindle else {}).items():
        names = named.setdefault(round(x * 1e3, 6), [])
        if name not in names:
            names.append(name)
    return [(x, ", ".join(names)) for x, names in sorted(named.items())]


def _mark(axes: Axes, marks: Sequence[tuple[float, str]], wide: float, *, named: bool) -> None:
    """A thin line at every station, its name above the panel, upright where many are."""
    left, right = axes.get_xlim()
    for x, _ in marks:
        axes.axvline(x, color=GREY, lw=0.6, ls=":", zorder=1)
    if not named:
        return
    per_mm = (right - left) / wide
    tall = FONT_SIZE * 25.4 / 72.0 * per_mm
    flat = [len(name) * 0.5 * tall + 1.5 * per_mm for _, name in marks]
    upright = sum(flat) > right - left
    sizes = [tall] * len(marks) if upright else flat
    places = spread([x for x, _ in marks], sizes, left, right)
    for place, (_, name) in zip(places, marks, strict=True):
        axes.annotate(
            name,
            (float(place), 1.0),
            (0.0, 2.0),
            xycoords=("data", "axes fraction"),
            textcoords="offset points",
            ha="center",
            va="bottom",
            rotation=90.0 if upright else 0.0,
            fontsize=FONT_SIZE - 1.5,
            color=GREY,
        )
