"""Mode shapes in the plane, at rest and at top speed, as small multiples."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.arrays import Array, Complex
from rotordyn.figures.legends import top_legend
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
    head,
    new_figure,
    round_ticks,
)
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.results.display import RPM, number
from rotordyn.surface.motion import section_motion

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST = 9
MOST_PIECES = 300  # of a shaft, as wide as a line
_COLUMNS = 3
_COLOURS = (BLUE, GREEN, PURPLE, ORANGE)  # of the rotors
_DASHES = (("-", "-"), (":", "--"))  # first and last speed; every second rotor
DISC, EDGE = "#DDE1E5", "#C4C9CD"
STATIONS = 200
MASS: Any = dict(marker="o", ms=3.0, mfc="white", mec=BLACK, mew=0.8, ls="none")
_MOTION = {"bending": ("y", "z"), "axial": ("x",), "torsion": ("thx",)}


def shapes_figure(result: CampbellResult, spindle: Spindle | None = None) -> Figure:
    """Draw a panel per mode: the shape at the first and the last speed over the rotor's outline.

    Between its nodes the shaft is drawn as its elements bend: see ``section_motion``.
    """
    modes = _chosen(result)
    rows = max(math.ceil(len(modes) / _COLUMNS), 1)
    low, high = result.shape_speed[[0, -1]] * RPM.factor
    omitted = len(result.mode) - len(modes)
    modes_left = "mode" if omitted == 1 else "modes"
    note = f"; {omitted} more {modes_left} in the results file" if omitted else ""
    both = f"{low:.0f} rpm and {high:.0f} rpm"
    when = both if result.shape_speed.size > 1 else f"{low:.0f} rpm"
    title = f"mode shapes at {when}, scaled to 1{note}"
    figure = new_figure(168.0, 26.0 + 30.0 * rows)
    margins = (14.0, 4.0, 12.0, 13.0)
    boxes = grid_boxes(figure, rows, _COLUMNS, margins=margins, gaps=(6.0, 7.0))
    for panel, (mode, box) in enumerate(zip(modes, boxes, strict=False)):
        last_row = panel + _COLUMNS >= len(modes)
        y_label = "relative motion [-]" if panel % _COLUMNS == 0 else ""
        axes = add_axes(figure, box, "x [mm]" if last_row else "", y_label)
        _panel(axes, result, mode, spindle)
        axes.tick_params(labelbottom=last_row, labelleft=panel % _COLUMNS == 0)
    if modes:
        axes = figure.axes[0]
        if spindle is not None and (spindle.seats or spindle.supports):
            axes.plot([], [], "v", color=RED, ms=4.0, label="bearing or support")
        if spindle is not None and spindle.masses:
            axes.plot([], [], **MASS, label="point mass")
        if spindle is not None and spindle.discs:
            axes.fill([], [], facecolor=DISC, edgecolor=EDGE, label="disc")
        top_legend(figure, axes)
    return head(figure, title)


def plane_curve(shape: Complex) -> Array:
    """Return the deflected line at the instant of largest motion, shape (node,), for (node, DOF).

    The DOF that moves most is shown; its largest displacement is positive. NaN where
    the mode is missing.
    """
    node, dof = np.unravel_index(int(np.argmax(np.abs(shape))), shape.shape)
    peak = shape[node, dof]
    if not np.isfinite(peak):
        return np.full(len(shape), np.nan)
    if peak == 0.0:
        return np.zeros(len(shape))
    return np.asarray((shape[:, dof] * np.conj(peak) / np.abs(peak) ** 2).real)


def _chosen(result: CampbellResult) -> list[int]:
    """Return the modes shown: those with a shape, lowest first; of a pair both if they fit."""
    has_shape = np.asarray(np.isfinite(result.shape).any(axis=(0, 2, 3)))
    shown = [k for k in range(len(result.mode)) if has_shape[k] and not result.mostly_overdamped[k]]
    shown.sort(key=lambda k: float(np.nan_to_num(result.frequency[0, k], nan=np.inf)))
    if len(shown) > MOST:
        names = {result.mode[k] for k in shown}
        forward = [name.replace(" backward", " forward") for name in result.mode]
        shown = [k for k in shown if forward[k] == result.mode[k] or forward[k] not in names]
    return shown[:MOST]


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
    lines = [_lines(result, mode, k, columns, spindle) for k in (0, -1)]
    first, last = (np.concatenate([curve for _, curve in curves]) for curves in lines)
    side = float(np.nan_to_num(np.sign(first @ last))) or 1.0
    several = len(result.rotor) > 1
    rpm = [f"{speed * RPM.factor:.0f} rpm" for speed in result.shape_speed[[0, -1]]]
    for style, rotor in enumerate(result.rotor):
        owner = f"{rotor}, " if several else ""
        if result.shape_speed.size > 1:
            x, curve = lines[0][style]
            axes.plot(x, curve, color=BLACK, lw=0.8, ls=_DASHES[style % 2][0], label=owner + rpm[0])
        x, curve = lines[1][style]
        look: dict[str, Any] = dict(color=_COLOURS[style % len(_COLOURS)], ls=_DASHES[style % 2][1])
        axes.plot(x, side * curve, lw=1.6, label=owner + rpm[1], **look)
    ends = (0, -1) if result.shape_speed.size > 1 else (-1,)
    hertz = " → ".join(number(float(result.frequency[end, mode]), 0) for end in ends)
    axes.set_title(f"{result.mode[mode]}: {hertz} Hz", fontsize=FONT_SIZE - 0.5, pad=3.0)


def _lines(
    result: CampbellResult, mode: int, speed: int, columns: list[int], spindle: Spindle | None
) -> list[tuple[Array, Array]]:
    """Return stations [mm] and deflected line of every rotor, all at one instant and scale."""
    motions = [_motion(result, mode, speed, rotor, spindle) for rotor in result.rotor]
    curve = plane_curve(np.concatenate([motion for _, motion in motions])[:, columns])
    ends = np.cumsum([len(x) for x, _ in motions])[:-1]
    return [(x * 1e3, part) for (x, _), part in zip(motions, np.split(curve, ends), strict=True)]


def _motion(
    result: CampbellResult, mode: int, speed: int, rotor: str, spindle: Spindle | None
) -> tuple[Array, Complex]:
    """Return stations [m] of a rotor, nodes and some between, and displacements (stations, 6)."""
    on_rotor = np.array([name == rotor for name in result.node_rotor])
    node, shape = result.node[on_rotor], result.shape[speed, mode][on_rotor]
    if spindle is None or node.size < 2:
        return node, shape
    even = np.linspace(node[0], node[-1], STATIONS)
    x = np.union1d(node, even)
    return x, section_motion(spindle.part(rotor).shaft, node, shape, x)


def _outline(axes: Axes, spindle: Spindle) -> None:
    """Draw shafts and discs, to scale along x, to a common scale across; bearings as marks."""
    sketch = Sketch()
    parts = spindle.parts.values()
    shafts = [part.shaft for part in parts]
    discs = [disc for part in parts for disc in part.discs]
    outside = [*(s.largest_diameter for s in shafts), *(d.outer_diameter for d in discs)]
    widest = max(outside)
    for disc in discs:
        a, b = ((disc.x + side * disc.width / 2.0) * 1e3 for side in (-1.0, 1.0))
        low, high = (0.55 * d / widest for d in (disc.inner_diameter, disc.outer_diameter))
        for edge in (low, -high):
            sketch.box(a, b, edge, edge + high - low, DISC, edge=EDGE, width=0.5, z=1)
    edges = sorted(x for shaft in shafts for x in shaft.boundaries)
    for shaft in shafts:
        for section, ends in _pieces(shaft):
            a, b = (x * 1e3 for x in ends)
            half, hollow = (
                [0.55 * d / widest for d in pair] for pair in (section.outer, section.inner)
            )
            inside = [-d for d in half] if shaft is shafts[0] else hollow
            for side in (1.0,) if shaft is shafts[0] else (1.0, -1.0):
                (low, low_end), (high, high_end) = ([side * d for d in w] for w in (inside, half))
                wall = [(a, low), (b, low_end), (b, high_end), (a, high)]
                sketch.polygon(wall, "#F0F1F2", edge=EDGE, width=0.5, z=1)
    sketch.line([(edges[0] * 1e3, 0.0), (edges[-1] * 1e3, 0.0)], GREY, 0.5, "dashdot", z=2)
    for x in [s.x * 1e3 for s in spindle.seats] + [s.x * 1e3 for s in spindle.supports]:
        for side in (-1.0, 1.0):
            tip, foot = 0.62 * side, 0.8 * side
            size = 0.011 * (edges[-1] - edges[0]) * 1e3
            sketch.polygon([(x, tip), (x - size, foot), (x + size, foot)], RED, edge=RED, z=2)
    sketch.draw(axes)
    stations = [mass.x * 1e3 for part in parts for mass in part.masses]
    axes.plot(stations, [0.0] * len(stations), **MASS)


def _pieces(shaft: Shaft) -> list[tuple[Section, tuple[float, float]]]:
    """Return sections and their ends [m]; of very many, those at evenly spaced stations."""
    if len(shaft.sections) <= MOST_PIECES:
        return list(zip(shaft.sections, pairwise(shaft.boundaries), strict=True))
    edges = np.linspace(shaft.start, shaft.end, MOST_PIECES + 1)
    middles = shaft.sections_at((edges[1:] + edges[:-1]) / 2.0)
    return list(zip(middles, pairwise(edges.tolist()), strict=True))
