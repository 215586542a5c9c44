"""Steady response to unbalance."""

from __future__ import annotations

import math
from functools import partial

from rotordyn.analyses.contract import Analysis, Code
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.analyses.unbalance.tables import LAYOUTS

code = partial(Code, __name__)

ANALYSIS = Analysis(
    name="unbalance",
    machine="spindle",
    place=60,
    spec=UnbalanceSpec,
    solve=code("solve:answer"),
    highest=lambda spec, top: top / (2.0 * math.pi),
    forced=True,
    ports=lambda spec: spec.places,
    marks=code("loads:marked"),
    figures=code("figures:figures"),
    curves=code("figures:headline_curves"),
    tables=LAYOUTS,
    summary=code("summary:summary"),
    accuracy=code("summary:accuracy"),
    warnings=code("summary:warnings"),
    heading="largest half axis of the orbit by unbalance",
    numbers=code("summary:numbers"),
)
