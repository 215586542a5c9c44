"""Figures: a single bearing over load and speed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

from rotordyn.analyses.bearing.solve import under
from rotordyn.analyses.contract import Code
from rotordyn.figures.draw import Job
from rotordyn.figures.panels import Shown
from rotordyn.results.described import Described
from rotordyn.results.display import RPM, STIFFNESS
from rotordyn.results.headline import Curve

code = partial(Code, __name__)


def figures(case: Described, result: Any, _: Mapping[str, Any]) -> Iterator[Job]:
    """The figures of a result."""
    yield "bearing", partial(code("over_load:bearing_figure"), result)
    if result.ball.size > 1 or len(result.contact) > 2:
        yield "bearing_contacts", partial(code("contacts:contacts_figure"), result)
    if result.ball.size > 1:
        yield "bearing_azimuth", partial(code("azimuth:azimuth_figure"), result)
    if "complete" in result.tangent and len(result.tangent) > 1:
        known = case.known
        yield "bearing_tangents", partial(code("tangents:tangents_figure"), result, known)


def headline_curves(_: Any, variant: Shown) -> Iterator[Curve]:
    """Kxx and Kyy, tilts blocked, by load."""
    result, rpm = variant.result, variant.result.speed * RPM.factor
    for entry, name in enumerate(("Kxx", "Kyy")):
        for k in range(len(result.load)):
            values = result.stiffness[:, k, 0, entry, entry] * STIFFNESS.factor
            look: dict[str, Any] = {"series": under(result, k, " axial"), "limits": (0.0, None)}
            yield Curve("bearing", f"stiffness {name}", STIFFNESS.unit, rpm, values, **look)
