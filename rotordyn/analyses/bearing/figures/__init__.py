"""Figures: a single bearing over load and speed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

import numpy as np

from rotordyn.analyses.bearing.result import along_load, longest, motion
from rotordyn.analyses.bearing.solve import under
from rotordyn.analyses.contract import Code
from rotordyn.arrays import Array
from rotordyn.figures.draw import Job
from rotordyn.figures.labels import axis_label
from rotordyn.results.described import Described, Shown
from rotordyn.results.display import GIGAPASCAL, RPM, STIFFNESS
from rotordyn.results.headline import Curve

code = partial(Code, __name__)


def figures(case: Described, result: Any, _: Mapping[str, Any]) -> Iterator[Job]:
    """Yield the figures of a result."""
    yield "bearing", partial(code("over_load:bearing_figure"), result)
    yield "bearing_motion", partial(code("over_load:motion_figure"), result)
    yield "bearing_life", partial(code("over_load:life_figure"), result)
    if np.isfinite(result.ball_temperature).any():
        yield "bearing_heat", partial(code("over_load:heat_figure"), result)
    if result.ball.size > 1 or len(result.contact) > 2:
        yield "bearing_contacts", partial(code("contacts:contacts_figure"), result)
    if result.ball.size > 1:
        yield "bearing_azimuth", partial(code("azimuth:azimuth_figure"), result)
    if "complete" in result.tangent and len(result.tangent) > 1:
        known = case.known
        yield "bearing_tangents", partial(code("tangents:tangents_figure"), result, known)


def headline_curves(_: Any, variant: Shown) -> Iterator[Curve]:
    """Yield stiffness, motion, and criteria for the choice of a load; all by load, or over load by
    speed where speeds are few."""
    result = variant.result
    kxx, kyy = (result.stiffness[:, :, 0, i, i] * STIFFNESS.factor for i in (0, 1))
    yield from _curves(result, "bearing", "stiffness Kxx", STIFFNESS.unit, kxx)
    yield from _curves(result, "bearing", "stiffness Kyy", STIFFNESS.unit, kyy)
    for label, unit, values, limits in (
        (*motion(result), (None, None)),
        ("half-length of the ellipse", "mm", longest(result) * 1e3, (0.0, None)),
        ("centrifugal force", "N", result.centrifugal_force, (0.0, None)),
        ("gyroscopic moment", "N·mm", result.gyroscopic_moment * 1e3, (0.0, None)),
    ):
        yield from _curves(result, "bearing_motion", label, unit, values, limits=limits)
    yield from _choice(result, kxx)


def _choice(result: Any, stiffness: Array) -> Iterator[Curve]:
    """Yield stiffness, life, heat, friction, pressure, and speed limit or static safety."""
    name = "bearing_life"
    pressure = np.fmax(result.inner_pressure, result.outer_pressure) * GIGAPASCAL.factor
    friction = np.fmax(result.inner_required_friction, result.outer_required_friction)
    yield from _curves(result, name, "stiffness Kxx", STIFFNESS.unit, stiffness)
    yield from _curves(result, name, "L10r, 1e6", "rev", result.revolutions * 1e-6, log=True)
    if np.isfinite(result.viscous_heat).any():
        heat = result.contact_heat + result.viscous_heat
        yield from _curves(result, name, "heat", "W", heat)
    yield from _curves(result, name, "required friction", "-", friction)
    yield from _curves(result, name, "peak pressure", GIGAPASCAL.unit, pressure)
    if np.isfinite(result.ball_temperature).any():
        along = axis_label(result, "load")
        limit = result.speed_limit * RPM.factor
        yield Curve(
            *(name, "thermal speed limit", "rpm", result.load, limit), along=along, limits=(0, None)
        )
    else:
        yield from _curves(result, name, "static safety S0", "-", result.static_safety)


def _curves(
    result: Any,
    figure: str,
    label: str,
    unit: str,
    values: Array,
    *,
    log: bool = False,
    limits: tuple[float | None, float | None] = (0.0, None),
) -> Iterator[Curve]:
    look: Any = {"limits": (None, None) if log else limits, "log": log}
    rpm = result.speed * RPM.factor
    if along_load(result):
        along = axis_label(result, "load")
        for k in range(len(rpm)):
            series = f"{rpm[k]:.0f} rpm"
            yield Curve(
                *(figure, label, unit, result.load, values[k]), series=series, along=along, **look
            )
        return
    for k in range(len(result.load)):
        yield Curve(
            figure, label, unit, rpm, values[:, k], series=under(result, k, " axial"), **look
        )
