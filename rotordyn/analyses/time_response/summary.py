"""Response over time in a few lines of text: largest displacements, loads and pressures."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.time_response.result import TimeResponseResult
from rotordyn.results.described import Described
from rotordyn.results.display import GIGAPASCAL, MICROMETRE, RPM, number, rounded_up
from rotordyn.results.headline import Number, ends
from rotordyn.results.text import unbroken

PLASTIC = 4.2e9  # Pa: ISO 76, the pressure that leaves a ten-thousandth of the ball diameter


def summary(result: TimeResponseResult) -> Iterator[str]:
    """At the first and the last speed with an answer."""
    rows = np.flatnonzero(np.isfinite(result.ended))
    for row in dict.fromkeys(rows[[0, -1]].tolist()):
        moved = [
            unbroken(
                f"{name} {result.largest[row, k] * MICROMETRE.factor:.4g} µm at "
                f"{result.largest_time[row, k] * 1e3:.3g} ms (linear "
                f"{result.linear_largest[row, k] * MICROMETRE.factor:.4g})"
            )
            for k, name in enumerate(result.point)
        ]
        pushed = [
            unbroken(
                f"{name} {result.peak_load[row, k]:.4g} N, "
                f"{result.peak_pressure[row, k] * GIGAPASCAL.factor:.3g} GPa"
            )
            for k, name in enumerate(result.bearing)
        ]
        rpm = f"{result.speed[row] * RPM.factor:.0f} rpm"
        yield f"over time  {rpm}, largest displacement: {', '.join(moved)}"
        if pushed:
            yield f"           largest load and pressure then: {', '.join(pushed)}"


def numbers(result: TimeResponseResult, _: Described) -> Iterator[Number]:
    """By point the largest displacement at the first and the last speed, and the largest load of
    any bearing."""
    for k, name in enumerate(result.point):
        yield from ends(result, name, MICROMETRE.unit, result.largest[:, k] * 1e6, digits=2)
    if result.bearing:
        yield from ends(result, "bearing load", "N", result.peak_load.max(axis=1), digits=0)


def accuracy(result: TimeResponseResult) -> list[str]:
    """The largest estimated error of the motion."""
    worst = float(result.error.max(initial=0.0))
    return [f"response over time within {rounded_up(worst)} of its largest value"]


def warnings(result: TimeResponseResult) -> Iterator[str]:
    """Where the answer ends early, what its hypotheses do not hold for, and its accuracy."""
    for row in np.flatnonzero(result.ended < result.time[-1]).tolist():
        yield (
            f"time_response: at {_rpm(result, row)} a bearing has no state at "
            f"{result.ended[row] * 1e3:.4g} ms, with its rings where the forces push them, and the "
            "response ends there: lower the forces, or raise the preload"
        )
    for k, name in enumerate(result.sleeve):
        struck = np.flatnonzero(result.stop_gap[:, k] < 0.0)
        if struck.size:
            row = int(struck[result.stop_gap[struck, k].argmin()])
            yield (
                f"time_response: sleeve {name} would go "
                f"{-result.stop_gap[row, k] * MICROMETRE.factor:.3g} µm beyond its end stop at "
                f"{_rpm(result, row)}: the response knows no stops, and is right only until then"
            )
    for k, name in enumerate(result.bearing):
        pressure = np.nan_to_num(result.peak_pressure[:, k])
        if pressure.max(initial=0.0) > PLASTIC:
            row = int(pressure.argmax())
            yield (
                f"time_response: the contact pressure in bearing {name} reaches "
                f"{pressure[row] * GIGAPASCAL.factor:.1f} GPa at {_rpm(result, row)}, above the "
                "4.2 GPa that leave dents (ISO 76)"
            )
    worst = float(result.error.max(initial=0.0))
    if worst > result.error_asked:
        point = result.point[int(result.error.argmax())]
        yield (
            f"time_response: the motion of {point} is less accurate than asked for: an estimated "
            f"error of {rounded_up(worst)} of its largest value remains after refinement"
        )


def _rpm(result: TimeResponseResult, row: int) -> str:
    return f"{number(float(result.speed[row]) * RPM.factor, 0)} rpm"
