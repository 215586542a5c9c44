"""Steady response to unbalance."""

from __future__ import annotations

import math

from rotordyn.analyses.contract import Code, in_folder
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.analyses.unbalance.tables import LAYOUTS

ANALYSIS = in_folder(
    __name__,
    "accuracy",
    "warnings",
    machine="spindle",
    place=60,
    spec=UnbalanceSpec,
    highest=lambda spec, top: top / (2.0 * math.pi),
    forced=True,
    ports=lambda spec: spec.places,
    marks=Code(__name__, "loads:marked"),
    tables=LAYOUTS,
    heading="largest half axis of the orbit by unbalance",
)
