"""The dynamic preload state of every bearing, spring and stop."""

from __future__ import annotations

from functools import partial

from rotordyn.analyses.contract import Analysis, Code
from rotordyn.analyses.preload.spec import PreloadSpec
from rotordyn.analyses.preload.tables import LAYOUTS

code = partial(Code, __name__)

ANALYSIS = Analysis(
    name="preload",
    machine="spindle",
    place=30,
    spec=PreloadSpec,
    solve=code("solve:answer"),
    bearings=True,
    costs={"preload": 6, "contacts": 6},
    figures=code("figures:figures"),
    curves=code("figures:headline_curves"),
    tables=LAYOUTS,
    summary=code("summary:summary"),
    heading="preload",
    numbers=code("summary:numbers"),
    known=code("known:known"),
    title="Preload",
    page=code("page:page"),
)
