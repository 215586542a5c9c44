"""Stable depth of cut and chatter frequency over speed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.result import REMOVAL, StabilityLobesResult
from rotordyn.analyses.stability_lobes.spec import FLIP
from rotordyn.figures.legends import legend
from rotordyn.figures.style import BLUE, FONT_SIZE, GREY, RED, add_axes, new_figure, speed_ticks
from rotordyn.results.display import MILLIMETRE, RPM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
ROOM = 1.1
LEAST_SPEEDS = 100  # for lines: lobes are narrow, and of fewer speeds only points are known
HIGH = 4.0  # times the median limit: above that pockets are cut off


def lobes_figure(result: StabilityLobesResult) -> Figure:
    """Limit over speed with that at rest, lines of constant removal rate as a second axis; below
    the chatter frequency and the mode next to it."""
    figure = new_figure(168.0, 120.0)
    upper = add_axes(figure, (15.0, 47.0, 135.0, 66.0), "", "depth of cut [mm]")
    lower = add_axes(figure, (15.0, 11.0, 135.0, 30.0), "speed [rpm]", "chatter [Hz]")
    rpm = result.cutting_speed * RPM.factor
    depth, rest = (each * MILLIMETRE.factor for each in (result.depth, result.at_rest))
    top = _height([depth, rest])
    drawn = np.clip(np.nan_to_num(depth, posinf=2.0 * top), 0.0, 2.0 * top)
    lines = len(rpm) >= LEAST_SPEEDS
    if lines:
        upper.fill_between(rpm, 0.0, drawn, color=BLUE, alpha=0.12, lw=0.0, label="stable")
    look: dict[str, Any] = {"ls": "-"} if lines else {"ls": "", "marker": "o", "ms": 3.5}
    upper.plot(rpm, drawn, color=BLUE, lw=1.2, label="at every speed's own receptance", **look)
    still = np.clip(np.nan_to_num(rest, posinf=2.0 * top), 0.0, 2.0 * top)
    look = {"ls": "--"} if lines else {"ls": "", "marker": "x", "ms": 3.5}
    upper.plot(rpm, still, color=GREY, lw=1.0, label="by the receptance at rest", **look)
    flips = np.array(result.loss) == FLIP
    if flips.any():
        shown = np.where(flips, drawn, np.nan)
        upper.plot(rpm, shown, color=RED, lw=2.0, label="period doubling")
    upper.set_ylim(0.0, top)
    upper.tick_params(labelbottom=False)
    legend(upper, loc="upper left")
    _removal(upper, result, float(rpm[-1]), top)
    lower.plot(rpm, result.chatter, ".", ms=2.5, color=BLUE, label="chatter")
    lower.plot(rpm, result.mode_frequency, "_", ms=2.5, color=GREY, label="nearest mode")
    lower.set_ylim(0.0, float(np.nanmax(result.chatter, initial=1.0)) * ROOM)
    legend(lower, loc="lower left")
    for axes in (upper, lower):
        speed_ticks(axes, float(rpm[-1]))
    return figure


def _height(depths: Sequence[Array]) -> float:
    """Highest depth drawn [mm]."""
    known = np.concatenate([each[np.isfinite(each)] for each in depths])
    if not known.size:
        return 1.0
    return float(min(ROOM * known.max(), HIGH * np.median(known)))


def _removal(axes: Axes, result: StabilityLobesResult, last: float, top: float) -> None:
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
