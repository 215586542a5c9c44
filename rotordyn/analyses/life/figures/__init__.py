"""Figures: life, safety, heat and films of bearings over speed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

import numpy as np

from rotordyn.analyses.contract import Code
from rotordyn.analyses.life.result import HOUR
from rotordyn.figures.draw import Job
from rotordyn.results.described import Described, Shown
from rotordyn.results.display import GIGAPASCAL, RPM
from rotordyn.results.headline import Curve

code = partial(Code, __name__)


def figures(_: Described, result: Any, __: Mapping[str, Any]) -> Iterator[Job]:
    """The figures of a result."""
    if not result.bearing:
        return
    yield "life", partial(code("over_speed:life_figure"), result)
    if math.isfinite(result.viscosity):
        yield "heat", partial(code("over_speed:heat_figure"), result)
    if np.isfinite(result.ball_temperature).any():
        yield "temperature", partial(code("over_speed:temperature_figure"), result)


def headline_curves(_: Any, variant: Shown) -> Iterator[Curve]:
    """Life of the set, least static safety, largest pressure, heat of all bearings."""
    result, rpm = variant.result, variant.result.speed * RPM.factor
    if not result.bearing:
        return
    hours = np.where(np.isfinite(result.set_life), result.set_life / HOUR, np.nan)
    yield Curve("life", "life of the set L10r", "h", rpm, hours, log=True)
    low: Any = {"limits": (0.0, None)}
    yield Curve("life", "least static safety S0", "-", rpm, result.static_safety.min(axis=1), **low)
    pressure = result.pressure.max(axis=1) * GIGAPASCAL.factor
    yield Curve("life", "peak pressure", GIGAPASCAL.unit, rpm, pressure, **low)
    if math.isfinite(result.viscosity):
        yield Curve("life", "heat of all bearings", "W", rpm, result.heat.sum(axis=1), **low)
    if np.isfinite(result.ball_temperature).any():
        hottest = result.ball_temperature.max(axis=1)
        yield Curve("life", "hottest balls", "°C", rpm, hottest, **low)
