"""Figures: preload over temperature difference."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

from rotordyn.analyses.contract import Code
from rotordyn.figures.draw import Job
from rotordyn.results.described import Described, Shown
from rotordyn.results.display import RPM
from rotordyn.results.headline import Curve

code = partial(Code, __name__)


def figures(_: Described, result: Any, __: Mapping[str, Any]) -> Iterator[Job]:
    """The figures of a result."""
    yield "thermal_preload", partial(code("over_difference:load_figure"), result)


def headline_curves(_: Any, variant: Shown) -> Iterator[Curve]:
    """Axial loads over the difference at the first and last speed."""
    result, rpm = variant.result, variant.result.speed * RPM.factor
    for index in sorted({0, len(rpm) - 1}):
        at = f"{rpm[index]:.0f} rpm"
        for k, name in enumerate(result.bearing):
            yield Curve(
                "thermal_preload",
                "axial load",
                "N",
                result.difference,
                result.axial_load[index, :, k],
                series=name,
                panel=at,
                along="added to shaft, inner rings and balls [K]",
                title=at,
            )
