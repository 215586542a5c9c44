"""Loads of bearings and balls in a few lines of text."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.bearing_loads.result import BearingLoadsResult
from rotordyn.results.described import Described
from rotordyn.results.display import RPM
from rotordyn.results.headline import Number, ends
from rotordyn.results.text import from_to, unbroken


def summary(result: BearingLoadsResult) -> list[str]:
    """Axial and radial load, and the largest ball load, at the first and last speed."""
    largest = np.nanmax(np.nan_to_num(result.ball_inner_load), axis=2)
    lines = []
    for k, name in enumerate(result.bearing):
        words = (
            f"axial {from_to(result.axial_load[:, k])}",
            f"radial {from_to(result.radial_load[:, k])}",
            f"largest ball {from_to(largest[:, k])}",
        )
        lines.append(f"loads      bearing {name} [N]: " + ", ".join(map(unbroken, words)))
    return lines


def numbers(result: BearingLoadsResult, _: Described) -> Iterator[Number]:
    """Largest inner load of a ball at the first and last speed, for each bearing."""
    largest = np.nanmax(np.nan_to_num(result.ball_inner_load), axis=2)
    for k, name in enumerate(result.bearing):
        yield from ends(result, "ball", "N", largest[:, k], part=name)


def warnings(result: BearingLoadsResult) -> Iterator[str]:
    """Bearings some ball of which loses its contact under the loads."""
    for k, name in enumerate(result.bearing):
        rows = np.flatnonzero(np.isfinite(result.loss_share[:, k]))
        if rows.size:
            row = rows[np.argmin(result.loss_share[rows, k])]
            angle, rpm = result.loss_azimuth[row, k], result.speed[row] * RPM.factor
            ball = int(np.nanargmin(np.abs(result.ball_azimuth[k] - angle))) + 1
            yield (
                f"bearing {name}: its ball {ball}, at {math.degrees(angle):.0f}° from y towards z, "
                f"loses contact under {result.loss_share[row, k]:.2f} of the loads at {rpm:.0f} "
                "rpm: raise its preload, or lower the loads"
            )
