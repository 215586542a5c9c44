"""The spindle and the tool."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rotordyn import units
from rotordyn.case.build.bearing import bearing, material
from rotordyn.case.build.joint import joint
from rotordyn.case.schema.drawbar import DrawbarEntry
from rotordyn.case.schema.growth import GrowthEntry, QuadraticEntry, ShorteningEntry
from rotordyn.case.schema.housing import HousingEntry
from rotordyn.case.schema.material import MaterialEntry
from rotordyn.case.schema.matrix import entries
from rotordyn.case.schema.reference import KIND_OF_UNIT, ReferenceEntry
from rotordyn.case.schema.rotor import RotorEntry
from rotordyn.case.schema.shaft import DiscEntry, MassEntry, SectionEntry, ShaftEntry, ToolEntry
from rotordyn.case.schema.spindle import SpindleEntry
from rotordyn.case.schema.support import SeatEntry, SleeveEntry, SupportEntry
from rotordyn.machine.damping import RayleighDamping
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.growth import (
    ComputedShortening,
    InterferenceFit,
    PrescribedShortening,
    QuadraticInSpeed,
    RingGrowth,
)
from rotordyn.machine.housing import Housing, ReducedHousing, RigidHousing
from rotordyn.machine.lumped import Disc, PointMass
from rotordyn.machine.reference import QUANTITIES, Reference
from rotordyn.machine.rotor import Rotor
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.squeeze_film import SqueezeFilmDamper
from rotordyn.machine.support import BearingSeat, LinearSupport, Sleeve, Spring
from rotordyn.machine.tool import Tool


def spindle(entry: SpindleEntry, name: str) -> Spindle:
    """The spindle of a checked file, without a tool."""
    return Spindle(
        name=name,
        shaft=_shaft(entry.shaft),
        masses=tuple(_mass(mass) for mass in entry.masses),
        discs=tuple(_disc(disc) for disc in entry.discs),
        seats=tuple(_seat(seat, entry) for seat in entry.bearings),
        sleeves=tuple(_sleeve(sleeve) for sleeve in entry.sleeves),
        supports=tuple(support(each) for each in entry.supports),
        dampers=tuple(SqueezeFilmDamper(**dict(each)) for each in entry.dampers),
        drawbar=_drawbar(entry.drawbar),
        points=dict(entry.points),
        shortening=_shortening(entry.shortening),
        rotor_damping=tuple(entry.damping.rotor),
        internal_damping=entry.damping.internal,
        rayleigh=RayleighDamping(**entry.damping.rayleigh.model_dump()),
        loss_factor=entry.damping.loss_factor,
        title=entry.title,
        note=entry.note,
        references=references(entry.references),
        housings=tuple(housing(each) for each in entry.housings),
        joints=tuple(joint(each) for each in entry.joints),
        rotors=tuple(rotor(each) for each in entry.rotors),
    )


def rotor(entry: RotorEntry) -> Rotor:
    """A further rotor of a checked file."""
    return Rotor(
        name=entry.name,
        speed_ratio=entry.speed_ratio,
        shaft=_shaft(entry.shaft),
        masses=tuple(_mass(mass) for mass in entry.masses),
        discs=tuple(_disc(disc) for disc in entry.discs),
        points=dict(entry.points),
        rotor_damping=tuple(entry.damping.rotor),
        internal_damping=entry.damping.internal,
        rayleigh=RayleighDamping(**entry.damping.rayleigh.model_dump()),
        joints=tuple(joint(each) for each in entry.joints),
    )


def _shaft(entry: ShaftEntry) -> Shaft:
    sections = _sections(entry.sections, entry.material)
    return Shaft(entry.start, sections, entry.shear_coefficient)


def tool(entry: ToolEntry, name: str) -> Tool:
    """The tool of a checked file."""
    return Tool(
        name=name,
        sections=_sections(entry.sections, entry.material),
        masses=tuple(_mass(mass) for mass in entry.masses),
        points=dict(entry.points),
        references=references(entry.references),
        joints=tuple(joint(each) for each in entry.joints),
    )


def references(entries: Sequence[ReferenceEntry]) -> tuple[Reference, ...]:
    """Known values in SI; a single speed is repeated for every value."""
    return tuple(_reference(entry) for entry in entries)


def _reference(entry: ReferenceEntry) -> Reference:
    kind = KIND_OF_UNIT[QUANTITIES[entry.quantity]]
    speeds = tuple(entry.speeds)
    return Reference(
        quantity=entry.quantity,
        kind=entry.kind,
        source=entry.source,
        speeds=speeds if len(speeds) > 1 else speeds * len(entry.values),
        values=tuple(units.parse(value, kind) for value in entry.values),
        subject=entry.subject,
        remark=entry.remark,
        conditions={
            key: getattr(entry.conditions, key) for key in entry.conditions.model_fields_set
        },
    )


def _sections(entries: Sequence[SectionEntry], common: MaterialEntry | None) -> tuple[Section, ...]:
    return tuple(
        Section(
            s.length,
            s.outer_diameter,
            s.inner_diameter,
            material(s.material or common),
            s.name,
            s.rear_outer_diameter,
            s.rear_inner_diameter,
        )
        for s in entries
    )


def _mass(entry: MassEntry) -> PointMass:
    return PointMass(entry.name, entry.x, entry.mass, entry.polar_inertia, entry.diametral_inertia)


def _disc(entry: DiscEntry) -> Disc:
    return Disc(
        entry.name,
        entry.x,
        entry.outer_diameter,
        entry.inner_diameter,
        entry.width,
        material(entry.material),
    )


_THRUST = {"+x": 1, "-x": -1, None: 0}


def _seat(entry: SeatEntry, whole: SpindleEntry) -> BearingSeat:
    model, damping = entry.model, entry.damping or whole.damping.bearings
    if model is None:
        raise ValueError(f"the model of bearing {entry.name} was not read")
    return BearingSeat(
        name=entry.name,
        bearing=bearing(model),
        x=entry.x,
        thrust=_THRUST[entry.thrust],
        kinematics=entry.kinematics,
        moment_sharing=entry.moment_sharing,
        friction=entry.friction,
        growth=_growth(entry.growth or whole.growth, model.bore_diameter),
        radial_damping=damping.radial,
        axial_damping=damping.axial,
        model=model.name,
    )


def _growth(entry: GrowthEntry, bore_diameter: float | None) -> RingGrowth:
    if isinstance(entry.centrifugal, QuadraticEntry):
        law = QuadraticInSpeed(entry.centrifugal.value, entry.centrifugal.at)
        return RingGrowth(entry.static, law)
    if entry.centrifugal is None or entry.fit is None:
        return RingGrowth(entry.static)
    bore = entry.fit.bore_diameter or bore_diameter
    if bore is None:
        raise ValueError("the bore of a bearing was not read")
    return RingGrowth(entry.static, InterferenceFit(bore, entry.fit.interference))


def _shortening(
    entry: ShorteningEntry | None,
) -> PrescribedShortening | ComputedShortening | None:
    if entry is None:
        return None
    if isinstance(entry.shift, str):
        return ComputedShortening(entry.reference or 0.0)
    return PrescribedShortening(entry.at or 0.0, dict(entry.shift))


def _sleeve(entry: SleeveEntry) -> Sleeve:
    return Sleeve(
        name=entry.name,
        bearings=tuple(entry.bearings),
        spring=Spring(entry.spring.preload, entry.spring.stiffness),
        stop_travel=entry.stop_travel,
        mass=entry.mass,
        radial_stiffness=entry.radial_stiffness,
    )


def support(entry: SupportEntry) -> LinearSupport:
    """A linear support, its matrices however they are written."""
    matrices = entries(entry.stiffness), entries(entry.damping)
    rigid, speeds = tuple(entry.rigid), tuple(entry.speeds)
    return LinearSupport(
        entry.name,
        entry.x,
        *matrices,
        rigid,
        speeds,
        *entry.ends,
        entry.loss_factor,
        entry.beyond,
    )


def housing(entry: HousingEntry) -> Housing:
    """A rigid housing, or one by its reduced model."""
    carries, model = tuple(entry.carries), entry.model
    if model is None:
        matrices = entries(entry.stiffness), entries(entry.damping)
        inertias = entry.polar_inertia, entry.diametral_inertia
        place = (entry.name, carries, entry.x or 0.0, entry.mass or 0.0)
        return RigidHousing(*place, *matrices, *inertias)
    matrix = {name: _rows(getattr(model, name)) for name in ("shape", *_MATRICES)}
    return ReducedHousing(entry.name, carries, model.places, **matrix)


_MATRICES = ("mass", "stiffness", "damping")


def _rows(matrix: Any) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(row) for row in matrix.tolist())


def _drawbar(entry: DrawbarEntry | None) -> Drawbar | None:
    if entry is None:
        return None
    guides = entry.guides if isinstance(entry.guides, str) else tuple(entry.guides)
    return Drawbar(entry.force, entry.start, entry.to, guides)
