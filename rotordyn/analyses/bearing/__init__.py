"""A single bearing over load and speed."""

from __future__ import annotations

from functools import partial

from rotordyn.analyses.bearing.spec import BearingMapSpec
from rotordyn.analyses.bearing.tables import LAYOUTS
from rotordyn.analyses.contract import Analysis, Code

code = partial(Code, __name__)

ANALYSIS = Analysis(
    name="bearing",
    machine="bearing",
    place=70,
    spec=BearingMapSpec,
    solve=code("solve:answer"),
    figures=code("figures:figures"),
    curves=code("figures:headline_curves"),
    tables=LAYOUTS,
    summary=code("summary:summary"),
    warnings=code("summary:warnings"),
    heading="axial/radial stiffness, tilts blocked",
    numbers=code("summary:numbers"),
    known=code("known:known"),
)
