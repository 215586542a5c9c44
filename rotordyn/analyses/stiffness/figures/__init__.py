"""Figures: radial stiffness of a point by bearing model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

import numpy as np

from rotordyn.analyses.contract import Code
from rotordyn.figures.draw import Job
from rotordyn.results.described import Described, Shown
from rotordyn.results.headline import Curve, curves_of

code = partial(Code, __name__)


def figures(case: Described, result: Any, _: Mapping[str, Any]) -> Iterator[Job]:
    """The figures of a result, none where no speed has a state."""
    if not np.isfinite(result.deflection).any():
        return
    point = getattr(case.analyses.get("stiffness"), "point", "")
    known = case.known
    yield "stiffness", partial(code("curves:stiffness_figure"), result, known, point)
    yield "stiffness_force", partial(code("curves:force_figure"), result, point)


def headline_curves(spec: Any, variant: Shown) -> Iterator[Curve]:
    """Tangent at no load by bearing model."""
    point = getattr(spec, "point", "")
    label = f"radial stiffness at {point}" if point else "radial stiffness"
    for curve in curves_of(variant.result, "tangent", series="variant", figure="stiffness"):
        known = ("radial_stiffness", curve.key)
        series = curve.series.replace("_", " ")
        yield curve._replace(label=label, series=series, known=known, limits=(0.0, None))
