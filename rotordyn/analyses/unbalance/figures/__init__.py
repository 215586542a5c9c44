"""Figures of the response to unbalance."""

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
MOST_RUNS = 4
SEEN = 1e-6  # of the largest orbit: smaller orbits, near rest, would stretch the axis


def figures(_: Described, result: Any, __: Mapping[str, Any]) -> Iterator[Job]:
    """Yield the figures of a result."""
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
    """Yield major half axes of orbits of the first points, in steady rotation and on the first
    runs, each run in its own panel."""
    result = variant.result
    if result.speed[-1] > 0.0:
        options = {"figure": "unbalance", "along": "fine_speed", "panels": "point"}
        for curve in islice(curves_of(result, "fine_major_axis", **options), MOST_POINTS):
            yield _orbit(curve._replace(title=f"{curve.panel}, major half axis, zero to peak"))
    runs = result.run[:MOST_RUNS]
    points = result.point[: max(1, MOST_POINTS // max(len(runs), 1))]
    options = {"figure": "unbalance_runs", "along": "run_speed", "panels": "point", "series": "run"}
    for curve in curves_of(result, "run_amplitude", **options):
        if curve.series in runs and curve.panel in points and np.isfinite(curve.y).any():
            name = f"{curve.panel} {curve.series}"
            title = f"{name}, major half axis, zero to peak"
            yield _orbit(curve._replace(panel=name, title=title, series="", key=""))


def _orbit(curve: Curve) -> Curve:
    """Return the curve without negligible values near rest."""
    largest = np.max(curve.y, where=np.isfinite(curve.y), initial=0.0)
    shown = np.where(curve.y > SEEN * largest, curve.y, np.nan)
    return curve._replace(y=shown, label="half axis of the orbit", log=True)
