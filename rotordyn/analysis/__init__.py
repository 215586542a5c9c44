"""The analyses: what is asked for (specs), results, and how they are computed, one file each."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rotordyn.analysis.bearing_specs import BearingMapSpec, ControlSpec
    from rotordyn.analysis.loads import (
        BalanceGrade,
        EccentricSpan,
        LineLoad,
        PointLoad,
        TwistLimit,
        Unbalance,
    )
    from rotordyn.analysis.specs import (
        CampbellSpec,
        Conditions,
        FrfSpec,
        MeasuredResponse,
        Port,
        PreloadSpec,
        SectionForcesSpec,
        ShapesInSpaceSpec,
        StiffnessSpec,
        UnbalanceSpec,
    )

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
    "StiffnessSpec",
    "TwistLimit",
    "Unbalance",
    "UnbalanceSpec",
]


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module("rotordyn.analysis.specs"), name)


def __dir__() -> list[str]:
    return sorted(__all__)
