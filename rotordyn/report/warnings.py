"""What results call for attention to, in one sentence each."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.bearing.result import BearingMapResult
from rotordyn.analyses.bearing.solve import under
from rotordyn.analyses.bearing.summary import cut_off
from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.analyses.preload.result import PreloadResult
from rotordyn.analyses.section_forces.result import SectionForcesResult
from rotordyn.machine.limits import WARNING_PRESSURE
from rotordyn.results.display import RPM


def result_warnings(results: Mapping[str, Any]) -> list[str]:
    """Sentences on modes that change with the model, unstable modes, bearings too hard pressed or
    slipping, contact ellipses cut off, shafts twisted."""
    found = (_unsettled, _unstable_modes, _pressures, _slips, _ellipses, _twists)
    return [sentence for look in found for sentence in look(results)]


def _unsettled(results: Mapping[str, Any]) -> list[str]:
    result = results.get("campbell")
    if not isinstance(result, CampbellResult) or not result.unsettled:
        return []
    return [f"modes are less sure than asked for: {result.unsettled}"]


def _unstable_modes(results: Mapping[str, Any]) -> list[str]:
    result = results.get("campbell")
    if not isinstance(result, CampbellResult):
        return []
    found = []
    onward = " on" if result.unstable[-1].any() else ""  # or stable again before the top speed
    if 0.0 < result.stability_threshold < result.speed[-1]:
        found.append(
            f"{result.first_to_grow} grows by itself from "
            f"{result.stability_threshold * RPM.factor:.0f} rpm{onward}"
        )
    for name, ratio, growing in zip(
        result.mode, result.damping_ratio.T, result.unstable.T, strict=True
    ):
        at = np.flatnonzero(growing)
        if at.size:
            found.append(
                f"{name} is unstable at {result.speed[at[0]] * RPM.factor:.0f} rpm"
                + (f" and {at.size - 1} more of the speeds" if at.size > 1 else "")
                + f" (damping ratio down to {np.nanmin(ratio) * 100.0:.2g} %)"
            )
    return found


def _pressures(results: Mapping[str, Any]) -> list[str]:
    found = []
    if isinstance(result := results.get("preload"), PreloadResult):
        peak = np.fmax(result.inner_pressure, result.outer_pressure)
        named = zip(result.bearing, peak.T, strict=True)
        found = [_pressed(f"bearing {name}", result.speed, own) for name, own in named]
    if isinstance(single := results.get("bearing"), BearingMapResult):
        peak = np.fmax(single.inner_pressure, single.outer_pressure)
        found += [
            _pressed(f"under {under(single, k)}", single.speed, own) for k, own in enumerate(peak.T)
        ]
    return [sentence for sentence in found if sentence]


def _slips(results: Mapping[str, Any]) -> list[str]:
    found = []
    if isinstance(result := results.get("preload"), PreloadResult):
        named = zip(result.bearing, result.slipping.T, strict=True)
        found = [_slipping(f"bearing {name}", result.speed, own) for name, own in named]
    if isinstance(single := results.get("bearing"), BearingMapResult):
        found += [
            _slipping(f"under {under(single, k)}", single.speed, own)
            for k, own in enumerate(single.slipping.T)
        ]
    return [sentence for sentence in found if sentence]


def _ellipses(results: Mapping[str, Any]) -> list[str]:
    single = results.get("bearing")
    return cut_off(single) if isinstance(single, BearingMapResult) else []


def _slipping(what: str, speed: NDArray[np.float64], races: NDArray[np.str_]) -> str:
    """A warning where balls slip on a race at some speed, else nothing."""
    at = np.flatnonzero(races != "")
    if not at.size:
        return ""
    names = {"inner": "the inner race", "outer": "the outer race", "both": "both races"}
    return (
        f"{what}: the balls slip on {names[str(races[at[0]])]} from "
        f"{speed[at[0]] * RPM.factor:.0f} rpm on (friction as given)"
    )


def _pressed(what: str, speed: NDArray[np.float64], peak: NDArray[np.float64]) -> str:
    """A warning where the pressure passes the limit at some speed, else nothing."""
    over = np.flatnonzero(peak > WARNING_PRESSURE)
    if not over.size:
        return ""
    return (
        f"{what}: contact pressure {np.nanmax(peak) / 1e9:.2f} GPa is above "
        f"{WARNING_PRESSURE / 1e9:g} GPa, from {speed[over[0]] * RPM.factor:.0f} rpm on"
    )


def _twists(results: Mapping[str, Any]) -> list[str]:
    result = results.get("section_forces")
    if not isinstance(result, SectionForcesResult):
        return []
    most = np.nanmax(np.abs(result.twist_between), axis=0)
    named = zip(result.twist_limit, most, result.allowed_twist, strict=True)
    return [
        f"twist {name}: {np.degrees(angle):.4g} deg is above the {np.degrees(allowed):.4g} deg "
        "allowed"
        for name, angle, allowed in named
        if angle > allowed
    ]
