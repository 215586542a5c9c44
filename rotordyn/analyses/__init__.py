"""The analyses, one folder each, and what a case asks of them: the door to all specs."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rotordyn.analyses.bearing.spec import BearingMapSpec
    from rotordyn.analyses.campbell.spec import CampbellSpec, ShapesInSpaceSpec
    from rotordyn.analyses.control.spec import ControlSpec
    from rotordyn.analyses.frf.spec import FrfSpec, MeasuredResponse, Port
    from rotordyn.analyses.preload.spec import PreloadSpec
    from rotordyn.analyses.section_forces.spec import SectionForcesSpec
    from rotordyn.analyses.stability_lobes.spec import StabilityLobesSpec
    from rotordyn.analyses.stiffness.spec import StiffnessSpec
    from rotordyn.analyses.unbalance.spec import UnbalanceSpec
    from rotordyn.scene.conditions import Conditions
    from rotordyn.scene.loads import (
        BalanceGrade,
        EccentricSpan,
        LineLoad,
        PointLoad,
        TwistLimit,
        Unbalance,
    )

_HOME = {
    "BalanceGrade": "rotordyn.scene.loads",
    "BearingMapSpec": "rotordyn.analyses.bearing.spec",
    "CampbellSpec": "rotordyn.analyses.campbell.spec",
    "Conditions": "rotordyn.scene.conditions",
    "ControlSpec": "rotordyn.analyses.control.spec",
    "EccentricSpan": "rotordyn.scene.loads",
    "FrfSpec": "rotordyn.analyses.frf.spec",
    "LineLoad": "rotordyn.scene.loads",
    "MeasuredResponse": "rotordyn.analyses.frf.spec",
    "PointLoad": "rotordyn.scene.loads",
    "Port": "rotordyn.analyses.frf.spec",
    "PreloadSpec": "rotordyn.analyses.preload.spec",
    "SectionForcesSpec": "rotordyn.analyses.section_forces.spec",
    "ShapesInSpaceSpec": "rotordyn.analyses.campbell.spec",
    "StabilityLobesSpec": "rotordyn.analyses.stability_lobes.spec",
    "StiffnessSpec": "rotordyn.analyses.stiffness.spec",
    "TwistLimit": "rotordyn.scene.loads",
    "Unbalance": "rotordyn.scene.loads",
    "UnbalanceSpec": "rotordyn.analyses.unbalance.spec",
}
__all__ = [
    "BalanceGrade",
    "BearingMapSpec",
    "CampbellSpec",
    "Conditions",
    "ControlSpec",
    "EccentricSpan",
    "FrfSpec",
    "LineLoad",
    "MeasuredResponse",
    "PointLoad",
    "Port",
    "PreloadSpec",
    "SectionForcesSpec",
    "ShapesInSpaceSpec",
    "StabilityLobesSpec",
    "StiffnessSpec",
    "TwistLimit",
    "Unbalance",
    "UnbalanceSpec",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
