"""Response over time to forces, with the nonlinear law of the bearings."""

from __future__ import annotations

from rotordyn.analyses.contract import Code, in_folder
from rotordyn.analyses.time_response.spec import TimeResponseSpec
from rotordyn.analyses.time_response.tables import LAYOUTS

ANALYSIS = in_folder(
    __name__,
    "accuracy",
    "warnings",
    machine="spindle",
    place=65,
    spec=TimeResponseSpec,
    highest=lambda spec, _: spec.max_frequency,
    forced=True,
    over_time=lambda spec: not spec.unbalances,
    ports=lambda spec: spec.places,
    marks=Code(__name__, "forces:marked"),
    tables=LAYOUTS,
    heading="largest displacement over time",
    title="Response over time",
)
