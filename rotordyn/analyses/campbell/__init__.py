"""Damped modes over speed and their critical speeds."""

from __future__ import annotations

from dataclasses import replace

from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.campbell.tables import LAYOUTS
from rotordyn.analyses.contract import Code, in_folder

ANALYSIS = in_folder(
    __name__,
    "page",
    "panels",
    "accuracy",
    "warnings",
    "known",
    "lacking",
    "missing_entries",
    machine="spindle",
    place=10,
    spec=CampbellSpec,
    highest=lambda spec, top: spec.max_frequency,
    files=Code(__name__, "meshes:files"),
    pictures=Code(__name__, "in_space:InSpace"),
    costs={"mode_shapes": 8},
    tables=LAYOUTS,
    heading="bending modes, critical speeds, backward/forward",
    title="Campbell diagram",
    lean=lambda spec: replace(spec, shapes=False, shapes_3d=None),
)
