"""Stable depth of cut and chatter frequency over speed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.analyses.stability_lobes.figures import HIGH, LEAST_SPEEDS, MEASURED
from rotordyn.analyses.stability_lobes.pockets import KEPT
from rotordyn.analyses.stability_lobes.result import REMOVAL, StabilityLobesResult, banded
from rotordyn.analyses.stability_lobes.spec import FLIP, FOLD, REPEATING, StabilityLobesSpec
from rotordyn.arrays import Array
from rotordyn.figures.legends import top_legend
from rotordyn.figures.style import (
    BLACK,
    BLUE,
    FONT_SIZE,
    GREEN,
    GREY,
    ORANGE,
    RED,
    add_axes,
    axis_start,
    new_figure,
    speed_ticks,
)
from rotordyn.results.display import MILLIMETRE, RPM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ROOM = 1.1
MARKED, SMALL = 4, 6.0
SIZE = 3.5  # of marks
MARKS = ((FLIP, RED, "-"), (FOLD, ORANGE, (0, (1.0, 0.7))))
APART = 0.03  # of the axis, between numbers of pockets
ABOVE = 9.0  # [mm] of the second axis
ROW = 3.6  # [mm] of a line below the figure


def lobes_figure(result: StabilityLobesResult, spec: StabilityLobesSpec) -> Figure:
    """Draw the limit over speed and that at rest, with removal rate and tooth passing frequency as
    second axes; below, chatter frequency and nearest mode, and a list of pockets."""
    rpm = result.cutting_speed * RPM.factor
    lines = len(rpm) >= LEAST_SPEEDS
    marked = _marked(result)
    foot = ROW * (1 + (len(marked) + 1) // 2) if marked else 0.0
    figure = new_figure(168.0, 128.0 + foot)
    upper = add_axes(figure, (15.0, 47.0 + foot, 135.0, 66.0), "", "depth of cut [mm]")
    lower = add_axes(figure, (15.0, 11.0 + foot, 135.0, 30.0), "speed [rpm]", "chatter [Hz]")
    depth, at_rest = (limit * MILLIMETRE.factor for limit in (result.depth, result.at_rest))
    tested, even = result.measured * MILLIMETRE.factor, result.even * MILLIMETRE.factor
    top = _height([depth, at_rest, tested, even])
    if banded(result):
        _band(upper, result, rpm, top, lines=lines)
    if lines:
        drawn = _clipped(depth, top)
        upper.fill_between(rpm, 0.0, drawn, color=BLUE, alpha=0.12, lw=0.0, label="stable")
    upper.set_ylim(0.0, top)
    draw = partial(_draw, upper, rpm, lines=lines)
    draw(depth, "with the receptance at every speed", {}, color=BLUE, lw=1.2)
    draw(at_rest, "with the receptance at rest", {"marker": "x"}, color=GREY, lw=1.0, ls="--")
    if np.isfinite(tested).any():
        marks = {"marker": "+", "ms": 4.5}
        draw(tested, MEASURED, marks, color=BLACK, lw=1.0, ls=":")
    if result.motor:
        marks = {"marker": "v", "ms": 3.0}
        by_motor = result.motor_depth * MILLIMETRE.factor
        draw(by_motor, f"limit of the motor ({result.motor})", marks, color=GREEN, lw=1.4, ls=":")
    if np.isfinite(even).any():
        marks = {"marker": "s", "ms": 3.0}
        draw(even, "with evenly spaced teeth", marks, color=BLACK, lw=0.8, ls="-.")
    for kind, colour, line in MARKS:
        shown = np.where(np.array(result.loss) == kind, depth, np.nan)
        if not np.isnan(shown).all():
            draw(shown, REPEATING[kind], {}, color=colour, lw=2.0, ls=line)
    if not lines and any((limit > top).any() for limit in (depth, at_rest, tested, even)):
        upper.plot([], [], "^", color=GREY, ms=SIZE, mfc="none", label="deeper than drawn")
    upper.tick_params(labelbottom=False)
    _pockets(upper, result, marked, top)
    _pocket_list(figure, result, marked)
    _removal_axis(upper, result, float(rpm[-1]))
    _passing_axis(upper, spec)
    lower.plot(rpm, result.chatter, ".", ms=2.5, color=BLUE, label="chatter")
    lower.plot(rpm, result.mode_frequency, "_", ms=2.5, color=GREY, label="nearest mode")
    lower.set_ylim(0.0, float(np.nanmax(result.chatter, initial=1.0)) * ROOM)
    top_legend(figure, upper, lower, above=ABOVE)
    for axes in (upper, lower):
        speed_ticks(axes, float(rpm[-1]), low=axis_start(float(rpm[0]), float(rpm[-1])))
    return figure


def _draw(
    axes: Axes,
    rpm: Array,
    depth: Array,
    label: str,
    marks: Mapping[str, Any],
    *,
    lines: bool,
    **look: Any,
) -> None:
    """Draw depths as a line that may leave the frame, with a note in the legend if all of it is
    above, or as ``marks``, filled if empty; depths above the frame are triangles at its edge."""
    top = axes.get_ylim()[1]
    if lines:
        above = "" if (depth <= top).any() else ": deeper than drawn"
        axes.plot(rpm, _clipped(depth, top), label=f"{label}{above}", **look)
        return
    marks = {"marker": "o", "ms": SIZE, "mfc": "none" if marks else look["color"], **marks}
    look |= {**marks, "ls": "", "clip_on": False}
    axes.plot(rpm, np.where(depth <= top, depth, np.nan), label=label, **look)
    deep = depth > top
    axes.plot(rpm[deep], np.full(deep.sum(), top), **look | {"marker": "^"})


def _clipped(depth: Array, top: float) -> Array:
    return np.clip(depth, 0.0, 2.0 * top)


def _band(axes: Axes, result: StabilityLobesResult, rpm: Array, top: float, *, lines: bool) -> None:
    """Draw the band over intervals and sources: an area, or vertical lines at single speeds."""
    low, high = (_clipped(limit * MILLIMETRE.factor, top) for limit in (result.least, result.most))
    look: dict[str, Any] = {"color": GREY, "label": "band of intervals and sources"}
    if lines:
        axes.fill_between(rpm, low, high, alpha=0.25, lw=0.0, **look)
    else:
        axes.vlines(rpm, low, high, alpha=0.4, lw=2.5, **look)


def _marked(result: StabilityLobesResult) -> list[int]:
    """Return the deepest pockets in order of speed."""
    return sorted(range(len(result.pocket))[:MARKED], key=lambda k: float(result.pocket_speed[k]))


def _pockets(axes: Axes, result: StabilityLobesResult, marked: Sequence[int], top: float) -> None:
    """Draw the ``marked`` pockets over the speeds that keep 80 % of their depth, numbered unless
    the number of a deeper one is too near."""
    first, last = (float(result.cutting_speed[row]) for row in (0, -1))
    span, numbered = last - axis_start(first, last), list[float]()
    for number, k in sorted(enumerate(marked, start=1), key=lambda pair: pair[1]):
        depth = min(result.pocket_depth[k] * MILLIMETRE.factor, 0.97 * top)
        ends = np.array([result.pocket_from[k], result.pocket_to[k]]) * RPM.factor
        axes.plot(ends, [KEPT * depth] * 2, color=BLACK, lw=1.0, marker="|", ms=4.0)
        speed = float(result.pocket_speed[k])
        if any(abs(speed - other) < APART * span for other in numbered):
            continue
        numbered.append(speed)
        look: dict[str, Any] = {
            "boxstyle": "circle,pad=0.15",
            "fc": "white",
            "ec": BLACK,
            "lw": 0.6,
        }
        at = speed * RPM.factor, KEPT * depth
        axes.annotate(
            str(number),
            at,
            (0.0, -7.0),
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=SMALL,
            bbox=look,
        )


def _pocket_list(figure: Figure, result: StabilityLobesResult, marked: Sequence[int]) -> None:
    """Write speed and removal rate of the ``marked`` pockets at the foot of the figure."""
    if not marked:
        return
    width, height = figure.get_size_inches() * 25.4
    rows = (len(marked) + 1) // 2
    look: dict[str, Any] = {"ha": "left", "va": "bottom", "fontsize": FONT_SIZE - 1.0}
    head = f"deepest pockets, over the speeds with {KEPT:.0%} of their depth"
    figure.text(15.0 / width, (1.5 + ROW * rows) / height, head, **look)
    for number, k in enumerate(marked, start=1):
        row, column = (number - 1) % rows, (number - 1) // rows
        low, top, high = (
            float(speeds[k]) * RPM.factor
            for speeds in (result.pocket_from, result.pocket_speed, result.pocket_to)
        )
        rate = result.pocket_removal[k] * REMOVAL.factor
        text = f"{number}: {top:.0f} rpm, {rate:.0f} {REMOVAL.unit}, from {low:.0f} to {high:.0f}"
        at = (15.0 + 70.0 * column) / width, (1.5 + ROW * (rows - 1 - row)) / height
        figure.text(*at, f"{text} rpm", **look)


def _height(depths: Sequence[Array]) -> float:
    """Return the highest depth drawn [mm]."""
    finite = np.concatenate([depth[np.isfinite(depth) & (depth > 0.0)] for depth in depths])
    if not finite.size:
        return 1.0
    return float(min(ROOM * finite.max(), HIGH * np.median(finite)))


def _passing_axis(axes: Axes, spec: StabilityLobesSpec) -> None:
    """Add a second axis of the tooth passing frequency, its label with cutter and workpiece."""
    scale = (1 if spec.turning else spec.teeth) / 60.0

    def hertz(rpm: Any) -> Any:
        return rpm * scale

    def rpm(hertz: Any) -> Any:
        return hertz / scale

    second = axes.secondary_xaxis("top", functions=(hertz, rpm))
    assert spec.diameter is not None, "of the tool, where the case gives none"
    size = f"{spec.diameter * MILLIMETRE.factor:.4g} mm"
    label = f"turning of {size}: revolutions per second [Hz]"
    if not spec.turning:
        how = "slot" if spec.milling == "slot" else f"{spec.milling} {spec.immersion:.0%}"
        teeth = f"{spec.teeth} uneven teeth" if spec.uneven else f"{spec.teeth} teeth"
        cutter = f"{teeth} on {size}, {how}, {spec.pairs[0][0] / 1e6:.0f} MPa"
        label = f"{cutter}: tooth passing [Hz]"
    second.set_xlabel(label, fontsize=FONT_SIZE)
    second.tick_params(labelsize=FONT_SIZE)


def _removal_axis(axes: Axes, result: StabilityLobesResult, last: float) -> None:
    """Add a second axis of the removal rate of a depth at the highest speed."""
    finite = np.isfinite(result.removal) & (result.depth > 0.0) & np.isfinite(result.depth)
    if not finite.any():
        return
    row = int(np.flatnonzero(finite)[-1])
    per_depth = result.removal[row] / result.depth[row] / result.cutting_speed[row]
    scale = per_depth * last / RPM.factor * REMOVAL.factor / MILLIMETRE.factor
    second = axes.secondary_yaxis(
        "right", functions=(lambda mm: mm * scale, lambda rate: rate / scale)
    )
    second.set_ylabel(f"removal rate at {last:.0f} rpm [{REMOVAL.unit}]", fontsize=FONT_SIZE)
    second.tick_params(labelsize=FONT_SIZE)
