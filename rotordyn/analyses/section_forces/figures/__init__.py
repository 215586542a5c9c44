"""Figures: section forces, deflection and stress of the shaft at rest."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

from rotordyn.analyses.contract import Code
from rotordyn.analyses.section_forces.figures.diagrams import (
    FORCES,
    LINES,
    speeds_shown,
    stations_of,
)
from rotordyn.figures.draw import Job
from rotordyn.results.described import Described, Shown
from rotordyn.results.display import RPM
from rotordyn.results.headline import Curve, curves_of

code = partial(Code, __name__)


def figures(case: Described, result: Any, _: Mapping[str, Any]) -> Iterator[Job]:
    """The figures of a result."""
    for name, draw in (("section_forces", "diagrams"), ("elastic_line", "elastic_line")):
        yield (name, partial(code(f"diagrams:{draw}_figure"), result, case.spindle))


def headline_curves(_: Any, variant: Shown) -> Iterator[Curve]:
    """The six diagrams, deflections and von Mises stress at the last speed with a solution."""
    result = variant.result
    row, places = speeds_shown(result)[-1].row, stations_of(result, variant.spindle)
    rpm = float(result.speed[row]) * RPM.factor
    figures = dict.fromkeys(FORCES, "section_forces")
    figures |= dict.fromkeys((*LINES[0], "von_mises_stress"), "elastic_line")
    for name, figure in figures.items():
        at_speeds = [*curves_of(result, name, along="cut", figure=figure)]
        curve = at_speeds[row]
        yield curve._replace(places=places, along=f"{curve.along} at {rpm:.0f} rpm")
