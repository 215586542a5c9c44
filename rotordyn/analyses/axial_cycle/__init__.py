"""A cycle of axial force on the shaft: hysteresis, loads and axial stiffness, with friction."""

from __future__ import annotations

from rotordyn.analyses.axial_cycle.spec import AxialCycleSpec
from rotordyn.analyses.axial_cycle.tables import LAYOUTS
from rotordyn.analyses.contract import in_folder

ANALYSIS = in_folder(
    __name__,
    "warnings",
    machine="spindle",
    place=32,
    spec=AxialCycleSpec,
    bearings=True,
    tables=LAYOUTS,
    heading="axial stiffness at no load",
)
