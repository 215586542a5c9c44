"""A cycle of axial force on the shaft: hysteresis, loads and axial stiffness, with friction."""

from __future__ import annotations

from functools import partial

from rotordyn.analyses.axial_cycle.spec import AxialCycleSpec
from rotordyn.analyses.axial_cycle.tables import LAYOUTS
from rotordyn.analyses.contract import Analysis, Code

code = partial(Code, __name__)

ANALYSIS = Analysis(
    name="axial_cycle",
    machine="spindle",
    place=32,
    spec=AxialCycleSpec,
    solve=code("solve:answer"),
    bearings=True,
    figures=code("figures:figures"),
    curves=code("figures:headline_curves"),
    tables=LAYOUTS,
    summary=code("summary:summary"),
    warnings=code("summary:warnings"),
    heading="axial stiffness at no load",
    numbers=code("summary:numbers"),
)
