"""The shaft and what turns with it, as written in spindle and tool files."""

from __future__ import annotations

from typing import Annotated

from pydantic import Discriminator, Field, Tag

from rotordyn.case.schema.base import Entry, form
from rotordyn.case.schema.joint import JointEntry
from rotordyn.case.schema.material import OptionalMaterial
from rotordyn.case.schema.reference import ReferenceEntry
from rotordyn.case.schema.values import (
    Bore,
    Diameter,
    Inertia,
    Length,
    Mass,
    Name,
    Station,
    Text,
    choice,
    reads,
)
from rotordyn.machine.shaft import SHEAR_COEFFICIENTS
from rotordyn.quantity import SHEAR_COEFFICIENT


class SectionEntry(Entry):
    """A hollow cylinder, or a cone where diameters at its rear end are given."""

    name: Name = ""
    length: Length
    outer_diameter: Diameter
    inner_diameter: Bore = 0.0
    rear_outer_diameter: Diameter | None = None
    rear_inner_diameter: Bore | None = None
    material: OptionalMaterial = None

    @property
    def outer(self) -> tuple[float, float]:
        """Outer diameters at both ends [m]."""
        rear = self.rear_outer_diameter
        return self.outer_diameter, self.outer_diameter if rear is None else rear

    @property
    def inner(self) -> tuple[float, float]:
        """Inner diameters at both ends [m]."""
        rear = self.rear_inner_diameter
        return self.inner_diameter, self.inner_diameter if rear is None else rear


Sections = Annotated[list[SectionEntry], Field(min_length=1)]


def _shear_form(value: object) -> str:
    return "<word>" if form(value) == "<word>" else "<number>"


ShearCoefficient = Annotated[
    Annotated[str, choice(*SHEAR_COEFFICIENTS), Tag("<word>")]
    | Annotated[float, reads(SHEAR_COEFFICIENT), Tag("<number>")],
    Discriminator(_shear_form),
]


class ShaftEntry(Entry):
    """Sections laid end to end from ``start``; ``material`` serves those that name none."""

    start: Station
    shear_coefficient: ShearCoefficient = "cowper"
    material: OptionalMaterial = None
    sections: Sections


class MassEntry(Entry):
    """A rigid mass at a station."""

    name: Name
    x: Station
    mass: Mass
    polar_inertia: Inertia = 0.0
    diametral_inertia: Inertia = 0.0


class DiscEntry(Entry):
    """A rigid hollow cylinder centred on a station."""

    name: Name
    x: Station
    outer_diameter: Diameter
    inner_diameter: Bore
    width: Length
    material: OptionalMaterial


class ToolEntry(Entry):
    """What is clamped into the nose: ``models/tools/*.yaml``."""

    title: Text = ""
    note: Text = ""
    sources: list[Text] = []
    material: OptionalMaterial = None
    sections: Sections
    masses: list[MassEntry] = []
    points: dict[Name, Station] = {}
    joints: list[JointEntry] = []
    references: list[ReferenceEntry] = []
