"""Preload over temperature difference in a few lines of text."""

from __future__ import annotations

import numpy as np

from rotordyn.analyses.thermal_preload.result import ThermalPreloadResult
from rotordyn.results.display import RPM
from rotordyn.results.text import unbroken


def summary(result: ThermalPreloadResult) -> list[str]:
    """Axial loads at the ends of the differences, at the first and last speed."""
    lines = []
    for index in sorted({0, len(result.speed) - 1}):
        load = result.axial_load[index]
        known = np.flatnonzero(~np.isnan(load).any(axis=1))
        if not known.size:
            continue
        first, last = known[0], known[-1]
        words = ", ".join(
            unbroken(f"{name} {load[first, k]:.0f} → {load[last, k]:.0f}")
            for k, name in enumerate(result.bearing)
        )
        ends = f"{result.difference[first]:+g} K → {result.difference[last]:+g} K"
        lines.append(
            f"warming    at {result.speed[index] * RPM.factor:.0f} rpm, {ends} [N]: {words}"
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
