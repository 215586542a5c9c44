"""Figures of a warm-up: axial loads and temperatures over time."""

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
    """Yield the figures of a result, if some speed has values."""
    if all(result.outcome):
        return
    yield "warm_up", partial(code("over_time:warming_figure"), result)


def headline_curves(_: Any, variant: Shown) -> Iterator[Curve]:
    """Yield axial loads over time at the first and last speed."""
    result, rpm = variant.result, variant.result.speed * RPM.factor
    for row in sorted({0, len(rpm) - 1}):
        panel = f"{rpm[row]:.0f} rpm"
        for k, name in enumerate(result.bearing):
            yield Curve(
                "warm_up",
                "axial load",
                "N",
                result.time / 60.0,
                result.axial_load[row, :, k],
                series=name,
                panel=panel,
                along="time from the start [min]",
                title=panel,
            )
