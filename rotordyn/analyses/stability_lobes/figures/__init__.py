"""Figures of stability lobes: stable depth of cut over speed, milled surface."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from rotordyn.analyses.contract import Code
from rotordyn.figures.draw import Job
from rotordyn.results.described import Described, Shown
from rotordyn.results.display import MICROMETRE, MILLIMETRE, RPM
from rotordyn.results.headline import Curve

LEAST_SPEEDS = 100  # for lines: lobes are narrow, and fewer speeds are drawn as points
LIMITS = "stability_lobes"  # the figure of the limits
MEASURED = "on the measured spindle"
HIGH = 4.0  # times the median limit: end of the axis, beyond which pockets are cut off

code = partial(Code, __name__)


def figures(case: Described, result: Any, _: Mapping[str, Any]) -> Iterator[Job]:
    """Yield the figures of a result."""
    if len(result.cutting_speed) > 1:
        given = case.analyses["stability_lobes"]
        spec = replace(given, diameter=given.across(case.spindle))
        yield LIMITS, partial(code("lobes:lobes_figure"), result, spec)
    if result.cut_is_stable.sum() > 1:
        yield "milled_surface", partial(code("milled_surface:surface_figure"), result)


def headline_curves(_: Any, variant: Shown) -> Iterator[Curve]:
    """Yield depth of cut over speed, clipped in deep pockets and where every depth is stable, also
    on a measured spindle; of a planned cut the error of largest amount of each wall."""
    result = variant.result
    if len(result.cutting_speed) < 2:
        return
    depth, measured = (values * MILLIMETRE.factor for values in (result.depth, result.measured))
    finite = depth[np.isfinite(depth)]
    top = HIGH * float(np.median(finite)) if finite.size else 1.0
    rpm = result.cutting_speed * RPM.factor
    look: dict[str, Any] = {"limits": (0.0, None), "least": LEAST_SPEEDS, "ceiling": top}
    yield Curve(LIMITS, "depth of cut", "mm", rpm, depth, **look)
    if not np.isnan(measured).all():
        yield Curve(LIMITS, "depth of cut", "mm", rpm, measured, MEASURED, **look)
    for k, wall in enumerate(result.wall):
        ends = np.stack([result.surface_error_least[:, k], result.surface_error_most[:, k]])
        error = np.where(np.abs(ends[1]) >= np.abs(ends[0]), ends[1], ends[0])
        if np.isfinite(error).any():
            words, error = f"error of the {wall}-milled wall", error * MICROMETRE.factor
            yield Curve("milled_surface", words, "µm", rpm, error, panel=wall, least=LEAST_SPEEDS)
