"""Which race controls the balls of a single bearing."""

from __future__ import annotations

from functools import partial

from rotordyn.analyses.contract import Analysis, Code
from rotordyn.analyses.control.spec import ControlSpec
from rotordyn.analyses.control.tables import LAYOUTS

code = partial(Code, __name__)

ANALYSIS = Analysis(
    name="control",
    machine="bearing",
    place=80,
    spec=ControlSpec,
    solve=code("solve:answer"),
    figures=code("figures:figures"),
    panels=code("figures:panels"),
    curves=code("figures:headline_curves"),
    tables=LAYOUTS,
    summary=code("summary:summary"),
    heading="axial load at which race control changes",
    numbers=code("summary:numbers"),
)
