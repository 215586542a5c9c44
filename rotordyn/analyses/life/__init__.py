"""Life, static safety, heat, films and defect frequencies of every bearing of a spindle."""

from __future__ import annotations

from functools import partial

from rotordyn.analyses.contract import Analysis, Code
from rotordyn.analyses.life.spec import LifeSpec
from rotordyn.analyses.life.tables import LAYOUTS

code = partial(Code, __name__)

ANALYSIS = Analysis(
    name="life",
    machine="spindle",
    place=35,
    spec=LifeSpec,
    solve=code("solve:answer"),
    bearings=True,
    costs={"life": 6, "heat": 6},
    figures=code("figures:figures"),
    curves=code("figures:headline_curves"),
    tables=LAYOUTS,
    summary=code("summary:summary"),
    warnings=code("summary:warnings"),
    heading="life and heat",
    numbers=code("summary:numbers"),
    title="Life and heat",
    page=code("page:page"),
)
