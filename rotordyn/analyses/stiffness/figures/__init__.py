"""Figures: radial stiffness of a point by bearing model."""

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
    point = getattr(case.analyses.get("stiffness"), "point", "")
    known = case.known
    yield "stiffness", partial(code("curves:stiffness_figure"), result, known, point)
    yield "stiffness_force", partial(code("curves:force_figure"), result, point)


def of_variants(spec: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    """The figures of variants."""
    point = getattr(spec, "point", "")
    yield "stiffness", partial(code("compared:stiffness_figure"), shown, point)
