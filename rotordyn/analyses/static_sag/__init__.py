"""Static sag and runout of the nose of a spindle."""

from __future__ import annotations

from functools import partial

from rotordyn.analyses.contract import Analysis, Code
from rotordyn.analyses.static_sag.spec import StaticSagSpec
from rotordyn.analyses.static_sag.tables import LAYOUTS

code = partial(Code, __name__)

ANALYSIS = Analysis(
    name="static_sag",
    machine="spindle",
    place=55,
    spec=StaticSagSpec,
    solve=code("solve:answer"),
    figures=code("figures:figures"),
    curves=code("figures:headline_curves"),
    tables=LAYOUTS,
    summary=code("summary:summary"),
    warnings=code("summary:warnings"),
    heading="sag and runout of the nose",
    numbers=code("summary:numbers"),
)
