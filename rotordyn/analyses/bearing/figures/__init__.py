"""Figures: a single bearing over load and speed."""

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
    yield "bearing", partial(code("over_load:bearing_figure"), result)
    yield "bearing_life", partial(code("over_load:life_figure"), result)
    if result.ball.size > 1 or len(result.contact) > 2:
        yield "bearing_contacts", partial(code("contacts:contacts_figure"), result)
    if result.ball.size > 1:
        yield "bearing_azimuth", partial(code("azimuth:azimuth_figure"), result)
    if "complete" in result.tangent and len(result.tangent) > 1:
        known = case.known
        yield "bearing_tangents", partial(code("tangents:tangents_figure"), result, known)


def of_variants(_: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    """The figures of variants."""
    yield "bearing", partial(code("compared:bearing_figure"), shown)
