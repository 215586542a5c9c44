"""The preload state in a few lines of text."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.preload.known import preload_sum
from rotordyn.analyses.preload.result import PreloadResult
from rotordyn.arrays import Array
from rotordyn.results.described import Described
from rotordyn.results.display import RPM
from rotordyn.results.headline import Number, each_speed
from rotordyn.results.text import from_to, over_speed, unbroken

SAME = 0.5  # N


def summary(result: PreloadResult) -> list[str]:
    """Axial loads of the bearings over speed, when stops are reached, friction."""
    loads = ", ".join(
        unbroken(f"{name} {_mounted(mounted, load)}{over_speed(load, result.speed, 0)}")
        for name, mounted, load in zip(
            result.bearing, result.mounted_load, result.axial_load.T, strict=True
        )
    )
    lines = [f"preload    [N] {loads}"]
    for name, force, offset in zip(
        result.sleeve, result.mounted_preload, result.ring_offset, strict=True
    ):
        if math.isfinite(offset):
            lines.append(
                f"rigid      {name}: {force:.0f} N as mounted, axial offset of the free rings "
                f"{offset * 1e6:.1f} µm"
            )
    for name, speed in zip(result.sleeve, result.stop_speed, strict=True):
        when = f"reached at {speed * RPM.factor:.0f} rpm" if math.isfinite(speed) else "not reached"
        lines.append(f"stop       {name}: {when}")
    for name, force, limit in zip(
        result.sleeve, result.friction_force.T, result.friction_limit, strict=True
    ):
        if limit > 0.0:
            lines.append(f"friction   {name}: {from_to(force, 1)} N, within ± {limit:.4g} N")
    if (thickest := np.nanmax(result.film_growth, initial=0.0)) > 0.0:
        lines.append(
            "films      of oil, equivalent to a growth of the inner rings by up to "
            f"{thickest * 1e6:.2f} µm"
        )
    return lines


def _mounted(mounted: float, load: Array) -> str:
    """The load as mounted, where the first state has another one."""
    return "" if abs(load[0] - mounted) < SAME else f"mounted {mounted:.0f}, "


def numbers(result: PreloadResult, case: Described) -> Iterator[Number]:
    """Sum of the preloads, and when stops are reached."""
    if case.spindle is None:
        return
    yield from each_speed(result, "sum", "N", preload_sum(result, case.spindle), digits=0)
    for name, speed in zip(result.sleeve, result.stop_speed, strict=True):
        at = float(speed * RPM.factor) if math.isfinite(speed) else math.nan
        yield Number(f"stop {name}", "rpm", at, digits=0, absent="not reached")
