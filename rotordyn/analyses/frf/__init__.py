"""Frequency responses between points, beside measured ones."""

from __future__ import annotations

from rotordyn.analyses.contract import Code, in_folder
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.frf.tables import LAYOUTS

ANALYSIS = in_folder(
    __name__,
    "page",
    "panels",
    "accuracy",
    "warnings",
    machine="spindle",
    place=20,
    spec=FrfSpec,
    highest=lambda spec, top: spec.highest(top),
    forced=True,
    ports=lambda spec: {port.point for pair in spec.pairs for port in pair},
    further_tables=Code(__name__, "slices:slices"),
    files=Code(__name__, "uff:files"),
    costs={"frf_surface": 9, "frf_surfaces": 9, "frf_maps": 7},
    tables=LAYOUTS,
    heading="FRAC of measured responses, 1 at best",
    title="Frequency responses",
    speeds=lambda spec: (*spec.slices, *spec.measured_speeds),
)
