"""Figures of the uncertainty of results: bands about curves, tornado diagrams, sensitivities."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.arrays import Array
from rotordyn.figures.curve_groups import BEYOND, limit_ordinate
from rotordyn.figures.end_names import NAMES, End, name_ends
from rotordyn.figures.labels import broken
from rotordyn.figures.legends import shortened, top_legend
from rotordyn.figures.style import (
    BLUE,
    FONT_SIZE,
    GREY,
    RED,
    add_axes,
    axis_start,
    grid_boxes,
    line_of,
    new_figure,
    round_ticks,
)
from rotordyn.results.headline import FAR, Curve, under
from rotordyn.results.interval import (
    NARROW,
    OVER_HYPOTHESES,
    OVER_TOLERANCES,
    Interval,
    short_path,
)

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PANELS, BARS = 6, 8  # numbers in a figure, and sources of each
BAR, ROOM = 5.2, 22.0  # height of a bar, and of the margins of a panel [mm]
ASIDE = 0.03  # of the width of an axis: margin for a mark on either side
LONGEST = 24  # characters of a line beside a bar
SEEN = 3e-3  # of the largest change of a number: smaller changes have no bar


def rules_figure(held: Interval) -> Figure:
    """Draw tornado diagrams: change of the numbers that vary most, by source, largest on top."""
    chosen = _chosen(held, held.varying())
    if not chosen:
        return new_figure(168.0, 30.0, "no uncertain value changes a number")
    rows = math.ceil(len(chosen) / 2)
    bars = min(BARS, len(held.source)) + 1
    figure = new_figure(168.0, rows * (BAR * bars + ROOM))
    boxes = grid_boxes(figure, rows, 2, margins=(34.0, 6.0, 10.0, 8.0), gaps=(38.0, 18.0))
    for k, box in zip(chosen, boxes, strict=False):
        _tornado(add_axes(figure, box, f"change [{held.unit[k] or '-'}]"), held, k)
    top_legend(figure, *figure.axes)
    return figure


def _chosen(held: Interval, order: Sequence[int]) -> list[int]:
    """Return the numbers to draw, in order: the widest one of every analysis, then others.

    Of numbers with the same behaviour, such as both whirls of a mode, only one is drawn.
    """
    first: dict[str, int] = {}
    distinct = held.apart(order)
    for k in distinct:
        first.setdefault(held.number[k].partition(":")[0], k)
    others = [k for k in distinct if k not in first.values()]
    return sorted([*first.values(), *others][:PANELS])


def _tornado(axes: Axes, held: Interval, k: int) -> None:
    low, high = held.hypotheses[k] - held.nominal[k]
    effects = held.effect[k]
    size = np.fmax.reduce(np.abs(effects), axis=1, initial=0.0)
    seen, several = SEEN * size.max(initial=0.0), len(held.combination) > 1
    sources = [int(s) for s in np.argsort(-size, kind="stable")[:BARS] if size[s] > seen]
    names = ["hypotheses"] * several
    names += [broken(short_path(held.source[s]), LONGEST) for s in sources]
    if several:
        axes.barh(0, high - low, left=low, height=0.7, color=GREY, label=OVER_HYPOTHESES)
    for place, s in enumerate(sources, start=int(several)):
        for end, opposite, colour, end_name in zip(
            effects[s], effects[s, ::-1], (BLUE, RED), held.end, strict=True
        ):
            inner = 0.0 < end / opposite < 1.0 if opposite else False  # both ends are on one side
            label, height = f"at its {end_name} value", 0.35 if inner else 0.7
            axes.barh(place, end, height, color=colour, label=label, zorder=1.1 if inner else 1.0)
    axes.axvline(0.0, color="black", lw=0.7)
    axes.set_yticks(range(len(names)), names, fontsize=FONT_SIZE - 1.5, linespacing=0.95)
    axes.set_ylim(len(names) - 0.4, -0.6)
    axes.grid(visible=False, axis="y")
    left, right = axes.get_xlim()
    room = 0.05 * (right - left)
    axes.set_xlim(left - room, right + room)
    axes.set_xticks(round_ticks(left - room, right + room, 4))
    axes.set_title(shortened(held.number[k]), fontsize=FONT_SIZE - 0.5, pad=3.0, loc="right")


def slopes_figure(held: Interval) -> Figure:
    """Draw a colour map of the relative change of every result over that of an input."""
    values = np.nan_to_num(held.elasticity)
    rows = np.flatnonzero(np.abs(values).max(axis=1) > NARROW)
    if not rows.size:
        return new_figure(168.0, 30.0, "none of these numbers changes a result")
    rows = rows[np.argsort(-np.abs(values[rows]).max(axis=1), kind="stable")][:24]
    rows.sort()
    tall = 5.0 * len(rows)
    figure = new_figure(168.0, tall + 40.0)
    axes = add_axes(figure, (62.0, 30.0, 100.0, tall))
    top = float(np.abs(values[rows]).max())
    axes.imshow(values[rows], cmap="RdBu_r", vmin=-top, vmax=top, aspect="auto")
    axes.set_xticks(
        range(len(held.path)),
        [broken(short_path(p), 34) for p in held.path],
        rotation=20,
        ha="right",
    )
    axes.set_yticks(range(len(rows)), [shortened(held.number[k], 44) for k in rows])
    axes.tick_params(labelsize=FONT_SIZE - 1.5)
    axes.grid(visible=False)
    for (i, j), value in np.ndenumerate(values[rows]):
        colour = "white" if abs(value) > 0.6 * top else "black"
        text = f"{value:+.2f}" if abs(value) >= 0.005 else "0"
        axes.text(j, i, text, ha="center", va="center", fontsize=FONT_SIZE - 1.5, color=colour)
    axes.set_title("relative change of a result over that of a number", fontsize=FONT_SIZE)
    return figure


def bands_figure(held: Interval, curves: Mapping[str, Curve]) -> Figure:
    """Draw headline curves of a figure, each with the band of its uncertainty."""
    panels: dict[tuple[str, ...], list[tuple[str, Curve]]] = {}
    for key, curve in curves.items():
        if key in held.curve:
            where = curve.panel, curve.label, curve.title, curve.along
            panels.setdefault(where, []).append((key, curve))
    columns = 1 if len(panels) == 1 or any(c.log for c in curves.values()) else 2
    rows = max(math.ceil(len(panels) / columns), 1)
    figure = new_figure(168.0, 16.0 + rows * (96.0 if len(panels) == 1 else 68.0))
    named = len(panels) == 1 and any(curve.end for curve in curves.values())
    margins = 17.0, 5.0 + NAMES * named, 12.0, 9.0
    boxes = grid_boxes(figure, rows, columns, margins=margins, gaps=(18.0, 15.0))
    for box, (panel, shown) in zip(boxes, panels.items(), strict=False):
        first = shown[0][1]
        axes = add_axes(figure, box, first.along, f"{first.label} [{first.unit}]")
        if title := first.title or panel[0]:
            axes.set_title(title, fontsize=FONT_SIZE, pad=4.0)
        series = list(dict.fromkeys(curve.series for _, curve in shown))
        for key, curve in shown:
            _line(axes, held.curve_nominal[held.rows_of(held.curve.index(key))], curve, series)
        limits = axes.get_ylim()
        for key, curve in shown:
            _band(axes, held, held.curve.index(key), curve)
        if np.isfinite(first.ceiling):  # the axis does not grow for bands beyond it
            axes.set_ylim(limits)
        _finish(axes, first)
        for key, curve in shown:
            _beyond(axes, held, held.curve.index(key), curve)
        if named:
            name_ends(axes, _ends(held, shown, series), box[3])
    top_legend(figure, *figure.axes)
    return figure


def _line(axes: Axes, y: Array, curve: Curve, series: Sequence[str]) -> None:
    """Draw the curve of the case; a curve with points beyond the axis leaves the frame."""
    name, look = curve.series or "as in the case", line_of(series.index(curve.series))
    x, y = curve._replace(y=y).drawn
    if curve.dotted:
        look |= {"marker": "o", "ms": 3.0, "ls": ""}
    (line,) = axes.plot(x, under(y, curve.ceiling), label=name, lw=1.0, **look)
    line.set_ydata(np.minimum(y, FAR * curve.ceiling))
    if curve.dotted:
        _clip_above(axes, line)


def _band(axes: Axes, held: Interval, place: int, curve: Curve) -> None:
    rows = held.rows_of(place)
    bands: tuple[tuple[Array, str, str, float], ...] = (
        (held.curve_hypotheses[rows], OVER_HYPOTHESES, GREY, 0.35),
        (held.curve_tolerances[rows], OVER_TOLERANCES, BLUE, 0.25),
    )
    for ends, label, colour, alpha in bands:
        x, (low, high) = held.x[rows], np.minimum(ends, FAR * curve.ceiling).T
        look: dict[str, Any] = {"label": label, "color": colour, "alpha": alpha, "zorder": 1.2}
        if len(x) == 1 or curve.dotted:
            _clip_above(axes, axes.vlines(x, low, high, lw=3.0, **look))
        else:
            axes.fill_between(x, low, high, lw=0.0, **look)


def _clip_above(axes: Axes, drawn: Artist) -> None:
    """Clip marks and bars above the axes, not those at their sides."""
    from matplotlib.transforms import Bbox, TransformedBbox

    drawn.set_clip_path(None)
    drawn.set_clip_box(TransformedBbox(Bbox([[-ASIDE, 0.0], [1.0 + ASIDE, 1.0]]), axes.transAxes))


def _beyond(axes: Axes, held: Interval, place: int, curve: Curve) -> None:
    """Draw triangles at the edge where bars, or points of the case, are beyond an axis with fixed
    limits."""
    rows, top = held.rows_of(place), axes.get_ylim()[1]
    if not curve.dotted or np.isinf(curve.ceiling):
        return
    values = [held.curve_nominal, *held.curve_hypotheses.T, *held.curve_tolerances.T]
    outside = (np.array(values)[:, rows] > top).any(axis=0)
    if outside.any():
        look: dict[str, Any] = {"color": GREY, "ms": 4.0, "ls": "", "clip_on": False}
        axes.plot(held.x[rows][outside], np.full(outside.sum(), top), "^", label=BEYOND, **look)


def _ends(held: Interval, shown: Sequence[tuple[str, Curve]], series: Sequence[str]) -> list[End]:
    """Return the ends of the named nominal curves that reach the right edge."""
    last = [(c, held.curve_nominal[held.rows_of(held.curve.index(key))][-1]) for key, c in shown]
    return [
        End(float(y), curve.end, line_of(series.index(curve.series))["color"], 0)
        for curve, y in last
        if curve.end and np.isfinite(y)
    ]


def _finish(axes: Axes, curve: Curve) -> None:
    low, high = axis_start(float(curve.x[0]), float(curve.x[-1])), max(float(curve.x[-1]), 1.0)
    if curve.places:
        low, high = float(curve.x[0]), float(curve.x[-1])
    axes.set_xlim(low, high)
    axes.set_xticks(round_ticks(low, high, 6))
    limit_ordinate(axes, curve)
