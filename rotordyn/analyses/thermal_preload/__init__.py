"""Preload of every bearing over the temperature difference of what turns and what stands still."""

from __future__ import annotations

from functools import partial

from rotordyn.analyses.contract import Analysis, Code
from rotordyn.analyses.thermal_preload.spec import ThermalPreloadSpec
from rotordyn.analyses.thermal_preload.tables import LAYOUTS

code = partial(Code, __name__)

ANALYSIS = Analysis(
    name="thermal_preload",
    machine="spindle",
    place=33,
    spec=ThermalPreloadSpec,
    solve=code("solve:answer"),
    bearings=True,
    figures=code("figures:figures"),
    curves=code("figures:headline_curves"),
    tables=LAYOUTS,
    summary=code("summary:summary"),
)
