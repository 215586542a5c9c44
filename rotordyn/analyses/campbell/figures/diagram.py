"""Campbell diagram: damped eigenfrequencies over speed."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.analyses.campbell.figures.defects import draw_passing
from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.arrays import Array
from rotordyn.figures.labels import axis_label, spread
from rotordyn.figures.legends import top_legend
from rotordyn.figures.mode_lines import LOOKS, draw_known, draw_modes, draw_stops, look_of
from rotordyn.figures.style import (
    FONT_SIZE,
    GREY,
    RED,
    add_axes,
    new_figure,
    note_error,
    speed_ticks,
)
from rotordyn.machine.reference import Reference
from rotordyn.modes.excitation import exciting
from rotordyn.results.described import Shown
from rotordyn.results.display import RPM, number
from rotordyn.results.frames import turning

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PALE = "#F6D78A"  # behind the lines
LETTER = 0.6  # mean width of a letter over the font size
RING = 8.0  # [pt] across a critical speed's mark
LIST_LINE = 3.3  # [mm]
_LIST_COLUMNS, _SHORT, MOST_LISTED = 3, 40, 24


def campbell_figure(
    result: CampbellResult,
    teeth: Sequence[int] = (),
    references: Sequence[Reference] = (),
    max_frequency: float = 0.0,
) -> Figure:
    """Draw modes with whirl, 1× and tooth-passing lines, critical speeds, known frequencies.

    Critical speeds are numbered in the diagram and listed below it.
    """
    criticals = shown_criticals(result)
    listed = _listed(result, criticals)
    columns = _LIST_COLUMNS if max(map(len, listed), default=0) <= _SHORT else _LIST_COLUMNS - 1
    rows = math.ceil(len(listed) / columns)
    foot = LIST_LINE * (rows + 1) + 1.0 if rows else 0.0
    figure = new_figure(168.0, 105.0 + foot)
    x_label = "speed of the spindle [rpm]" if len(result.rotor) > 1 else "speed [rpm]"
    axes = add_axes(figure, (15.0, 11.0 + foot, 109.0, 92.0), x_label)
    top = max_frequency or highest([result])
    _diagram(axes, result, teeth, references, top, 6)
    _criticals(axes, result, criticals)
    _list(figure, listed, rows, columns)
    note_error(axes, result.largest_error)
    top_legend(figure, axes)
    return figure


def draw_variant(teeth: Sequence[int], axes: Axes, variant: Shown, top: float) -> None:
    """Draw the diagram of a variant up to ``top`` [Hz], modes with short names."""
    axes.set_xlabel("speed [rpm]", fontsize=FONT_SIZE)
    _diagram(axes, variant.result, teeth, variant.known, top, 3, brief=True)


def highest_of(max_frequency: float, variants: Sequence[Shown]) -> float:
    """Return the top of the axis for all variants [Hz]."""
    return max_frequency or highest([variant.result for variant in variants])


def highest(results: Sequence[CampbellResult]) -> float:
    """Return a limit slightly above the highest frequency of all results [Hz]."""
    maxima = [float(np.nanmax(r.frequency)) for r in results if r.frequency.size]
    return 1.04 * max(maxima, default=1.0)


def _diagram(
    axes: Axes,
    result: CampbellResult,
    teeth: Sequence[int],
    references: Sequence[Reference],
    top: float,
    most: int,
    *,
    brief: bool = False,
) -> None:
    """Draw lines, their names, and references; ``most`` ticks of speed."""
    rpm = float(result.speed[-1] * RPM.factor)
    axes.set_ylabel(axis_label(result, "frequency"), fontsize=FONT_SIZE)
    if not result.mode:
        axes.text(0.5, 0.5, "no mode in this band", transform=axes.transAxes, ha="center")
    speed_ticks(axes, rpm, most)
    axes.set_ylim(0.0, top)
    draw_modes(axes, result)
    draw_stops(axes, result)
    draw_unstable(axes, result)
    draw_passing(axes, result, top)
    excitation = draw_orders(axes, orders(result, teeth), rpm, top)
    draw_known(axes, () if turning(result) else references)
    _name_modes(axes, result, excitation, top, brief=brief)


def draw_unstable(axes: Axes, result: CampbellResult) -> None:
    """Draw a broad band behind every mode where it is unstable, from the threshold on."""
    look: dict[str, Any] = dict(color=PALE, lw=6.0, solid_capstyle="round", zorder=3)
    label = "unstable"
    for k, name in enumerate(result.mode):
        growing = np.where(result.unstable[:, k], result.frequency[:, k], np.nan)
        x, curve = result.speed, growing
        if name == result.unstable_mode:
            x, curve = _with_threshold(result, growing, result.frequency[:, k])
        if np.isfinite(curve).any():
            axes.plot(x * RPM.factor, curve, marker="o", ms=6.0, mec="none", label=label, **look)
            label = "_"


def _with_threshold(result: CampbellResult, curve: Array, known: Array) -> tuple[Array, Array]:
    """Insert the stability threshold into the speeds and the ``curve`` of the first unstable mode,
    with the value of ``known`` interpolated linearly."""
    start, finite = result.stability_threshold, np.isfinite(known)
    if start in result.speed or not finite.any():
        return result.speed, curve
    row = int(np.searchsorted(result.speed, start))
    value = np.interp(start, result.speed[finite], known[finite])
    return np.insert(result.speed, row, start), np.insert(curve, row, value)


def orders(result: CampbellResult, teeth: Sequence[int]) -> dict[float, str]:
    """Return the orders of excitation, multiples of the speed, with their names, those of further
    rotors included.

    In the rotating frame unbalance stands still, and a force of k teeth, fixed in space, appears as
    (k − 1)× for forward and (k + 1)× for backward whirl.
    """
    if not turning(result):
        named: dict[float, str] = {}
        lines = exciting(_ratios(result), sorted({1.0, *result.engine_order.tolist()}))
        several = len({line.rotor for line in lines}) > 1
        for line in lines:
            size = float(f"{line.size:.12g}")  # 0.2 times 1.5 is 0.3
            name = f"{line.name} {line.rotor}" if several else line.name
            named[size] = f"{named[size]}, {name}" if size in named else name
        for k in teeth:
            if k != 1:
                same, name = named.get(k, f"{k}×"), f"{k}× (teeth)"
                named[k] = name if same == f"{k}×" else f"{same}, {name}"
        return named
    named = {0: "unbalance"}
    for k in teeth:
        named.setdefault(k - 1, f"{k - 1}× ({k} teeth, forward)")
        named.setdefault(k + 1, f"{k + 1}× ({k} teeth, backward)")
    return named


def _ratios(result: CampbellResult) -> dict[str, float]:
    return dict(zip(result.rotor, result.speed_ratio.tolist(), strict=True))


def draw_orders(
    axes: Axes, orders: Mapping[float, str], rpm: float, top: float
) -> list[tuple[float, str]]:
    """Draw lines f = k n; return height [Hz] and name of those that end on the right."""
    from matplotlib.collections import LineCollection

    lines = [[(0.0, 0.0), (rpm, order * rpm / 60.0)] for order in orders]
    end = {order: order * rpm / 60.0 for order in orders}
    axes.add_collection(LineCollection(lines, colors=GREY, linewidths=0.8, zorder=2), autolim=False)
    _name_at_the_top(axes, {k: name for k, name in orders.items() if end[k] > top}, rpm, top)
    return [(end[k], name) for k, name in orders.items() if end[k] <= top]


def _name_at_the_top(axes: Axes, orders: Mapping[float, str], rpm: float, top: float) -> None:
    """Write names beside their lines, each in the highest row that has room."""
    letter = LETTER * (FONT_SIZE - 1.0) / 72.0 * axes.figure.dpi * rpm / axes.bbox.width
    occupied: list[float] = []
    for order in sorted(orders, reverse=True):
        row, start = 0, top * 60.0 / order
        while row < len(occupied) and start < occupied[row]:
            row += 1
            start = _row(row) * top * 60.0 / order
        occupied[row : row + 1] = [start + letter * (len(orders[order]) + 2)]
        axes.text(
            start,
            top * (_row(row) - 0.015),
            f" {orders[order]}",
            ha="left",
            va="top",
            color=GREY,
            fontsize=FONT_SIZE - 1.0,
        )


def _row(number: int) -> float:
    """Return the upper edge of a row of names, over the height of the axes."""
    return 1.0 - 0.037 * number


def shown_criticals(result: CampbellResult) -> list[int]:
    """Return the critical speeds that are marked, the slowest first."""
    shown = result.critical_excited & (result.critical_speed <= result.speed[-1])
    if turning(result):
        shown &= result.critical_order == 1  # other orders have no line there: see ``orders``
    return sorted(np.flatnonzero(shown).tolist(), key=lambda k: float(result.critical_speed[k]))


def critical_hertz(result: CampbellResult, place: int) -> float:
    """Return the frequency [Hz] of the excitation at a critical speed, in the fixed frame."""
    ratio = abs(_ratios(result)[result.critical_rotor[place]])
    rpm = float(result.critical_speed[place] * RPM.factor)
    return float(result.critical_order[place] * ratio * rpm / 60.0)


def _criticals(axes: Axes, result: CampbellResult, shown: Sequence[int]) -> None:
    """Draw a ring at each critical speed, numbered; rings that touch share a label."""
    if not shown:
        return
    rpm = np.array([result.critical_speed[k] * RPM.factor for k in shown])
    hertz = np.array([critical_hertz(result, k) for k in shown]) * (not turning(result))
    look: dict[str, Any] = dict(mfc="white", mec=RED, mew=1.2, ls="none", zorder=7, clip_on=False)
    axes.plot(rpm, hertz, "o", label="critical speed", **look)
    pixels = axes.transData.transform(np.column_stack([rpm, hertz])) * 72.0 / axes.figure.dpi
    groups: list[list[int]] = []
    for k, pixel in enumerate(pixels):
        touching = [g for g in groups if np.abs(pixels[g[-1]] - pixel).max() < RING]
        if touching:
            touching[0].append(k)
        else:
            groups.append([k])
    for group in groups:
        axes.annotate(
            ", ".join(str(k + 1) for k in group),
            (rpm[group[-1]], hertz[group[-1]]),
            (3.5, -3.0) if not turning(result) else (0.0, 4.0),
            textcoords="offset points",
            ha="left",
            va="top" if not turning(result) else "bottom",
            fontsize=FONT_SIZE - 1.5,
            color=RED,
            zorder=8,
        )


def _listed(result: CampbellResult, shown: Sequence[int]) -> list[str]:
    """Return a line for each critical speed: number, rpm, Hz and mode; of many only the first."""
    several = len(result.rotor) > 1 or len(set(result.critical_order[list(shown)].tolist())) > 1
    lines = []
    for number_of, k in enumerate(shown[:MOST_LISTED], start=1):
        rotor = f" {result.critical_rotor[k]}" if len(result.rotor) > 1 else ""
        by = f", {result.critical_order[k]:g}×{rotor}" if several else ""
        rpm, hertz = result.critical_speed[k] * RPM.factor, critical_hertz(result, k)
        lines.append(f"{number_of}: {rpm:.0f} rpm, {number(hertz)} Hz, {result.critical[k]}{by}")
    if len(shown) > MOST_LISTED:
        lines[-1] = f"… {len(shown) - MOST_LISTED + 1} more in campbell_critical.csv"
    return lines


def _list(figure: Figure, lines: Sequence[str], rows: int, columns: int) -> None:
    """Write ``lines`` in columns at the foot of the figure."""
    if not lines:
        return
    width, height = figure.get_size_inches() * 25.4
    look: dict[str, Any] = dict(ha="left", va="bottom", fontsize=FONT_SIZE - 1.0)
    figure.text(4.0 / width, (1.0 + LIST_LINE * rows) / height, "critical speeds", **look)
    for k, line in enumerate(lines):
        column, row = divmod(k, rows)
        x = 4.0 + column * (width - 8.0) / columns
        figure.text(x / width, (1.0 + LIST_LINE * (rows - 1 - row)) / height, line, **look)


def _name_modes(
    axes: Axes,
    result: CampbellResult,
    excitation: Sequence[tuple[float, str]],
    top: float,
    *,
    brief: bool,
) -> None:
    """Write names at the right edge, spread where modes are close, joined to their curves;
    ``brief``: without their frequencies."""
    from matplotlib.collections import LineCollection

    last = result.frequency[-1]
    drawn = np.isfinite(last) & (last <= top) & ~result.mostly_overdamped
    shown = np.flatnonzero(drawn).tolist()
    labels = [(float(last[k]), _label(result.mode[k], float(last[k]), brief)) for k in shown]
    looks = [LOOKS[look_of(result.kind[k], result.whirl[-1, k])][0] for k in shown]
    labels += list(excitation)
    looks += [GREY] * len(excitation)
    heights = [y for y, _ in labels]
    size = FONT_SIZE - (1.5 if brief else 1.0)
    line = 1.35 * size / 72.0 * axes.figure.dpi / axes.bbox.height
    placed = spread(heights, [top * line] * len(labels), 0.0, top)
    edge, frame = float(axes.get_xlim()[1]), axes.get_xlim()[1]
    leaders = [
        [(edge, y), (edge + 0.012 * frame, y), (edge + 0.03 * frame, at), (edge + 0.04 * frame, at)]
        for y, at in zip(heights, placed, strict=True)
    ]
    axes.add_collection(
        LineCollection(leaders, colors=looks, linewidths=0.5, clip_on=False), autolim=False
    )
    for at, (_, name), colour in zip(placed, labels, looks, strict=True):
        axes.text(edge + 0.046 * frame, at, name, va="center", color=colour, fontsize=size)


def _label(mode: str, hertz: float, brief: bool) -> str:
    return short(mode) if brief else f"{mode}  {number(hertz, 0)} Hz"


def short(mode: str) -> str:
    """Return the name of a mode with its whirl in two letters."""
    return mode.replace("backward", "bw").replace("forward", "fw")
