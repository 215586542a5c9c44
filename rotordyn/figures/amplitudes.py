"""Axes of amplitude and phase."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rotordyn.arrays import Array
from rotordyn.figures.style import log_ticks

if TYPE_CHECKING:
    from matplotlib.axes import Axes

DECADES = 6.0  # of an axis, at most


def wrapped_phase(phase: Array) -> Array:
    """Return ``phase`` [deg], NaN where it wraps, so that no line is drawn there."""
    jumps = np.flatnonzero(np.abs(np.diff(phase)) > 270.0) + 1
    broken = phase.copy()
    broken[jumps] = np.nan
    return broken


def phase_axis(axes: Axes) -> None:
    """Set an ordinate from −180 to 180 deg with ticks at every quarter of a turn."""
    axes.set_ylim(-190.0, 190.0)
    axes.set_yticks([-180.0, -90.0, 0.0, 90.0, 180.0])


def log_axis(axes: Axes) -> None:
    """Set a logarithmic ordinate with few round ticks and no superscripts, unless all values drawn
    are zero."""
    from matplotlib.ticker import NullFormatter, NullLocator

    drawn = [np.asarray(line.get_ydata(), float) for line in axes.get_lines()]
    if drawn and not any((values > 0.0).any() for values in drawn):
        return
    axes.set_yscale("log")
    low, high = axes.get_ylim()
    ticks = log_ticks(low, high)
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.set_yticks([v for v, _ in ticks], [name for _, name in ticks])
    axes.set_ylim(low, high)


def decades(axes: Axes, highest: float = np.inf) -> None:
    """Set a logarithmic ordinate over a few decades of the values drawn, up to ``highest``."""
    values = np.concatenate([np.asarray(line.get_ydata(), float) for line in axes.get_lines()])
    values = values[np.isfinite(values) & (values <= highest)]
    if values.size:
        high = 1.6 * float(values.max())
        axes.set_ylim(max(0.6 * float(values.min()), high / 10.0**DECADES), high)
        log_axis(axes)
