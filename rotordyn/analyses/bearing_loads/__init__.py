"""What static loads do to every bearing: its load and displacement, and the load of every ball."""

from __future__ import annotations

from functools import partial

from rotordyn.analyses.bearing_loads.spec import BearingLoadsSpec
from rotordyn.analyses.bearing_loads.tables import LAYOUTS
from rotordyn.analyses.contract import Analysis, Code

code = partial(Code, __name__)

ANALYSIS = Analysis(
    name="bearing_loads",
    machine="spindle",
    place=31,
    spec=BearingLoadsSpec,
    solve=code("solve:answer"),
    bearings=True,
    figures=code("figures:figures"),
    curves=code("figures:headline_curves"),
    tables=LAYOUTS,
    summary=code("summary:summary"),
    warnings=code("summary:warnings"),
    heading="largest ball load",
    numbers=code("summary:numbers"),
)
