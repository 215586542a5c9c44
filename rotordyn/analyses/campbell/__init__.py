"""Damped modes over speed and their critical speeds."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.campbell.tables import LAYOUTS
from rotordyn.analyses.contract import Analysis, Code

code = partial(Code, __name__)

ANALYSIS = Analysis(
    name="campbell",
    machine="spindle",
    place=10,
    spec=CampbellSpec,
    solve=code("solve:answer"),
    highest=lambda spec, top: spec.max_frequency,
    files=code("meshes:files"),
    pictures=code("in_space:InSpace"),
    costs={"mode_shapes": 8},
    figures=code("figures:figures"),
    panels=code("figures:panels"),
    curves=code("figures:headline_curves"),
    tables=LAYOUTS,
    summary=code("summary:summary"),
    accuracy=code("summary:accuracy"),
    warnings=code("summary:warnings"),
    heading="bending modes, backward/forward",
    numbers=code("summary:numbers"),
    lean=lambda spec: replace(spec, shapes=False, shapes_3d=None),
    known=code("known:known"),
)
