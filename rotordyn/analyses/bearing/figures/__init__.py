"""Figures: a single bearing over load and speed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

import numpy as np

from rotordyn.analyses.bearing.solve import under
from rotordyn.analyses.contract import Code
from rotordyn.figures.draw import Job
from rotordyn.figures.panels import Shown
from rotordyn.results.described import Described
from rotordyn.results.display import GIGAPASCAL, RPM, STIFFNESS
from rotordyn.results.headline import Curve
from rotordyn.results.kinds import Array

code = partial(Code, __name__)


def figures(case: Described, result: Any, _: Mapping[str, Any]) -> Iterator[Job]:
    """The figures of a result."""
    yield "bearing", partial(code("over_load:bearing_figure"), result)
    yield "bearing_life", partial(code("over_load:life_figure"), result)
    if result.ball.size > 1 or len(result.contact) > 2:
        yield "bearing_contacts", partial(code("contacts:contacts_figure"), result)
    if result.ball.size > 1:
        yield "bearing_azimuth", partial(code("azimuth:azimuth_figure"), result)
    if "complete" in result.tangent and len(result.tangent) > 1:
        known = case.known
        yield "bearing_tangents", partial(code("tangents:tangents_figure"), result, known)


def headline_curves(_: Any, variant: Shown) -> Iterator[Curve]:
    """By load: Kxx and Kyy, tilts blocked, and what stands beside the stiffness of a choice."""
    result = variant.result
    stiffness = result.stiffness[:, :, 0] * STIFFNESS.factor
    pressure = np.fmax(result.inner_pressure, result.outer_pressure) * GIGAPASCAL.factor
    friction = np.fmax(result.inner_grip, result.outer_grip)
    yield from _by_load(result, "bearing", "stiffness Kxx", STIFFNESS.unit, stiffness[..., 0, 0])
    yield from _by_load(result, "bearing", "stiffness Kyy", STIFFNESS.unit, stiffness[..., 1, 1])
    yield from _by_load(result, "bearing_life", "peak pressure", GIGAPASCAL.unit, pressure)
    revolutions = result.revolutions * 1e-6
    yield from _by_load(result, "bearing_life", "L10r, 1e6", "rev", revolutions, log=True)
    yield from _by_load(result, "bearing_life", "required friction", "-", friction)
    if np.isfinite(result.viscous_heat).any():
        heat = result.contact_heat + result.viscous_heat
        yield from _by_load(result, "bearing_life", "heat", "W", heat)


def _by_load(
    result: Any, figure: str, label: str, unit: str, values: Array, *, log: bool = False
) -> Iterator[Curve]:
    rpm, limits = result.speed * RPM.factor, (None if log else 0.0, None)
    for k in range(len(result.load)):
        series = under(result, k, " axial")
        yield Curve(figure, label, unit, rpm, values[:, k], series=series, limits=limits, log=log)
