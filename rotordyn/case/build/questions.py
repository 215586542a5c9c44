"""The questions of a case and the conditions they share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from rotordyn.analyses.bearing.spec import BearingMapSpec
from rotordyn.analyses.campbell.spec import CampbellSpec, ShapesInSpaceSpec
from rotordyn.analyses.contract import Spec
from rotordyn.analyses.control.spec import ControlSpec
from rotordyn.analyses.frf.spec import FrfSpec, MeasuredResponse, Port
from rotordyn.analyses.preload.spec import PreloadSpec
from rotordyn.analyses.section_forces.spec import SectionForcesSpec
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.case.build.sweep import values
from rotordyn.case.schema.analyses import (
    AnalysesEntry,
    BearingMapEntry,
    CampbellEntry,
    ControlEntry,
    FrfEntry,
    PreloadEntry,
    StiffnessEntry,
)
from rotordyn.case.schema.conditions import ConditionsEntry
from rotordyn.case.schema.loads import BalanceGradeEntry, SectionForcesEntry, UnbalanceResponseEntry
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import (
    BalanceGrade,
    EccentricSpan,
    LineLoad,
    PointLoad,
    TwistLimit,
    Unbalance,
)


def conditions(entry: ConditionsEntry) -> Conditions:
    """How the machine is modelled."""
    return Conditions(**entry.model_dump())


def questions(entry: AnalysesEntry, measured: tuple[MeasuredResponse, ...] = ()) -> dict[str, Spec]:
    """Spec by name, in the order of the registry of keys; ``measured`` as read from its files."""
    asked = {name: getattr(entry, name) for name in type(entry).model_fields}
    specs = {name: _spec(question) for name, question in asked.items() if question is not None}
    if isinstance(response := specs.get("frf"), FrfSpec) and measured:
        specs["frf"] = replace(response, measured=measured)
    return specs


def _spec(entry: Any) -> Spec:
    return _BUILDERS[type(entry)](entry)


def _frf(entry: FrfEntry) -> FrfSpec:
    pairs = tuple((Port(*response), Port(*excitation)) for response, excitation in entry.asked)
    return FrfSpec(
        () if entry.frequencies is None else values(entry.frequencies),
        pairs,
        tuple(entry.slices),
        entry.quantity,
        engine_orders=tuple(entry.engine_orders),
    )


def section_forces(entry: SectionForcesEntry) -> SectionForcesSpec:
    """Static loads and limits of twist."""
    return SectionForcesSpec(
        loads=tuple(PointLoad(**load.model_dump()) for load in entry.loads),
        line_loads=tuple(LineLoad(**load.model_dump()) for load in entry.line_loads),
        unbalances=tuple(Unbalance(**load.model_dump()) for load in entry.unbalances),
        gravity=entry.gravity,
        twist_limits=tuple(TwistLimit(**limit.model_dump()) for limit in entry.twist_limits),
    )


def _campbell(entry: CampbellEntry) -> CampbellSpec:
    asked = entry.shapes_3d
    in_space = None
    if asked is not None:
        in_space = ShapesInSpaceSpec(asked.amplitude, asked.animation, tuple(asked.files))
    return CampbellSpec(
        entry.max_frequency, tuple(entry.teeth), entry.shapes, in_space, tuple(entry.engine_orders)
    )


def unbalance(entry: UnbalanceResponseEntry) -> UnbalanceSpec:
    """What is out of balance, and where motion is told."""
    return UnbalanceSpec(
        points=tuple(entry.points),
        unbalances=tuple(Unbalance(**each.model_dump()) for each in entry.unbalances),
        spans=tuple(EccentricSpan(**each.model_dump()) for each in entry.spans),
        grade=None if entry.grade is None else _grade(entry.grade),
    )


def _grade(entry: BalanceGradeEntry) -> BalanceGrade:
    return BalanceGrade(entry.quality, entry.speed, tuple(entry.planes), entry.phase, entry.angle)


def _stiffness(entry: StiffnessEntry) -> StiffnessSpec:
    return StiffnessSpec(
        point=entry.point,
        max_force=entry.max_force,
        steps=entry.steps,
        variants=tuple(entry.variants),
        second_stop=dict(entry.second_stop),
    )


_BUILDERS: dict[type, Callable[[Any], Spec]] = {
    PreloadEntry: lambda entry: PreloadSpec(),
    CampbellEntry: _campbell,
    FrfEntry: _frf,
    StiffnessEntry: _stiffness,
    SectionForcesEntry: section_forces,
    UnbalanceResponseEntry: unbalance,
    BearingMapEntry: lambda entry: BearingMapSpec(
        tuple(entry.loads),
        entry.static_growth,
        tuple(entry.tangents),
        radial_loads=tuple(entry.radial_loads),
        moments=tuple(entry.moments),
        axial_load=entry.axial_load,
        radial_load=entry.radial_load,
        moment=entry.moment,
        tilt=entry.tilt,
        dynamics=entry.dynamics,
    ),
    ControlEntry: lambda entry: ControlSpec(
        entry.max_load, entry.min_load, entry.radial, entry.static_growth
    ),
}
