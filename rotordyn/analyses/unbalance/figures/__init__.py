"""Figures: steady response to unbalance."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from itertools import islice
from typing import Any

import numpy as np

from rotordyn.analyses.contract import Code
from rotordyn.figures.draw import Job
from rotordyn.results.described import Described, Shown
from rotordyn.results.headline import Curve, curves_of

code = partial(Code, __name__)

MOST_POINTS = 3
SEEN = 1e-6  # of the largest orbit: less, next to rest, would stretch the axis


def figures(_: Described, result: Any, __: Mapping[str, Any]) -> Iterator[Job]:
    """The figures of a result."""
    determined = np.isfinite(result.fine_force_amplitude).any()
    if result.speed[-1] > 0.0:
        yield "unbalance", partial(code("response:response_figure"), result)
        if determined:
            yield "unbalance_forces", partial(code("response:forces_figure"), result)
    if result.run:
        yield "unbalance_runs", partial(code("runs:runs_figure"), result)
        if determined:
            yield "unbalance_run_forces", partial(code("runs:run_forces_figure"), result)


def headline_curves(_: Any, variant: Shown) -> Iterator[Curve]:
    """Major half axis of the orbit of the first points."""
    if variant.result.speed[-1] <= 0.0:
        return
    field, how = "fine_major_axis", {"figure": "unbalance", "along": "fine_speed"}
    for curve in islice(curves_of(variant.result, field, panels="point", **how), MOST_POINTS):
        title = f"{curve.panel}, major half axis, zero to peak"
        y = np.asarray(curve.y)
        largest = np.max(y, where=np.isfinite(y), initial=0.0)
        seen = np.where(y > SEEN * largest, y, np.nan)
        yield curve._replace(y=seen, label="half axis of the orbit", title=title, log=True)
