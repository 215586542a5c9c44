"""Figures: section forces, deflection and stress of the shaft at rest."""

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
    for name, draw in (("section_forces", "diagrams"), ("elastic_line", "elastic_line")):
        yield (name, partial(code(f"diagrams:{draw}_figure"), result, case.spindle))


def of_variants(_: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    """The figures of variants."""
    yield "section_forces", partial(code("compared:diagrams_figure"), shown)
