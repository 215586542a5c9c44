"""A frequency response over speed and frequency as a surface in space.

The parallel projection is done here: a height field seen from in front and above only needs its
strips painted from back to front, and text and frame stay under control.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.analyses.frf.figures.decimate import peak_bins
from rotordyn.analyses.frf.figures.map import COLOURS, amplitude, amplitude_range, with_peaks
from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.arrays import Array
from rotordyn.figures.labels import axis_label
from rotordyn.figures.legends import shortened
from rotordyn.figures.mode_lines import KNOWN
from rotordyn.figures.style import BLACK, FONT_SIZE, add_axes, log_ticks, new_figure, round_ticks
from rotordyn.machine.reference import Reference
from rotordyn.results.described import Shown
from rotordyn.results.display import RPM, shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Limits = tuple[float, float]
Corners = list[tuple[float, float, float]]
STRIPS, STEPS = 60, 260
_RIGHT = np.array([1.0, -0.13])
_BACK = np.array([0.52, 0.42])
_UP = np.array([0.0, 0.62])


def surface_figure(result: FrequencyResponse, pair: int) -> Figure:
    """|H| (log) of one pair; frequency to the right, speed into the depth."""
    figure = new_figure(168.0, 112.0)
    axes = add_axes(figure, (3.0, 3.0, 162.0, 106.0))
    draw_surface(axes, result, pair, f"{result.kind} {result.pair[pair]}")
    return figure


def draw_surface(
    axes: Axes,
    result: FrequencyResponse,
    pair: int,
    title: str,
    limits: Limits | None = None,
    shrink: float = 1.0,
) -> None:
    """Draw the surface with its frame.

    ``limits`` of the height [printed unit], by default its own; ``shrink``: factor by which
    the panel is smaller than a full figure, which leaves room for its text.
    """
    axes.set_axis_off()
    frequency, rpm, height, limits = _grid(result, pair, limits)
    _frame(axes, result, pair, limits, shrink)
    _surface(axes, frequency, rpm, height)
    axes.set_title(title, fontsize=FONT_SIZE, y=0.97 if shrink == 1.0 else 0.94)
    axes.set(
        xlim=(-0.04 - 0.16 * shrink, 1.5 + 0.12 * shrink),
        ylim=(-0.13 - 0.14 * shrink, 1.08 + 0.06 * shrink),
    )


def draw_variant(axes: Axes, variant: Shown, limits: Limits) -> None:
    """Draw the surface of the first pair of a variant, with its known frequencies as pins."""
    draw_surface(axes, variant.result, 0, shortened(variant.title), limits, shrink=1.6)
    draw_pins(axes, variant.result, variant.known)


def draw_pins(axes: Axes, result: FrequencyResponse, known: Sequence[Reference]) -> None:
    """Draw published and measured frequencies as pins through the surface."""
    rpm, high = max(float(result.speed[-1]), 1.0), float(result.frequency[-1])
    for reference in (r for r in known if r.quantity in KNOWN):
        mark, what = KNOWN[reference.quantity]
        look: dict[str, Any] = {"mfc": "white", "mec": BLACK, "ms": 4.0, "ls": "none", "zorder": 5}
        for speed, value in zip(reference.speeds, reference.values, strict=True):
            if speed > rpm * (1.0 + 1e-9) or value > high:
                continue
            foot, head = (
                np.array(value / high) * _RIGHT + speed / rpm * _BACK + h * _UP for h in (0, 1.05)
            )
            axes.plot(*np.array([foot, head]).T, color=BLACK, lw=0.5, ls=(0, (2, 1)), zorder=4)
            axes.plot(*head, mark, label=f"{reference.kind}{what}", **look)


def project(right: Array, back: Array, up: Array) -> Array:
    """Points of the unit cube on the paper, shape (…, 2)."""
    return np.asarray(
        right[..., None] * _RIGHT + back[..., None] * _BACK + up[..., None] * _UP, float
    )


def _grid(
    result: FrequencyResponse, pair: int, limits: Limits | None
) -> tuple[Array, Array, Array, Limits]:
    """Frequency, speed and logarithmic height (strips, steps), each from 0 to 1; then its limits.

    Peaks between frequencies are included.
    """
    keep = np.flatnonzero(np.isfinite(result.response[:, pair]).all(axis=1))
    keep = keep[np.unique(np.linspace(0, keep.size - 1, min(STRIPS, keep.size)).astype(int))]
    frequency, rpm = result.frequency, result.speed[keep] * RPM.factor
    edges = np.linspace(frequency[0], frequency[-1] * (1.0 + 1e-12), STEPS + 1)
    values = peak_bins(amplitude(result, pair), frequency, edges)
    values = with_peaks(values, result, pair, edges)[keep]
    low, high = limits or amplitude_range(values)
    height = np.log(np.clip(values, low, high) / low) / math.log(high / low)
    across = (edges[:-1] + edges[1:]) / 2.0 / frequency[-1]
    return across, rpm / max(float(result.speed[-1] * RPM.factor), 1.0), height, (low, high)


def _surface(axes: Axes, frequency: Array, rpm: Array, height: Array) -> None:
    """Draw a quadrilateral per cell, back to front, coloured by height and shaded by slope; the
    front strip as a line."""
    from matplotlib import colormaps
    from matplotlib.collections import LineCollection, PolyCollection

    order = np.argsort(-rpm)
    rpm, height = rpm[order], height[order]
    points = project(
        np.broadcast_to(frequency, height.shape),
        np.broadcast_to(rpm[:, None], height.shape),
        height,
    )
    if len(rpm) > 1:
        cells = np.stack(
            [points[:-1, :-1], points[:-1, 1:], points[1:, 1:], points[1:, :-1]], axis=2
        )
        mean = (height[:-1, :-1] + height[:-1, 1:] + height[1:, 1:] + height[1:, :-1]) / 4.0
        slope = height[:-1, 1:] - height[:-1, :-1] + height[1:, 1:] - height[1:, :-1]
        shade = np.clip(1.0 - 2.2 * slope, 0.72, 1.12).reshape(-1, 1)
        colours = colormaps[COLOURS](mean.ravel())[:, :3]
        colours = np.clip(colours * shade, 0.0, 1.0)
        axes.add_collection(
            PolyCollection(
                list(cells.reshape(-1, 4, 2)),
                facecolors=colours,
                edgecolors="face",
                linewidths=0.3,
                rasterized=True,
                zorder=2,
            ),
            autolim=False,
        )
    front = LineCollection([points[-1]], colors=BLACK, linewidths=0.8, zorder=3)
    axes.add_collection(front, autolim=False)


def _frame(axes: Axes, result: FrequencyResponse, pair: int, limits: Limits, shrink: float) -> None:
    """Draw floor and walls with a light grid, ticks and names of the three axes."""
    from matplotlib.collections import LineCollection

    rpm = max(float(result.speed[-1] * RPM.factor), 1.0)
    high = float(result.frequency[-1])
    across = [(f / high, f"{f:.0f}") for f in round_ticks(0.0, high, round(5 / shrink))]
    deep = [(n / rpm, f"{n:.0f}") for n in round_ticks(0.0, rpm, round(6 / shrink))]
    low, span = math.log10(limits[0]), math.log10(limits[1] / limits[0])
    tall = [((math.log10(v) - low) / span, name) for v, name in log_ticks(*limits)]
    lines: list[Corners] = [[(a, 0, 0), (a, 1, 0), (a, 1, 1)] for a, _ in across]
    lines += [[(0, b, 1), (0, b, 0), (1, b, 0)] for b, _ in deep]
    lines += [[(0, 0, c), (0, 1, c), (1, 1, c)] for c, _ in tall]
    grid = [project(*np.array(line, float).T) for line in lines]
    axes.add_collection(LineCollection(grid, colors="#DDDDDD", linewidths=0.5), autolim=False)
    box: list[Corners] = [[(0, 0, 0), (1, 0, 0), (1, 1, 0)], [(0, 0, 0), (0, 0, 1)]]
    box += [[(0, 1, 0), (0, 1, 1)]]
    box += [[(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1), (0, 0, 1)]]
    frame = [project(*np.array(line, float).T) for line in box]
    axes.add_collection(LineCollection(frame, colors="#777777", linewidths=0.6), autolim=False)
    text: dict[str, Any] = {"fontsize": FONT_SIZE - 0.5}
    for a, name in across:
        x, y = a * _RIGHT
        axes.text(x + 0.01, y - 0.02 * shrink, name, ha="right", va="top", **text)
    for b, name in deep:
        x, y = _RIGHT + b * _BACK
        axes.text(x + 0.018 * shrink, y - 0.016 * shrink, name, ha="left", va="center", **text)
    for c, name in tall:
        axes.text(-0.015 * shrink, c * _UP[1], name, ha="right", va="center", **text)
    unit = shown(result.unit(pair)).unit
    _axis_names(axes, axis_label(result, "frequency"), unit, shrink)


def _axis_names(axes: Axes, frequency_label: str, unit: str, shrink: float) -> None:
    middle, edge = 0.5 * _RIGHT, _RIGHT + 0.5 * _BACK
    axes.text(
        middle[0],
        middle[1] - 0.1 * shrink,
        frequency_label,
        ha="center",
        va="top",
        fontsize=FONT_SIZE,
        rotation=-7.0,
    )
    axes.text(
        edge[0] + 0.17 * shrink,
        edge[1] - 0.06 * shrink,
        "speed [rpm]",
        ha="center",
        va="center",
        fontsize=FONT_SIZE,
        rotation=37.0,
    )
    axes.text(
        -0.15 * shrink,
        0.5 * _UP[1],
        f"|H| [{unit}]",
        ha="center",
        va="center",
        rotation=90.0,
        fontsize=FONT_SIZE,
    )
