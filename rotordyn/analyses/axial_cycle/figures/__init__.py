"""Figures: the cycle of axial force."""

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
    yield "axial_cycle", partial(code("loops:cycle_figure"), result)
    yield "axial_stiffness", partial(code("loops:stiffness_figure"), result)


def of_variants(_: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    """The figures of variants."""
    yield "axial_cycle", partial(code("compared:cycle_figure"), shown)
    yield "axial_stiffness", partial(code("compared:stiffness_figure"), shown)
