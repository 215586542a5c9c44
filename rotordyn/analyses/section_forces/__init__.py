"""Section forces, deflection and stress of the shaft at rest."""

from __future__ import annotations

from rotordyn.analyses.contract import in_folder
from rotordyn.analyses.section_forces.spec import SectionForcesSpec
from rotordyn.analyses.section_forces.tables import LAYOUTS

ANALYSIS = in_folder(
    __name__,
    "warnings",
    "known",
    machine="spindle",
    place=50,
    spec=SectionForcesSpec,
    tables=LAYOUTS,
    heading="section forces of largest amount",
)
