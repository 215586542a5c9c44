"""Figures: life, safety, heat and films of bearings over speed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

from rotordyn.analyses.contract import Code
from rotordyn.figures.draw import Job
from rotordyn.figures.panels import Shown
from rotordyn.results.described import Described

code = partial(Code, __name__)


def figures(_: Described, result: Any, __: Mapping[str, Any]) -> Iterator[Job]:
    """The figures of a result."""
    if not result.bearing:
        return
    yield "life", partial(code("over_speed:life_figure"), result)
    if math.isfinite(result.viscosity):
        yield "heat", partial(code("over_speed:heat_figure"), result)


def of_variants(_: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    """The figures of variants."""
    if shown[0].result.bearing:
        yield "life", partial(code("compared:life_figure"), shown)
