"""Which race controls the balls of a single bearing."""

from __future__ import annotations

from rotordyn.analyses.contract import in_folder
from rotordyn.analyses.control.spec import ControlSpec
from rotordyn.analyses.control.tables import LAYOUTS

ANALYSIS = in_folder(
    __name__,
    "panels",
    machine="bearing",
    place=80,
    spec=ControlSpec,
    tables=LAYOUTS,
    heading="axial load at which race control changes",
)
