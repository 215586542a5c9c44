"""Mode shapes in the plane, at rest and at top speed, as small multiples."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.figures.sketch import Sketch
from rotordyn.figures.style import (
    BLACK,
    BLUE,
    FONT_SIZE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    RED,
    add_axes,
    grid_boxes,
    new_figure,
    round_ticks,
)
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.results.display import RPM, number

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST = 9
MOST_PIECES = 300  # of a shaft, as wide as a line
_COLUMNS = 3
_COLOURS = (BLUE, GREEN, PURPLE, ORANGE)  # of the rotors
_MOTION = {"bending": ("y", "z"), "axial": ("x",), "torsion": ("thx",)}


def shapes_figure(result: CampbellResult, spindle: Spindle | None = None) -> Figure:
    """A panel per mode: the shape at the first and the last speed over the shaft's outline."""
    modes = _chosen(result)
    rows = max(math.ceil(len(modes) / _COLUMNS), 1)
    low, high = result.shape_speed[[0, -1]] * RPM.factor
    left_out = len(result.mode) - len(modes)
    modes_left = "mode" if left_out == 1 else "modes"
    note = f"; {left_out} more {modes_left} in the results file" if left_out else ""
    both = f"{low:.0f} rpm (thin) and {high:.0f} rpm (thick)"
    when = both if result.shape_speed.size > 1 else f"{low:.0f} rpm"
    title = f"mode shapes at {when}, scaled to 1{note}"
    several = 6.0 if len(result.rotor) > 1 else 0.0  # [mm] for their names
    height = 26.0 + several + 30.0 * rows
    figure = new_figure(168.0, height, title)
    margins = (9.0, 4.0, 12.0, 13.0 + several)
    boxes = grid_boxes(figure, rows, _COLUMNS, margins=margins, gaps=(6.0, 7.0))
    for place, (mode, box) in enumerate(zip(modes, boxes, strict=False)):
        last_row = place + _COLUMNS >= len(modes)
        axes = add_axes(figure, box, "x [mm]" if last_row else "")
        _panel(axes, result, mode, spindle)
        axes.tick_params(labelbottom=last_row, labelleft=place % _COLUMNS == 0)
    if modes and several:
        figure.legend(
            *figure.axes[0].get_legend_handles_labels(),
            loc="center",
            bbox_to_anchor=(0.5, 1.0 - 10.0 / height),
            ncols=len(result.rotor),
            frameon=False,
            fontsize=FONT_SIZE - 0.5,
        )
    return figure


def plane_curve(shape: NDArray[np.complex128]) -> NDArray[np.float64]:
    """The deflected line at the instant of largest motion, shape (node,), for (node, freedom).

    The freedom that moves most is shown; its sign is that of the largest displacement: positive.
    """
    node, freedom = np.unravel_index(int(np.argmax(np.abs(shape))), shape.shape)
    peak = shape[node, freedom]
    if not np.isfinite(peak) or peak == 0.0:
        return np.zeros(len(shape))
    return np.asarray((shape[:, freedom] * np.conj(peak) / np.abs(peak) ** 2).real)


def _chosen(result: CampbellResult) -> list[int]:
    """The modes shown: those with a shape, lowest first; of a whirling pair both when they fit."""
    has_shape = np.asarray(np.isfinite(result.shape).any(axis=(0, 2, 3)))
    known = [k for k in range(len(result.mode)) if has_shape[k] and not result.mostly_overdamped[k]]
    known.sort(key=lambda k: float(np.nan_to_num(result.frequency[0, k], nan=np.inf)))
    if len(known) > MOST:
        names = {result.mode[k] for k in known}
        twin = [name.replace(" backward", " forward") for name in result.mode]
        known = [k for k in known if twin[k] == result.mode[k] or twin[k] not in names]
    return known[:MOST]


def _panel(axes: Axes, result: CampbellResult, mode: int, spindle: Spindle | None) -> None:
    node = result.node * 1e3
    ends_of_all = float(node.min()), float(node.max())
    room = 0.015 * (ends_of_all[1] - ends_of_all[0])  # for the marks of supports at the ends
    axes.set(xlim=(ends_of_all[0] - room, ends_of_all[1] + room), ylim=(-1.25, 1.25))
    axes.set_yticks([-1.0, 0.0, 1.0])
    axes.set_xticks(round_ticks(*ends_of_all, 4))
    axes.grid(visible=False)
    if spindle is not None:
        _outline(axes, spindle)
    columns = [result.dof.index(d) for d in _MOTION.get(result.kind[mode], ("y", "z"))]
    first = plane_curve(result.shape[0, mode][:, columns])
    last = plane_curve(result.shape[-1, mode][:, columns])
    last = np.sign(first @ last or 1.0) * last
    for place, rotor in enumerate(result.rotor):
        own = np.array([name == rotor for name in result.node_rotor])
        axes.plot(node[own], first[own], color=BLACK, lw=0.7)
        axes.plot(node[own], last[own], color=_COLOURS[place % len(_COLOURS)], lw=1.5, label=rotor)
    ends = (0, -1) if result.shape_speed.size > 1 else (-1,)
    hertz = " → ".join(number(float(result.frequency[end, mode]), 0) for end in ends)
    axes.set_title(f"{result.mode[mode]}: {hertz} Hz", fontsize=FONT_SIZE - 0.5, pad=3.0)


def _outline(axes: Axes, spindle: Spindle) -> None:
    """The shafts to their own scale along x and a common one across; bearings as marks."""
    sketch = Sketch()
    shafts = [spindle.part(name).shaft for name in spindle.ratios]
    widest = max(max(s.outer) for shaft in shafts for s in shaft.sections)
    edges = sorted(x for shaft in shafts for x in shaft.boundaries)
    for shaft in shafts:
        for section, ends in _pieces(shaft):
            a, b = (x * 1e3 for x in ends)
            half, hollow = (
                [0.55 * d / widest for d in each] for each in (section.outer, section.inner)
            )
            inside = [-d for d in half] if shaft is shafts[0] else hollow
            for side in (1.0,) if shaft is shafts[0] else (1.0, -1.0):
                (low, low_end), (high, high_end) = ([side * d for d in w] for w in (inside, half))
                wall = [(a, low), (b, low_end), (b, high_end), (a, high)]
                sketch.polygon(wall, "#F0F1F2", edge="#D5D8DA", width=0.5, z=1)
    sketch.line([(edges[0] * 1e3, 0.0), (edges[-1] * 1e3, 0.0)], GREY, 0.5, "dashdot", z=2)
    for x in [s.x * 1e3 for s in spindle.seats] + [s.x * 1e3 for s in spindle.supports]:
        for side in (-1.0, 1.0):
            tip, foot = 0.62 * side, 0.8 * side
            size = 0.011 * (edges[-1] - edges[0]) * 1e3
            sketch.polygon([(x, tip), (x - size, foot), (x + size, foot)], RED, edge=RED, z=2)
    sketch.draw(axes)


def _pieces(shaft: Shaft) -> list[tuple[Section, tuple[float, float]]]:
    """Sections and their ends [m]; of many as many as can be told apart, the middle ones."""
    if len(shaft.sections) <= MOST_PIECES:
        return list(zip(shaft.sections, pairwise(shaft.boundaries), strict=True))
    edges = np.linspace(shaft.start, shaft.end, MOST_PIECES + 1)
    middles = shaft.sections_at((edges[1:] + edges[:-1]) / 2.0)
    return list(zip(middles, pairwise(edges.tolist()), strict=True))
