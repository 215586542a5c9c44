"""Stable depth of cut and chatter frequency over speed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.pockets import KEPT
from rotordyn.analyses.stability_lobes.result import REMOVAL, StabilityLobesResult
from rotordyn.analyses.stability_lobes.spec import FLIP, StabilityLobesSpec
from rotordyn.figures.legends import legend, top_legend
from rotordyn.figures.style import (
    BLACK,
    BLUE,
    FONT_SIZE,
    GREY,
    RED,
    add_axes,
    new_figure,
    speed_ticks,
)
from rotordyn.results.display import MILLIMETRE, RPM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
ROOM = 1.1
MARKED, SMALL = 4, 6.0
APART = 0.11  # of the axis, between marks of pockets
ABOVE = 9.0  # [mm] of the second axis
LEAST_SPEEDS = 100  # for lines: lobes are narrow, and of fewer speeds only points are known
HIGH = 4.0  # times the median limit: above that pockets are cut off


def lobes_figure(result: StabilityLobesResult, spec: StabilityLobesSpec) -> Figure:
    """Limit over speed with that at rest; removal rate and the frequency at which teeth pass as
    second axes; below the chatter frequency and the mode next to it."""
    figure = new_figure(168.0, 128.0)
    upper = add_axes(figure, (15.0, 47.0, 135.0, 66.0), "", "depth of cut [mm]")
    lower = add_axes(figure, (15.0, 11.0, 135.0, 30.0), "speed [rpm]", "chatter [Hz]")
    rpm = result.cutting_speed * RPM.factor
    depth, rest = (each * MILLIMETRE.factor for each in (result.depth, result.at_rest))
    tested = result.measured * MILLIMETRE.factor
    top = _height([depth, rest, tested])
    drawn = np.clip(np.nan_to_num(depth, posinf=2.0 * top), 0.0, 2.0 * top)
    lines = len(rpm) >= LEAST_SPEEDS
    if lines:
        _band(upper, result, rpm, top)
        upper.fill_between(rpm, 0.0, drawn, color=BLUE, alpha=0.12, lw=0.0, label="stable")
    look: dict[str, Any] = {"ls": "-"} if lines else {"ls": "", "marker": "o", "ms": 3.5}
    upper.plot(rpm, drawn, color=BLUE, lw=1.2, label="at every speed's own receptance", **look)
    still = np.clip(np.nan_to_num(rest, posinf=2.0 * top), 0.0, 2.0 * top)
    look = {"ls": "--"} if lines else {"ls": "", "marker": "x", "ms": 3.5}
    upper.plot(rpm, still, color=GREY, lw=1.0, label="by the receptance at rest", **look)
    if np.isfinite(tested).any():
        look = {"ls": ":"} if lines else {"ls": "", "marker": "+", "ms": 4.5}
        shown = np.clip(np.nan_to_num(tested, posinf=2.0 * top), 0.0, 2.0 * top)
        upper.plot(rpm, shown, color=BLACK, lw=1.0, label="on the measured spindle", **look)
    flips = np.array(result.loss) == FLIP
    if flips.any():
        shown = np.where(flips, drawn, np.nan)
        upper.plot(rpm, shown, color=RED, lw=2.0, label="period doubling")
    upper.set_ylim(0.0, top)
    upper.tick_params(labelbottom=False)
    if lines:
        _pockets(upper, result, top)
    _removal(upper, result, float(rpm[-1]))
    _passing(upper, spec)
    lower.plot(rpm, result.chatter, ".", ms=2.5, color=BLUE, label="chatter")
    lower.plot(rpm, result.mode_frequency, "_", ms=2.5, color=GREY, label="nearest mode")
    lower.set_ylim(0.0, float(np.nanmax(result.chatter, initial=1.0)) * ROOM)
    legend(lower, loc="lower left")
    top_legend(figure, upper, above=ABOVE)
    for axes in (upper, lower):
        speed_ticks(axes, float(rpm[-1]))
    return figure


def _band(axes: Axes, result: StabilityLobesResult, rpm: Array, top: float) -> None:
    """Limits over the intervals of the case, where it gives any."""
    if np.allclose(result.least, result.most, rtol=1e-12, equal_nan=True):
        return
    low, high = (
        np.clip(np.nan_to_num(each * MILLIMETRE.factor, posinf=2.0 * top), 0.0, 2.0 * top)
        for each in (result.least, result.most)
    )
    axes.fill_between(rpm, low, high, color=GREY, alpha=0.25, lw=0.0, label="band of the intervals")


def _pockets(axes: Axes, result: StabilityLobesResult, top: float) -> None:
    """The deepest pockets with what they remove, over the speeds that hold 80 % of them."""
    span, marked = float(result.cutting_speed[-1]), list[float]()
    for k in range(len(result.pocket)):
        own = float(result.pocket_speed[k])
        if len(marked) == MARKED or any(abs(own - other) < APART * span for other in marked):
            continue
        marked.append(own)
        depth = min(result.pocket_depth[k] * MILLIMETRE.factor, 0.97 * top)
        ends = np.array([result.pocket_from[k], result.pocket_to[k]]) * RPM.factor
        axes.plot(ends, [KEPT * depth] * 2, color=BLACK, lw=1.0, marker="|", ms=4.0)
        rate = result.pocket_removal[k] * REMOVAL.factor
        rpm = own * RPM.factor
        axes.annotate(
            f"{rpm:.0f} rpm\n{rate:.0f} {REMOVAL.unit}",
            (rpm, KEPT * depth),
            xytext=(0.0, -2.0),
            textcoords="offset points",
            ha="center",
            va="top",
            fontsize=SMALL,
        )


def _height(depths: Sequence[Array]) -> float:
    """Highest depth drawn [mm]."""
    known = np.concatenate([each[np.isfinite(each)] for each in depths])
    if not known.size:
        return 1.0
    return float(min(ROOM * known.max(), HIGH * np.median(known)))


def _passing(axes: Axes, spec: StabilityLobesSpec) -> None:
    """A second axis: the frequency at which teeth pass, and what is cut with what."""
    scale = (1 if spec.turning else spec.teeth) / 60.0

    def hertz(rpm: Any) -> Any:
        return rpm * scale

    def rpm(hertz: Any) -> Any:
        return hertz / scale

    other = axes.secondary_xaxis("top", functions=(hertz, rpm))
    size = f"{spec.diameter * MILLIMETRE.factor:.4g} mm"
    said = f"turning of {size}: revolutions by second [Hz]"
    if not spec.turning:
        how = "slot" if spec.milling == "slot" else f"{spec.milling} {spec.immersion:.0%}"
        what = f"{spec.teeth} teeth on {size}, {how}, {spec.pairs[0][0] / 1e6:.0f} MPa"
        said = f"{what}: a tooth passes at [Hz]"
    other.set_xlabel(said, fontsize=FONT_SIZE)
    other.tick_params(labelsize=FONT_SIZE)


def _removal(axes: Axes, result: StabilityLobesResult, last: float) -> None:
    """A second axis: removal rate of a depth at the highest speed."""
    known = np.isfinite(result.removal) & (result.depth > 0.0) & np.isfinite(result.depth)
    if not known.any():
        return
    row = int(np.flatnonzero(known)[-1])
    per_depth = result.removal[row] / result.depth[row] / result.cutting_speed[row]
    scale = per_depth * last / RPM.factor * REMOVAL.factor / MILLIMETRE.factor
    other = axes.secondary_yaxis(
        "right", functions=(lambda mm: mm * scale, lambda rate: rate / scale)
    )
    other.set_ylabel(f"removal rate at {last:.0f} rpm [{REMOVAL.unit}]", fontsize=FONT_SIZE)
    other.tick_params(labelsize=FONT_SIZE)
