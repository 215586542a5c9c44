"""Frequency responses between points, beside measured ones."""

from __future__ import annotations

from functools import partial

from rotordyn.analyses.contract import Analysis, Code
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.frf.tables import LAYOUTS

code = partial(Code, __name__)

ANALYSIS = Analysis(
    name="frf",
    machine="spindle",
    place=20,
    spec=FrfSpec,
    solve=code("solve:answer"),
    highest=lambda spec, top: spec.highest(top),
    forced=True,
    ports=lambda spec: {port.point for pair in spec.pairs for port in pair},
    further_tables=code("slices:slices"),
    files=code("uff:files"),
    costs={"frf_surface": 9, "frf_surfaces": 9, "frf_maps": 7},
    figures=code("figures:figures"),
    panels=code("figures:panels"),
    curves=code("figures:headline_curves"),
    tables=LAYOUTS,
    summary=code("summary:summary"),
    accuracy=code("summary:accuracy"),
    warnings=code("summary:warnings"),
    heading="FRAC of measured responses, 1 at best",
    numbers=code("summary:numbers"),
    speeds=lambda spec: spec.slices,
)
