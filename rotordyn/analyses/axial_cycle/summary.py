"""The cycle in a few lines of text."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.axial_cycle.result import AxialCycleResult
from rotordyn.results.described import Described
from rotordyn.results.display import RPM, STIFFNESS, number
from rotordyn.results.headline import Number, each_speed
from rotordyn.results.severity import Severity, of_severity
from rotordyn.results.text import from_to, over_speed, unbroken

NO_LOSS = 1e-9  # J: rounding


def summary(result: AxialCycleResult) -> list[str]:
    """Return lines on axial stiffness at no load over speed, and the energy lost."""
    values = ", ".join(
        unbroken(f"{name} {over_speed(stiffness, result.speed)}")
        for name, stiffness in zip(
            result.branch, result.no_load_stiffness.T * STIFFNESS.factor, strict=True
        )
    )
    lines = [f"axial      stiffness at no load [N/µm] force {values}"]
    if np.nanmax(result.loss, initial=0.0) > NO_LOSS:
        lines.append(f"hysteresis energy lost per cycle [mJ] {from_to(result.loss * 1e3)}")
    return lines


def numbers(result: AxialCycleResult, _: Described) -> Iterator[Number]:
    """Yield stiffness at no load over speed, for each branch."""
    for name, values in zip(
        result.branch, result.no_load_stiffness.T * STIFFNESS.factor, strict=True
    ):
        yield from each_speed(result, "force", "N/µm", values, part=name)


@of_severity(Severity.LOAD)
def warnings(result: AxialCycleResult) -> list[str]:
    """Warn of bearings that the force unloads."""
    sentences = []
    load = result.axial_load.min(axis=1)  # of both branches
    for k, name in enumerate(result.bearing):
        rows, at = np.nonzero(load[..., k] == 0.0)
        if len(at):
            place = int(np.abs(result.force[at]).argmin())
            rpm = result.speed[rows[place]] * RPM.factor
            sentences.append(
                f"bearing {name} is unloaded under an axial force "
                f"{_unloading_force(result, at[place])} at {rpm:.0f} rpm: raise its preload, or "
                "avoid that force"
            )
    return sentences


def _unloading_force(result: AxialCycleResult, place: int) -> str:
    """Return as text the force that unloads, coming from no load: between two solved forces."""
    force = result.force
    previous = place - int(np.sign(force[place]))
    if not 0 <= previous < len(force) or previous == place:
        return f"of {number(float(force[place]), 0)} N"
    least = force[previous] if force[previous] * force[place] > 0.0 else 0.0
    return f"between {number(float(least), 0)} and {number(float(force[place]), 0)} N"
