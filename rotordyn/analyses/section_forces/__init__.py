"""Section forces, deflection and stress of the shaft at rest."""

from __future__ import annotations

from functools import partial

from rotordyn.analyses.contract import Analysis, Code
from rotordyn.analyses.section_forces.spec import SectionForcesSpec
from rotordyn.analyses.section_forces.tables import LAYOUTS

code = partial(Code, __name__)

ANALYSIS = Analysis(
    name="section_forces",
    machine="spindle",
    place=50,
    spec=SectionForcesSpec,
    solve=code("solve:answer"),
    figures=code("figures:figures"),
    curves=code("figures:headline_curves"),
    tables=LAYOUTS,
    summary=code("summary:summary"),
    warnings=code("summary:warnings"),
    heading="section forces of largest amount",
    numbers=code("summary:numbers"),
    known=code("known:known"),
)
