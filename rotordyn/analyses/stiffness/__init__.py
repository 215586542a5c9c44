"""Radial stiffness of a point by bearing model."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from rotordyn.analyses.contract import Analysis, Code
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.analyses.stiffness.tables import LAYOUTS

code = partial(Code, __name__)
LIGHT = 1.0  # N: headline numbers and curves are tangents at no load

ANALYSIS = Analysis(
    name="stiffness",
    machine="spindle",
    place=40,
    spec=StiffnessSpec,
    solve=code("solve:answer"),
    bearings=True,
    ports=lambda spec: (spec.point,),
    figures=code("figures:figures"),
    curves=code("figures:headline_curves"),
    tables=LAYOUTS,
    summary=code("summary:summary"),
    warnings=code("summary:warnings"),
    heading="radial stiffness at no load",
    numbers=code("summary:numbers"),
    lean=lambda spec: replace(spec, steps=1, max_force=min(spec.max_force, LIGHT)),
    known=code("known:known"),
)
