"""Effect of static loads on every bearing: its load and displacement, the load of every ball."""

from __future__ import annotations

from rotordyn.analyses.bearing_loads.spec import BearingLoadsSpec
from rotordyn.analyses.bearing_loads.tables import LAYOUTS
from rotordyn.analyses.contract import in_folder

ANALYSIS = in_folder(
    __name__,
    "warnings",
    machine="spindle",
    place=31,
    spec=BearingLoadsSpec,
    bearings=True,
    tables=LAYOUTS,
    heading="largest ball load",
)
