"""Preload of every bearing over the temperature difference of rotating and stationary parts."""

from __future__ import annotations

from rotordyn.analyses.contract import in_folder
from rotordyn.analyses.thermal_preload.spec import ThermalPreloadSpec
from rotordyn.analyses.thermal_preload.tables import LAYOUTS

ANALYSIS = in_folder(
    __name__,
    "warnings",
    machine="spindle",
    place=33,
    spec=ThermalPreloadSpec,
    bearings=True,
    tables=LAYOUTS,
    heading="largest axial load over the differences of temperature",
)
