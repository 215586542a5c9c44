"""Figures: load roses, and loads of the bearings over speed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

import numpy as np

from rotordyn.analyses.contract import Code
from rotordyn.figures.draw import Job
from rotordyn.results.described import Described, Shown
from rotordyn.results.display import RPM
from rotordyn.results.headline import Curve

code = partial(Code, __name__)


def figures(_: Described, result: Any, __: Mapping[str, Any]) -> Iterator[Job]:
    """Yield the figures of a result."""
    yield "load_roses", partial(code("roses:rose_figure"), result)
    if np.nanmax(np.abs(result.inner_ring_deflection + result.outer_ring_deflection)) > 0.0:
        yield "ring_roses", partial(code("roses:ring_figure"), result)


def headline_curves(_: Any, variant: Shown) -> Iterator[Curve]:
    """Yield the largest ball load of every bearing over speed."""
    result, rpm = variant.result, variant.result.speed * RPM.factor
    for k, name in enumerate(result.bearing):
        largest = np.nan_to_num(result.ball_inner_load[:, k]).max(axis=1)
        largest = np.where(np.isnan(result.axial_load[:, k]), np.nan, largest)
        yield Curve("ball_loads", "largest inner load of a ball", "N", rpm, largest, series=name)
