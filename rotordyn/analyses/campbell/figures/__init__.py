"""Figures: damped modes over speed and their critical speeds."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

from rotordyn.analyses.contract import Code
from rotordyn.figures.draw import Job
from rotordyn.figures.panels import MOST_PANELS, Shown
from rotordyn.results.described import Described

code = partial(Code, __name__)


def figures(case: Described, result: Any, _: Mapping[str, Any]) -> Iterator[Job]:
    """The figures of a result."""
    spec = case.analyses.get("campbell")
    teeth, highest = getattr(spec, "teeth", ()), getattr(spec, "max_frequency", 0.0)
    known = case.known
    yield "campbell", partial(code("diagram:campbell_figure"), result, teeth, known, highest)
    if result.unstable.any() and result.speed.size > 1:
        yield "damping", partial(code("damping:damping_figure"), result)
    if result.shape_speed.size and result.node.size:
        yield "mode_shapes", partial(code("shapes:shapes_figure"), result, case.spindle)


def of_variants(spec: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    """The figures of variants."""
    teeth, highest = getattr(spec, "teeth", ()), getattr(spec, "max_frequency", 0.0)
    if len(shown) <= MOST_PANELS:
        yield "campbell", partial(code("compared:panels_figure"), shown, teeth, highest)
    yield "campbell_overlay", partial(code("compared:overlay_figure"), shown, teeth, highest)
    growing = any(variant.result.unstable.any() for variant in shown)
    if growing and len(shown) <= MOST_PANELS and shown[0].result.speed.size > 1:
        yield "damping", partial(code("compared_damping:damping_figure"), shown)
