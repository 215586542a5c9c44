"""Radial stiffness of a point by bearing model."""

from __future__ import annotations

from rotordyn.analyses.contract import in_folder
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.analyses.stiffness.tables import LAYOUTS

ANALYSIS = in_folder(
    __name__,
    "warnings",
    "known",
    machine="spindle",
    place=40,
    spec=StiffnessSpec,
    bearings=True,
    ports=lambda spec: (spec.point,),
    tables=LAYOUTS,
    heading="radial stiffness at no load",
    lean=lambda spec: spec.unloaded,
)
