"""Campbell diagram: damped eigenfrequencies over speed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.figures.labels import axis_label, spread
from rotordyn.figures.legends import legend
from rotordyn.figures.mode_lines import LOOKS, draw_known, draw_modes, look_of
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
from rotordyn.results.display import RPM, number
from rotordyn.results.frames import turning

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PALE = "#F6D78A"  # behind the lines
LETTER = 0.6  # mean width over the size of the font


def campbell_figure(
    result: CampbellResult,
    teeth: Sequence[int] = (),
    references: Sequence[Reference] = (),
    max_frequency: float = 0.0,
) -> Figure:
    """Modes with their whirl, 1× and tooth-passing lines, critical speeds, known frequencies."""
    figure = new_figure(168.0, 115.0)
    whose = "speed of the spindle [rpm]" if len(result.rotor) > 1 else "speed [rpm]"
    axes = add_axes(figure, (15.0, 11.0, 112.0, 92.0), whose, axis_label(result, "frequency"))
    rpm = result.speed * RPM.factor
    if not result.mode:
        axes.text(0.5, 0.5, "no mode in this band", transform=axes.transAxes, ha="center")
    top = max_frequency or float(np.nanmax(result.frequency)) * 1.04
    speed_ticks(axes, float(rpm[-1]))
    axes.set_ylim(0.0, top)
    draw_modes(axes, result)
    draw_unstable(axes, result)
    excitation = draw_orders(axes, orders(result, teeth), float(rpm[-1]), top)
    _criticals(axes, result)
    draw_known(axes, () if turning(result) else references)
    _name_modes(axes, result, excitation, top)
    note_error(axes, result.largest_error)
    legend(
        axes,
        loc="lower left",
        bbox_to_anchor=(-0.01, 1.0),
        ncols=6,
        columnspacing=1.2,
        borderaxespad=0.2,
    )
    return figure


def draw_unstable(axes: Axes, result: CampbellResult) -> None:
    """A broad band behind every mode where it grows by itself."""
    if not result.unstable.any():
        return
    rpm = np.broadcast_to((result.speed * RPM.factor)[:, None], result.frequency.shape)
    growing = np.where(result.unstable, result.frequency, np.nan)
    look: dict[str, Any] = dict(color=PALE, lw=6.0, solid_capstyle="round", zorder=3)
    lines = axes.plot(rpm, growing, marker="o", ms=6.0, mec="none", **look)
    lines[0].set_label("unstable")


def orders(result: CampbellResult, teeth: Sequence[int]) -> dict[float, str]:
    """Multiples of the speed at which something excites, with their names; those of further rotors
    bear these.

    In the turning frame unbalance stands still, and a force of k teeth, fixed in space, comes as
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
    named = {0: "unbalance at 0 Hz"}
    for k in teeth:
        named.setdefault(k - 1, f"{k - 1}× ({k} teeth, forward)")
        named.setdefault(k + 1, f"{k + 1}× ({k} teeth, backward)")
    return named


def _ratios(result: CampbellResult) -> dict[str, float]:
    return dict(zip(result.rotor, result.speed_ratio.tolist(), strict=True))


def draw_orders(
    axes: Axes, orders: Mapping[float, str], rpm: float, top: float
) -> list[tuple[float, str]]:
    """Lines f = k n; returns height [Hz] and name of those that leave on the right."""
    from matplotlib.collections import LineCollection

    end = {order: order * rpm / 60.0 for order in orders}
    lines = [[(0.0, 0.0), (rpm, height)] for height in end.values()]
    axes.add_collection(LineCollection(lines, colors=GREY, linewidths=0.8, zorder=2), autolim=False)
    _name_at_the_top(axes, {k: name for k, name in orders.items() if end[k] > top}, rpm, top)
    return [(end[k], name) for k, name in orders.items() if end[k] <= top]


def _name_at_the_top(axes: Axes, orders: Mapping[float, str], rpm: float, top: float) -> None:
    """Names beside their lines, each in the highest row in which it has room."""
    letter = LETTER * (FONT_SIZE - 1.0) / 72.0 * axes.figure.dpi * rpm / axes.bbox.width
    taken: list[float] = []
    for order in sorted(orders, reverse=True):
        row, start = 0, top * 60.0 / order
        while row < len(taken) and start < taken[row]:
            row += 1
            start = _row(row) * top * 60.0 / order
        taken[row : row + 1] = [start + letter * (len(orders[order]) + 2)]
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
    """Upper edge of a row of names, over the height of the axes."""
    return 1.0 - 0.037 * number


def _criticals(axes: Axes, result: CampbellResult) -> None:
    shown = result.critical_excited & (result.critical_speed <= result.speed[-1])
    if turning(result):
        shown &= result.critical_order == 1  # others meet no line there: see ``orders``
    speeds = result.critical_speed[shown] * RPM.factor
    turned = np.array([abs(_ratios(result)[name]) for name in result.critical_rotor])
    multiple = (result.critical_order * turned)[shown]
    if speeds.size:
        axes.plot(
            speeds,
            0.0 * speeds if turning(result) else multiple * speeds / 60.0,
            "o",
            mfc="white",
            mec=RED,
            mew=1.2,
            ls="none",
            label="critical speed",
            zorder=7,
        )


def _name_modes(
    axes: Axes, result: CampbellResult, excitation: Sequence[tuple[float, str]], top: float
) -> None:
    """Names at the right edge, moved apart where modes are close, joined to their curves."""
    from matplotlib.collections import LineCollection

    last = result.frequency[-1]
    drawn = np.isfinite(last) & (last <= top) & ~result.mostly_overdamped
    shown = np.flatnonzero(drawn).tolist()
    labels = [(float(last[k]), f"{result.mode[k]}  {number(float(last[k]), 0)}") for k in shown]
    looks = [LOOKS[look_of(result.kind[k], result.whirl[-1, k])][0] for k in shown]
    labels += list(excitation)
    looks += [GREY] * len(excitation)
    heights = [y for y, _ in labels]
    placed = spread(heights, [top * 0.037] * len(labels), 0.0, top)
    edge, frame = float(axes.get_xlim()[1]), axes.get_xlim()[1]
    leaders = [
        [(edge, y), (edge + 0.012 * frame, y), (edge + 0.03 * frame, at), (edge + 0.04 * frame, at)]
        for y, at in zip(heights, placed, strict=True)
    ]
    axes.add_collection(
        LineCollection(leaders, colors=looks, linewidths=0.5, clip_on=False), autolim=False
    )
    for at, (_, name), colour in zip(placed, labels, looks, strict=True):
        axes.text(
            edge + 0.046 * frame, at, name, va="center", color=colour, fontsize=FONT_SIZE - 1.0
        )
