"""The equation of motion by its matrices, for other programs."""

from __future__ import annotations

from rotordyn.analyses.contract import Code, in_folder
from rotordyn.analyses.matrices.spec import MatricesSpec
from rotordyn.analyses.matrices.tables import LAYOUTS

ANALYSIS = in_folder(
    __name__,
    "accuracy",
    "warnings",
    machine="spindle",
    place=25,
    spec=MatricesSpec,
    highest=lambda spec, _: spec.max_frequency,
    forced=True,
    ports=lambda spec: {port.point for port in spec.ports},
    files=Code(__name__, "mat:files"),
    tables=LAYOUTS,
    heading="highest receptance at the ports",
    over="shown_speed",
    title="Matrices of the equation of motion",
)
