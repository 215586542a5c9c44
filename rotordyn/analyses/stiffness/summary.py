"""Radial stiffness in a line of text."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.stiffness.result import SHORT_STOP, StiffnessResult
from rotordyn.results.described import Described
from rotordyn.results.display import RPM, STIFFNESS
from rotordyn.results.headline import Number, each_speed
from rotordyn.results.severity import Severity, of_severity
from rotordyn.results.text import over_speed, unbroken


def summary(result: StiffnessResult) -> list[str]:
    """Tangent stiffness by bearing model over speed; models with equal values together."""
    speed, tangent = result.curves
    names: dict[str, list[str]] = {}
    for name, values in zip(result.variant, tangent.T * STIFFNESS.factor, strict=True):
        names.setdefault(over_speed(values, speed), []).append(name.replace("_", " "))
    values = ", ".join(unbroken(f"{', '.join(alike)} {text}") for text, alike in names.items())
    return [f"stiffness  radial, tangent [N/µm] {values}"]


def numbers(result: StiffnessResult, _: Described) -> Iterator[Number]:
    """Tangent stiffness by bearing model."""
    for name, values in zip(result.variant, result.tangent.T * STIFFNESS.factor, strict=True):
        yield from each_speed(result, name.replace("_", " "), STIFFNESS.unit, values)


def warnings(result: StiffnessResult) -> list[str]:
    """Warnings of stops beside which there is no state, and of bearings in which the radial force
    unloads a ball."""
    return [*_lost_at_stops(result), *_unloaded(result)]


@of_severity(Severity.NO_STATE)
def _lost_at_stops(result: StiffnessResult) -> list[str]:
    """Return a warning of variants without a stable state where a stop closes."""
    own = [k for k, name in enumerate(result.variant) if name != SHORT_STOP]
    lost = np.argwhere(np.isnan(result.stop_tangent[:, own]))
    if not lost.size:
        return []
    row, column = lost[0]
    return [
        f"stiffness: {result.variant[own[column]].replace('_', ' ')} has no stable state at "
        f"{result.stop_speed[row] * RPM.factor:.0f} rpm, where a stop closes between the speeds of "
        "the case: add speeds there, or support the shaft more stiffly"
    ]


@of_severity(Severity.LOAD)
def _unloaded(result: StiffnessResult) -> list[str]:
    """Return a warning of bearings in which the radial force unloads a ball."""
    force = result.unloading_force
    if not np.isfinite(force).any():
        return []
    row, k = (int(at) for at in np.unravel_index(int(np.nanargmin(force)), force.shape))
    least = np.fmin.reduce(force)
    others = [n for n, most in zip(result.bearing, least, strict=True) if np.isfinite(most)]
    others.remove(result.bearing[k])
    also = f" ({', '.join(others)} under larger ones)" if others else ""
    angle = math.degrees(result.unloaded_azimuth[row, k])
    return [
        f"bearing {result.bearing[k]}: its ball {result.unloaded_ball[row, k]:.0f}, at "
        f"{angle:.0f}° from y towards z, loses contact under a radial force of "
        f"{force[row, k]:.4g} N at {result.speed[row] * RPM.factor:.0f} rpm{also}, and the bearing "
        "is more flexible above it: raise its preload, or keep the force below"
    ]
