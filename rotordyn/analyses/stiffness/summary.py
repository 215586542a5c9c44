"""Radial stiffness in a line of text."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.stiffness.result import StiffnessResult
from rotordyn.results.described import Described
from rotordyn.results.display import RPM, STIFFNESS
from rotordyn.results.headline import Number, each_speed
from rotordyn.results.text import over_speed, unbroken


def summary(result: StiffnessResult) -> list[str]:
    """Tangent stiffness by bearing model over speed."""
    speed, tangent = result.curves
    values = ", ".join(
        unbroken(f"{name.replace('_', ' ')} {over_speed(values, speed)}")
        for name, values in zip(result.variant, tangent.T * STIFFNESS.factor, strict=True)
    )
    return [f"stiffness  radial, tangent [N/µm] {values}"]


def numbers(result: StiffnessResult, _: Described) -> Iterator[Number]:
    """Tangent stiffness by bearing model."""
    for name, values in zip(result.variant, result.tangent.T * STIFFNESS.factor, strict=True):
        yield from each_speed(result, name.replace("_", " "), STIFFNESS.unit, values)


def warnings(result: StiffnessResult) -> list[str]:
    """Warnings of bearings in which the radial force unloads a ball."""
    sentences = []
    for k, (name, force) in enumerate(zip(result.bearing, result.unloading_force.T, strict=True)):
        if not np.isfinite(force).any():
            continue
        row = int(np.nanargmin(force))
        angle = math.degrees(result.unloaded_azimuth[row, k])
        sentences.append(
            f"bearing {name}: its ball {result.unloaded_ball[row, k]:.0f}, at {angle:.0f}° from y "
            f"towards z, loses contact under a radial force of {force[row]:.4g} N at "
            f"{result.speed[row] * RPM.factor:.0f} rpm, and the bearing is more flexible above it: "
            "raise its preload, or keep the force below"
        )
    return sentences
