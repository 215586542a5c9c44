"""Temperatures and preload of every bearing over time after the spindle starts."""

from __future__ import annotations

from rotordyn.analyses.contract import in_folder
from rotordyn.analyses.warm_up.spec import WarmUpSpec
from rotordyn.analyses.warm_up.tables import LAYOUTS

ANALYSIS = in_folder(
    __name__,
    "warnings",
    "accuracy",
    machine="spindle",
    place=34,
    spec=WarmUpSpec,
    bearings=True,
    unsteady=True,
    tables=LAYOUTS,
    heading="largest axial load during warm-up",
)
