"""The dynamic preload state of every bearing, spring and stop."""

from __future__ import annotations

from rotordyn.analyses.contract import in_folder
from rotordyn.analyses.preload.spec import PreloadSpec
from rotordyn.analyses.preload.tables import LAYOUTS

ANALYSIS = in_folder(
    __name__,
    "page",
    "known",
    machine="spindle",
    place=30,
    spec=PreloadSpec,
    bearings=True,
    costs={"preload": 6, "contacts": 6},
    tables=LAYOUTS,
    heading="preload",
    title="Preload",
)
