"""Figures: deflection line under weight, and runout in front of the nose."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

import numpy as np

from rotordyn.analyses.contract import Code
from rotordyn.figures.draw import Job
from rotordyn.results.described import Described, Shown
from rotordyn.results.display import MICROMETRE, MILLIMETRE, RPM
from rotordyn.results.headline import Curve, curves_of

code = partial(Code, __name__)

SEEN = 1e-6  # of the largest deflection: smaller ones are not drawn


def figures(case: Described, result: Any, _: Mapping[str, Any]) -> Iterator[Job]:
    """The figures of a result."""
    shown = Shown("", result, (), case.spindle)
    yield "static_sag", partial(code("line:line_figure"), [shown])


def headline_curves(_: Any, variant: Shown) -> Iterator[Curve]:
    """Deflection at the slowest speed with a solution, in the directions that sag."""
    result = variant.result
    row = int(np.flatnonzero(np.isfinite(result.slope).all(axis=1))[0])
    rpm = float(result.speed[row]) * RPM.factor
    supports = variant.spindle.connections if variant.spindle else ()
    places = sorted((support.x * MILLIMETRE.factor, support.name) for support in supports)
    count = len(result.direction)
    at_speeds = [
        *curves_of(result, "deflection", along="station", panels="direction", figure="static_sag")
    ]
    largest = float(np.nanmax(np.abs(result.deflection[row])))
    for curve in at_speeds[row * count : (row + 1) * count]:
        if np.abs(curve.y).max() > SEEN * largest * MICROMETRE.factor:
            yield curve._replace(places=places, along=f"{curve.along} at {rpm:.0f} rpm")
