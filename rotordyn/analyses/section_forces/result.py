"""Section forces, deflection and stress along the shaft."""

from __future__ import annotations

from dataclasses import dataclass

from rotordyn.arrays import Array, Words
from rotordyn.results.declaration import coordinate, quantity
from rotordyn.results.display import MEGAPASCAL, MILLIMETRE
from rotordyn.scene.linearity import LINEAR


@dataclass(frozen=True)
class SectionForcesResult:
    """Section forces, elastic line and stress along the shaft under static loads.

    ``cut``: both ends of every element, so that a station with a point load comes twice, just in
    front of it and just behind. Section forces are those that the part behind a cut puts on the
    part in front. Stresses are at the outer fibre. ``reaction``: load of a bearing or support on
    the shaft. ``departure``: difference between the increments of a bearing's load by its law and
    by its tangent, over the latter. ``required_diameter``: of a uniform shaft with ``bore`` whose
    twist is ``allowed_twist``.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    cut: Array = coordinate("cut", unit="m", label="station", printed=MILLIMETRE)
    support: Words = coordinate("support", unit="", label="support")
    component: Words = coordinate("component", unit="", label="component")
    twist_limit: Words = coordinate("twist_limit", unit="", label="twist limit")
    outcome: Words = quantity("speed", unit="", label="outcome")
    outer_diameter: Array = quantity("cut", unit="m", label="outer diameter", printed=MILLIMETRE)
    inner_diameter: Array = quantity("cut", unit="m", label="inner diameter", printed=MILLIMETRE)
    normal_force: Array = quantity("speed", "cut", unit="N", label="normal force N")
    shear_force_y: Array = quantity("speed", "cut", unit="N", label="shear force Ty")
    shear_force_z: Array = quantity("speed", "cut", unit="N", label="shear force Tz")
    torque: Array = quantity("speed", "cut", unit="N·m", label="torque Mt")
    bending_moment_y: Array = quantity("speed", "cut", unit="N·m", label="bending moment My")
    bending_moment_z: Array = quantity("speed", "cut", unit="N·m", label="bending moment Mz")
    axial_displacement: Array = quantity("speed", "cut", unit="m", label="axial displacement")
    deflection_y: Array = quantity("speed", "cut", unit="m", label="deflection y")
    deflection_z: Array = quantity("speed", "cut", unit="m", label="deflection z")
    twist: Array = quantity("speed", "cut", unit="rad", label="twist θx")
    slope_y: Array = quantity("speed", "cut", unit="rad", label="slope θy")
    slope_z: Array = quantity("speed", "cut", unit="rad", label="slope θz")
    normal_stress: Array = quantity(
        "speed", "cut", unit="Pa", label="normal stress", printed=MEGAPASCAL
    )
    torsion_stress: Array = quantity(
        "speed", "cut", unit="Pa", label="shear stress of torsion", printed=MEGAPASCAL
    )
    von_mises_stress: Array = quantity(
        "speed", "cut", unit="Pa", label="von Mises stress", printed=MEGAPASCAL
    )
    support_station: Array = quantity("support", unit="m", label="station", printed=MILLIMETRE)
    reaction: Array = quantity("speed", "support", "component", unit="N, N·m", label="reaction")
    departure: Array = quantity(
        "speed",
        "support",
        unit="1",
        label="deviation of a bearing's load from its tangent",
        absent=(LINEAR,),
    )
    allowed_twist: Array = quantity("twist_limit", unit="rad", label="allowed twist")
    bore: Array = quantity("twist_limit", unit="m", label="bore", printed=MILLIMETRE)
    twist_between: Array = quantity("speed", "twist_limit", unit="rad", label="twist")
    required_diameter: Array = quantity(
        *("speed", "twist_limit"),
        unit="m",
        label="outer diameter at the limit of twist",
        printed=MILLIMETRE,
    )
