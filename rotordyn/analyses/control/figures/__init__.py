"""Figures: which race controls the balls of a single bearing."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

from rotordyn.analyses.contract import Code
from rotordyn.analyses.control.figures.boundaries import load_name
from rotordyn.analyses.control.solve import BOUNDARY_WORDS
from rotordyn.figures.draw import Job
from rotordyn.figures.panels import Panel
from rotordyn.results.described import Described, Shown
from rotordyn.results.headline import Curve, curves_of

code = partial(Code, __name__)


def figures(_: Described, result: Any, __: Mapping[str, Any]) -> Iterator[Job]:
    """Yield the figures of a result."""
    yield "control", partial(code("boundaries:control_figure"), result)


def panels(_: Any, shown: Sequence[Shown]) -> Iterator[Panel]:
    """Yield the regions of every variant."""
    if shown[0].result.speed.size > 1:
        yield Panel("control_regions", code("boundaries:draw_variant"), tall=60.0)


def headline_curves(_: Any, variant: Shown) -> Iterator[Curve]:
    """Yield both boundaries over speed."""
    result = variant.result
    curves = curves_of(result, "boundary_load", series="boundary", figure="control")
    for curve, word in zip(curves, BOUNDARY_WORDS.values(), strict=True):
        limits = (0.0, float(result.load[-1]))
        yield curve._replace(label=load_name(result), series=word, limits=limits)
