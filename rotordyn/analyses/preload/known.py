"""Values of the preload state for comparison with references."""

from __future__ import annotations

import numpy as np

from rotordyn.analyses.preload.result import PreloadResult
from rotordyn.arrays import Array
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle
from rotordyn.results.known import at_speeds, column


def preload_sum(result: PreloadResult, spindle: Spindle) -> Array:
    """Axial load [N] that the sleeves carry together, shape (speed,).

    Without sleeves: half the sum over all bearings, which is the load of either direction.
    """
    carried = {name for sleeve in spindle.sleeves for name in sleeve.bearings}
    if not carried:
        return np.asarray(np.abs(result.axial_load).sum(axis=1) / 2.0)
    on_sleeves = [result.bearing.index(name) for name in result.bearing if name in carried]
    return np.asarray(result.axial_load[:, on_sleeves].sum(axis=1))


def sum_words(spindle: Spindle) -> str:
    """Name of ``preload_sum``: on sleeves, or in either direction."""
    return "sum of preloads " + ("on sleeves" if spindle.sleeves else "either way")


def known(reference: Reference, result: PreloadResult, spindle: Spindle | None) -> Array | None:
    """Computed values at the speeds of a reference, NaN without one; None for other quantities."""
    speeds = np.asarray(reference.speeds, float)
    if reference.quantity == "preload_sum" and spindle is not None:
        return at_speeds(speeds, result.speed, preload_sum(result, spindle))
    if reference.quantity == "sleeve_displacement":
        return column(speeds, result, "position", "body", reference.subject)
    return None
