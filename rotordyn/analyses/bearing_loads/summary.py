"""Loads of bearings and balls in a few lines of text."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.bearing_loads.result import BearingLoadsResult
from rotordyn.results.described import Described
from rotordyn.results.display import RPM
from rotordyn.results.headline import Number, each_speed
from rotordyn.results.severity import Severity, of_severity
from rotordyn.results.text import over_speed, unbroken


def summary(result: BearingLoadsResult) -> list[str]:
    """Return lines on axial and radial load, and the largest ball load, over speed."""
    largest = np.fmax.reduce(result.ball_inner_load, axis=2)
    lines = []
    for k, name in enumerate(result.bearing):
        texts = (
            f"axial {over_speed(result.axial_load[:, k], result.speed)}",
            f"radial {over_speed(result.radial_load[:, k], result.speed)}",
            f"largest ball {over_speed(largest[:, k], result.speed)}",
        )
        lines.append(f"loads      bearing {name} [N]: " + ", ".join(map(unbroken, texts)))
    return lines


def numbers(result: BearingLoadsResult, _: Described) -> Iterator[Number]:
    """Yield the largest inner load of a ball over speed, for each bearing."""
    largest = np.fmax.reduce(result.ball_inner_load, axis=2)
    for k, name in enumerate(result.bearing):
        yield from each_speed(result, "ball", "N", largest[:, k], part=name)


@of_severity(Severity.LOAD)
def warnings(result: BearingLoadsResult) -> Iterator[str]:
    """Warn of bearings of which some ball loses contact under the loads."""
    share = result.loss_share
    if not np.isfinite(share).any():
        return
    row, k = (int(at) for at in np.unravel_index(int(np.nanargmin(share)), share.shape))
    least = np.fmin.reduce(share)
    others = [n for n, most in zip(result.bearing, least, strict=True) if np.isfinite(most)]
    others.remove(result.bearing[k])
    also = f" (and balls of {', '.join(others)} under more of them)" if others else ""
    angle, rpm = result.loss_azimuth[row, k], result.speed[row] * RPM.factor
    ball = int(np.nanargmin(np.abs(result.ball_azimuth[k] - angle))) + 1
    yield (
        f"bearing {result.bearing[k]}: its ball {ball}, at {math.degrees(angle):.0f}° from y "
        f"towards z, loses contact under {share[row, k]:.2f} of the loads at {rpm:.0f} rpm{also}: "
        "raise its preload, or lower the loads"
    )
