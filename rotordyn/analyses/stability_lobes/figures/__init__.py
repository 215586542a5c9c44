"""Figures: stable depth of cut over speed."""

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
    if len(result.cutting_speed) > 1:
        yield "stability_lobes", partial(code("lobes:lobes_figure"), result)


def of_variants(_: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    """The figures of variants."""
    if len(shown[0].result.cutting_speed) > 1:
        yield "stability_lobes", partial(code("lobes:variants_figure"), shown)
