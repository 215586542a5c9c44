"""Damping ratio of the modes over speed, where some of them are unstable."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.arrays import Array
from rotordyn.figures.legends import top_legend
from rotordyn.figures.style import (
    BLACK,
    CYCLE,
    FONT_SIZE,
    GREY,
    add_axes,
    marked,
    new_figure,
    speed_ticks,
)
from rotordyn.results.described import Shown
from rotordyn.results.display import RPM
from rotordyn.results.headline import broken

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LABEL = "damping ratio [%]"
BACKWARD = (0, (5, 2))
JUMP = 10.0  # times the change over the adjacent steps
ROOM = 1.3  # times the largest damping of unstable modes: more is not drawn


def damping_figure(result: CampbellResult) -> Figure:
    """Draw a line per mode, dashed for backward whirl, and the stability threshold where it is more
    than a bound."""
    figure = new_figure(168.0, 90.0)
    axes = add_axes(figure, (15.0, 11.0, 147.0, 66.0))
    _draw(axes, result, limits([result]), 8)
    top_legend(figure, axes)
    return figure


def draw_variant(axes: Axes, variant: Shown, between: tuple[float, float]) -> None:
    """Draw the curves of a variant within limits [%]."""
    _draw(axes, variant.result, between, 4)


def limits_of(variants: Sequence[Shown]) -> tuple[float, float]:
    """Return the limits for all variants [%]."""
    return limits([variant.result for variant in variants])


def _draw(axes: Axes, result: CampbellResult, between: tuple[float, float], most: int) -> None:
    axes.set_xlabel("speed [rpm]", fontsize=FONT_SIZE)
    axes.set_ylabel(LABEL, fontsize=FONT_SIZE)
    speed_ticks(axes, float(result.speed[-1]) * RPM.factor, most)
    axes.set_ylim(*between)
    rpm = result.speed * RPM.factor
    axes.axhline(0.0, color=BLACK, lw=0.8)
    families: dict[str, int] = {}
    for name, ratio, whirl in zip(result.mode, result.damping_ratio.T, result.whirl.T, strict=True):
        if not np.any(ratio * 100.0 < axes.get_ylim()[1]):
            continue
        family = name.removesuffix(" forward").removesuffix(" backward")
        style = families.setdefault(family, len(families))
        look: dict[str, Any] = {"color": CYCLE[style % len(CYCLE)], "lw": 1.2, **marked(style)}
        back = np.nanmean(whirl) < 0.0
        x, curve = _at_jumps(rpm, ratio * 100.0, np.ptp(axes.get_ylim()))
        if name == result.unstable_mode and not result.threshold_is_bound:
            x, curve = _through_zero(x, curve, result.stability_threshold * RPM.factor)
        axes.plot(x, curve, ls=BACKWARD if back else "-", label=name, **look)
    threshold = result.stability_threshold * RPM.factor
    if math.isfinite(threshold) and not result.threshold_is_bound:
        axes.axvline(threshold, color=GREY, lw=0.9, ls=":", label="stability threshold")
        right = threshold > 0.6 * rpm[-1]
        axes.annotate(
            f"{threshold:.0f} rpm",
            (threshold, 0.94),
            xycoords=("data", "axes fraction"),
            xytext=(-3.0 if right else 3.0, 0.0),
            textcoords="offset points",
            ha="right" if right else "left",
            fontsize=FONT_SIZE - 1.0,
        )


def _through_zero(rpm: Array, ratio: Array, threshold: float) -> tuple[Array, Array]:
    """Insert the zero of the first unstable mode at the threshold into its curve, unless it jumps
    there."""
    row = int(np.searchsorted(rpm, threshold))
    adjacent = ratio[max(row - 1, 0) : row + 1]
    if threshold in rpm or not np.isfinite(adjacent).all():
        return rpm, ratio
    return np.insert(rpm, row, threshold), np.insert(ratio, row, 0.0)


def _at_jumps(rpm: Array, ratio: Array, range_: float) -> tuple[Array, Array]:
    """Break the curve at a jump, as where hysteretic damping changes sign: a step much larger than
    the adjacent ones."""
    step = np.abs(np.diff(ratio))
    if step.size < 3:
        return rpm, ratio
    adjacent = np.maximum(np.append(0.0, step[:-1]), np.append(step[1:], 0.0))
    return broken(rpm, ratio, (step > JUMP * adjacent) & (step > 0.05 * range_))


def limits(results: Sequence[CampbellResult]) -> tuple[float, float]:
    """Return limits of the damping ratio [%], for modes that are unstable somewhere."""
    unstable = {name for r in results for name in np.array(r.mode)[r.unstable.any(axis=0)]}
    drawn = [
        r.damping_ratio[:, [name in unstable for name in r.mode]].ravel() * 100.0 for r in results
    ]
    values = np.concatenate(drawn)
    high = ROOM * max(float(np.nanmax(values)), 0.0)
    return min(ROOM * float(np.nanmin(values)), -high / 4.0), high
