"""Figures: receptances at the ports by the matrices."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

import numpy as np

from rotordyn.analyses.contract import Code
from rotordyn.figures.draw import Job
from rotordyn.results.described import Described, Shown
from rotordyn.results.display import RPM, shown
from rotordyn.results.headline import Curve

code = partial(Code, __name__)


def figures(_: Described, result: Any, __: Mapping[str, Any]) -> Iterator[Job]:
    """The figures of a result."""
    yield "matrices", partial(code("ports:ports_figure"), result)


def headline_curves(_: Any, variant: Shown) -> Iterator[Curve]:
    """Receptance of every port at the last speed with a state."""
    result = variant.result
    rpm = f"{result.shown_speed[-1] * RPM.factor:.0f} rpm"
    for k, port in enumerate(result.port):
        unit = shown(result.unit(k))
        yield Curve(
            "matrices",
            "receptance",
            unit.unit,
            result.frequency,
            np.abs(result.receptance[-1, k]) * unit.factor,
            panel=port,
            along="frequency [Hz]",
            title=f"{port}, {rpm}",
            log=True,
        )
