"""Preload over temperature difference in a few lines of text."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.thermal_preload.result import ThermalPreloadResult
from rotordyn.arrays import Array
from rotordyn.results.described import Described
from rotordyn.results.display import RPM
from rotordyn.results.headline import Number, each_speed
from rotordyn.results.severity import Severity, of_severity
from rotordyn.results.text import unbroken


def summary(result: ThermalPreloadResult) -> list[str]:
    """Axial loads at the ends of the differences, at the first and last speed."""
    lines = []
    for index in sorted({0, len(result.speed) - 1}):
        load = result.axial_load[index]
        solved = np.flatnonzero(~np.isnan(load).any(axis=1))
        if not solved.size:
            continue
        first, last = solved[0], solved[-1]
        loads = ", ".join(
            unbroken(f"{name} {load[first, k]:.0f} → {load[last, k]:.0f}")
            for k, name in enumerate(result.bearing)
        )
        ends = f"{result.difference[first]:+g} K → {result.difference[last]:+g} K"
        lines.append(
            f"warming    at {result.speed[index] * RPM.factor:.0f} rpm, {ends} [N]: {loads}"
        )
        lines += _unsolved(result, index)
    return lines


def _unsolved(result: ThermalPreloadResult, index: int) -> list[str]:
    """The first difference without a state at a speed, and why."""
    places = np.flatnonzero(result.state[index] != "")
    if not places.size:
        return []
    at = f"{result.difference[places[0]]:+g} K"
    many = f" and {places.size - 1} more" if places.size > 1 else ""
    return [f"           no state at {at}{many}: {result.state[index, places[0]]}"]


def numbers(result: ThermalPreloadResult, _: Described) -> Iterator[Number]:
    """The largest axial load of any bearing, and the difference of least amount without a
    state, over speed."""
    largest = np.nan_to_num(result.axial_load, nan=-np.inf).max(axis=(1, 2))
    largest = np.where(np.isinf(largest), np.nan, largest)
    yield from each_speed(result, "load", "N", largest, digits=0)
    yield from each_speed(result, "difference without a state", "K", _least_unsolved(result))


@of_severity(Severity.NO_STATE)
def warnings(result: ThermalPreloadResult) -> Iterator[str]:
    """Warning of differences without a state, where the preload is lost or too high."""
    least = _least_unsolved(result)
    rows = np.flatnonzero(np.isfinite(least))
    if not rows.size:
        return
    row = rows[np.abs(least[rows]).argmin()]
    why = result.state[row, np.flatnonzero(result.difference == least[row])[0]]
    more = int((result.state[rows] != "").sum()) - 1
    many = f" (and in {more} more states)" if more else ""
    yield f"thermal_preload: at {least[row]:+g} K{many} {why}"


def _least_unsolved(result: ThermalPreloadResult) -> Array:
    """Difference of least amount without a state [K], at every speed with a state in the case;
    NaN where all differences have one."""
    least = np.full(len(result.speed), np.nan)
    for row, outcome in enumerate(result.outcome):
        places = np.flatnonzero(result.state[row] != "")
        if not outcome and places.size:
            least[row] = result.difference[places[np.abs(result.difference[places]).argmin()]]
    return least
