"""Radial stiffness of a point by bearing model."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from rotordyn.analyses.contract import Analysis, Code
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.analyses.stiffness.tables import LAYOUTS

code = partial(Code, __name__)

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
    lean=lambda spec: replace(spec, steps=1),  # tangents at no load alone
    known=code("known:known"),
)
