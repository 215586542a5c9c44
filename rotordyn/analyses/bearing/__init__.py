"""A single bearing over load and speed."""

from __future__ import annotations

from rotordyn.analyses.bearing.spec import BearingMapSpec
from rotordyn.analyses.bearing.tables import LAYOUTS
from rotordyn.analyses.contract import in_folder

ANALYSIS = in_folder(
    __name__,
    "warnings",
    "known",
    machine="bearing",
    place=70,
    spec=BearingMapSpec,
    tables=LAYOUTS,
    heading="axial/radial stiffness, tilts blocked",
)
