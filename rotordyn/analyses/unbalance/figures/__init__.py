"""Figures: steady response to unbalance."""

from __future__ import annotations

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
    if result.speed[-1] > 0.0:
        yield "unbalance", partial(code("response:response_figure"), result)
        yield "unbalance_forces", partial(code("response:forces_figure"), result)


def of_variants(_: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    """The figures of variants."""
    if shown[0].result.speed[-1] > 0.0:
        yield "unbalance", partial(code("compared:amplitudes_figure"), shown)
