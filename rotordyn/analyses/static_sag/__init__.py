"""Static sag and runout of the nose of a spindle."""

from __future__ import annotations

from rotordyn.analyses.contract import in_folder
from rotordyn.analyses.static_sag.spec import StaticSagSpec
from rotordyn.analyses.static_sag.tables import LAYOUTS

ANALYSIS = in_folder(
    __name__,
    "warnings",
    machine="spindle",
    place=55,
    spec=StaticSagSpec,
    tables=LAYOUTS,
    heading="sag and runout",
)
