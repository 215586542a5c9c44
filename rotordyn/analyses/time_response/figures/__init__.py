"""Figures of the response over time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

import numpy as np

from rotordyn.analyses.contract import Code
from rotordyn.figures.draw import Job
from rotordyn.results.described import Described, Shown
from rotordyn.results.display import MICROMETRE, RPM
from rotordyn.results.headline import Curve

code = partial(Code, __name__)

MOST_POINTS = 3
LINE = 0.05  # of the longer side of a path: one that is no wider along the other is a line


def figures(_: Described, result: Any, __: Mapping[str, Any]) -> Iterator[Job]:
    """Yield the figures of a result, if some speed has a motion."""
    if not (result.ended > 0.0).any():
        return
    yield "time_response", partial(code("histories:motion_figure"), result)
    if _has_orbit(result):
        yield "time_response_orbits", partial(code("histories:orbit_figure"), result)
    if result.bearing:
        yield "time_response_bearings", partial(code("histories:bearing_figure"), result)
    if np.isfinite(result.gap).any():
        yield "time_response_stops", partial(code("histories:stop_figure"), result)


def _has_orbit(result: Any) -> bool:
    """Return whether the path of some point across the axis is more than a line."""
    x, *across = np.moveaxis(np.nan_to_num(np.abs(result.displacement)).max(axis=1), -1, 0)
    thin, wide = np.sort(across, axis=0)  # next to motion along the shaft, they may be rounding
    return bool(((thin > LINE * wide) & (wide > 1e-9 * x)).any())


def headline_curves(_: Any, variant: Shown) -> Iterator[Curve]:
    """Yield displacement of the first points along y and z at the highest speed."""
    result = variant.result
    rpm = f"{result.speed[-1] * RPM.factor:.0f} rpm"
    for k, point in enumerate(result.point[:MOST_POINTS]):
        for axis in (1, 2):
            values = result.displacement[-1, :, k, axis] * MICROMETRE.factor
            yield Curve(
                "time_response",
                "displacement",
                MICROMETRE.unit,
                result.time * 1e3,
                values,
                series=result.axis[axis],
                panel=point,
                along="time [ms]",
                title=f"{point}, {rpm}",
            )
