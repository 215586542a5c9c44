"""Figures: the dynamic preload state of every bearing, spring and stop."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

from rotordyn.analyses.contract import Code
from rotordyn.figures.draw import Job
from rotordyn.figures.panels import Shown
from rotordyn.results.described import Described

code = partial(Code, __name__)


def figures(case: Described, result: Any, _: Mapping[str, Any]) -> Iterator[Job]:
    """The figures of a result."""
    if not result.bearing or case.spindle is None:
        return
    known = case.known
    yield "preload", partial(code("over_speed:preload_figure"), result, case.spindle, known)
    yield "contacts", partial(code("over_speed:contacts_figure"), result)


def of_variants(_: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    """The figures of variants."""
    if shown[0].result.bearing:
        yield "preload", partial(code("compared:preload_figure"), shown)
