"""The analyses, one folder each, and the specs by which a case specifies them.

A spec is looked up in the record of its analysis; ``_MODULE_OF`` has the modules of other names.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rotordyn.analyses.axial_cycle.spec import AxialCycleSpec
    from rotordyn.analyses.bearing.spec import BearingMapSpec
    from rotordyn.analyses.bearing_loads.spec import BearingLoadsSpec
    from rotordyn.analyses.campbell.spec import CampbellSpec, ShapesInSpaceSpec
    from rotordyn.analyses.control.spec import ControlSpec
    from rotordyn.analyses.frf.spec import FrfSpec
    from rotordyn.analyses.life.spec import LifeSpec, LoadStep
    from rotordyn.analyses.matrices.spec import MatricesSpec
    from rotordyn.analyses.measured_response import MeasuredResponse, Port
    from rotordyn.analyses.measured_spindle import MeasuredSpindle
    from rotordyn.analyses.preload.spec import PreloadSpec
    from rotordyn.analyses.section_forces.spec import SectionForcesSpec
    from rotordyn.analyses.stability_lobes.spec import (
        Interval,
        PlannedCut,
        StabilityLobesSpec,
        Turning,
    )
    from rotordyn.analyses.stability_lobes.workpiece import Coefficients, Workpiece
    from rotordyn.analyses.stability_lobes.workpiece_mode import WorkpieceMode
    from rotordyn.analyses.static_sag.spec import RingRunout, StaticSagSpec
    from rotordyn.analyses.stiffness.spec import StiffnessSpec
    from rotordyn.analyses.thermal_preload.spec import ThermalPreloadSpec
    from rotordyn.analyses.time_response.spec import ForceOverTime, TimeResponseSpec
    from rotordyn.analyses.unbalance.spec import UnbalanceSpec
    from rotordyn.analyses.warm_up.spec import WarmUpSpec
    from rotordyn.scene.conditions import Conditions
    from rotordyn.scene.heat_flow import MountedHeatFlow, SpindleHeatFlow
    from rotordyn.scene.loads import (
        BalanceGrade,
        EccentricSpan,
        LineLoad,
        PointLoad,
        TwistLimit,
        Unbalance,
    )
    from rotordyn.scene.lubrication import Lubrication
    from rotordyn.scene.spec import Spec

_MODULE_OF = {
    "AxialCycleSpec": "rotordyn.analyses.axial_cycle.spec",
    "BearingLoadsSpec": "rotordyn.analyses.bearing_loads.spec",
    "BalanceGrade": "rotordyn.scene.loads",
    "Coefficients": "rotordyn.analyses.stability_lobes.workpiece",
    "Conditions": "rotordyn.scene.conditions",
    "EccentricSpan": "rotordyn.scene.loads",
    "ForceOverTime": "rotordyn.analyses.time_response.spec",
    "Interval": "rotordyn.analyses.stability_lobes.spec",
    "LineLoad": "rotordyn.scene.loads",
    "LoadStep": "rotordyn.analyses.life.spec",
    "Lubrication": "rotordyn.scene.lubrication",
    "MountedHeatFlow": "rotordyn.scene.heat_flow",
    "MeasuredResponse": "rotordyn.analyses.measured_response",
    "MeasuredSpindle": "rotordyn.analyses.measured_spindle",
    "PlannedCut": "rotordyn.analyses.stability_lobes.spec",
    "PointLoad": "rotordyn.scene.loads",
    "Port": "rotordyn.analyses.measured_response",
    "RingRunout": "rotordyn.analyses.static_sag.spec",
    "SpindleHeatFlow": "rotordyn.scene.heat_flow",
    "ShapesInSpaceSpec": "rotordyn.analyses.campbell.spec",
    "Turning": "rotordyn.analyses.stability_lobes.spec",
    "TwistLimit": "rotordyn.scene.loads",
    "Unbalance": "rotordyn.scene.loads",
    "Workpiece": "rotordyn.analyses.stability_lobes.workpiece",
    "WorkpieceMode": "rotordyn.analyses.stability_lobes.workpiece_mode",
}
__all__ = [
    "AxialCycleSpec",
    "BalanceGrade",
    "BearingLoadsSpec",
    "BearingMapSpec",
    "CampbellSpec",
    "Coefficients",
    "Conditions",
    "ControlSpec",
    "EccentricSpan",
    "ForceOverTime",
    "FrfSpec",
    "Interval",
    "LifeSpec",
    "LineLoad",
    "LoadStep",
    "Lubrication",
    "MatricesSpec",
    "MeasuredResponse",
    "MeasuredSpindle",
    "MountedHeatFlow",
    "PlannedCut",
    "PointLoad",
    "Port",
    "PreloadSpec",
    "RingRunout",
    "SectionForcesSpec",
    "ShapesInSpaceSpec",
    "SpindleHeatFlow",
    "StabilityLobesSpec",
    "StaticSagSpec",
    "StiffnessSpec",
    "ThermalPreloadSpec",
    "TimeResponseSpec",
    "Turning",
    "TwistLimit",
    "Unbalance",
    "UnbalanceSpec",
    "WarmUpSpec",
    "Workpiece",
    "WorkpieceMode",
]


def __getattr__(name: str) -> Any:
    if name in _MODULE_OF:
        return getattr(importlib.import_module(_MODULE_OF[name]), name)
    if name.endswith("Spec") and name in (specs := _specs()):
        return specs[name]
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)


def _specs() -> dict[str, type[Spec]]:
    """The spec of every analysis that is a folder here."""
    from rotordyn.analyses.registry import analysis, built_in

    return {(spec := analysis(name).spec).__name__: spec for name in built_in()}
