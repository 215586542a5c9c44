"""Campbell diagram: damped eigenfrequencies over speed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.display import RPM, number
from rotordyn.analysis.excitation import exciting
from rotordyn.analysis.results import CampbellResult, turning
from rotordyn.machine.reference import Reference
from rotordyn.plots.labels import axis_label, spread
from rotordyn.plots.legends import legend
from rotordyn.plots.style import (
    BLACK,
    BLUE,
    FONT_SIZE,
    GREEN,
    GREY,
    PURPLE,
    RED,
    add_axes,
    new_figure,
    note_error,
    speed_ticks,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LOOKS: dict[str, tuple[str, Any, str]] = {
    "forward": (BLUE, "-", "forward whirl"),
    "backward": (RED, (0, (5, 2)), "backward whirl"),
    "planar": (BLACK, (0, (1, 1)), "bending without whirl"),
    "axial": (GREEN, (0, (6, 2, 1, 2)), "axial"),
    "torsion": (PURPLE, (0, (6, 2, 1, 2, 1, 2)), "torsion"),
}
KNOWN = {
    "bending_frequency": ("D", ""),
    "mean_bending_frequency": ("s", ", mean of both whirls"),
    "torsion_frequency": ("^", ", torsion"),
}
PALE = "#F6D78A"  # behind the lines
LETTER = 0.6  # mean width over the size of the font
Segments = dict[str, list[NDArray[np.float64]]]


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


def whirl_segments(result: CampbellResult) -> Segments:
    """Curves of (rpm, Hz) by look; a mode that changes its whirl is cut there."""
    rpm = result.speed * RPM.factor
    found: Segments = {}
    for column in np.flatnonzero(~result.mostly_overdamped):
        kind = result.kind[column]
        frequency, whirl = result.frequency[:, column], result.whirl[:, column]
        looks = [_look(kind, w) for w in whirl]
        if len(looks) > 1:
            looks[0] = looks[1]
        start = 0
        for end in range(1, len(looks) + 1):
            if end == len(looks) or looks[end] != looks[start]:
                first = max(start - 1, 0)
                curve = np.column_stack([rpm[first:end], frequency[first:end]])
                curve = curve[np.isfinite(curve).all(axis=1)]
                if curve.size:
                    found.setdefault(looks[start], []).append(curve)
                start = end
    return found


def draw_modes(axes: Axes, result: CampbellResult, colour: str = "", width: float = 0.7) -> None:
    """One collection of curves per look; all in ``colour`` and of ``width`` when given."""
    from matplotlib.collections import LineCollection

    curves = whirl_segments(result)
    for look, (own, dashes, label) in LOOKS.items():
        paths = [curve for curve in curves.get(look, ()) if len(curve) > 1]
        points = [curve for curve in curves.get(look, ()) if len(curve) == 1]
        named = None if colour else label
        if points:
            dots = np.concatenate(points)
            axes.plot(*dots.T, "o", color=colour or own, ms=4.0, label=named, clip_on=False)
        if paths:
            lines = LineCollection(
                paths,
                colors=colour or own,
                linestyles=[dashes],
                linewidths=width if colour else 1.3,
                label=named,
                zorder=4,
            )
            axes.add_collection(lines, autolim=False)


def draw_known(axes: Axes, references: Sequence[Reference], edge: str = BLACK) -> None:
    """Published and measured frequencies within the axes: of one whirl, of both, of torsion."""
    right, top = axes.get_xlim()[1], axes.get_ylim()[1]
    for reference in references:
        if reference.quantity not in KNOWN:
            continue
        marker, what = KNOWN[reference.quantity]
        rpm, hertz = np.asarray(reference.speeds) * RPM.factor, np.asarray(reference.values)
        inside = (rpm <= right * (1.0 + 1e-9)) & (hertz <= top)
        if not inside.any():
            continue
        axes.plot(
            rpm[inside],
            hertz[inside],
            marker,
            mfc="none",
            mec=edge,
            ms=5.0,
            mew=0.9,
            ls="none",
            label=f"{reference.kind}{what}",
            zorder=6,
            clip_on=False,
        )


def draw_unstable(axes: Axes, result: CampbellResult) -> None:
    """A broad band behind every mode where it grows by itself."""
    if not result.unstable.any():
        return
    rpm = np.broadcast_to((result.speed * RPM.factor)[:, None], result.frequency.shape)
    growing = np.where(result.unstable, result.frequency, np.nan)
    look: dict[str, Any] = dict(color=PALE, lw=6.0, solid_capstyle="round", zorder=3)
    lines = axes.plot(rpm, growing, marker="o", ms=6.0, mec="none", **look)
    lines[0].set_label("unstable")


def _look(kind: str, whirl: float) -> str:
    if kind != "bending":
        return kind if kind in LOOKS else "planar"
    return {1: "forward", -1: "backward"}.get(int(whirl) if whirl == whirl else 0, "planar")


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
    looks = [LOOKS[_look(result.kind[k], result.whirl[-1, k])][0] for k in shown]
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
