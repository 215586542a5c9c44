"""What holds the shaft: bearings, their growth, sleeves, linear supports."""

from __future__ import annotations

import math
from typing import Annotated, Any

from pydantic import BeforeValidator, Discriminator, Field, Tag

from rotordyn.case.schema.base import Entry, form
from rotordyn.case.schema.bearing import BearingEntry
from rotordyn.case.schema.material import none_if_unknown
from rotordyn.case.schema.matrix import DampingMatrix, DampingMatrixEntry, StiffnessMatrix
from rotordyn.case.schema.values import (
    Damping,
    Diameter,
    Growth,
    Interference,
    Mass,
    Name,
    Preload,
    Pull,
    Rigidity,
    Station,
    StopTravel,
    TopSpeed,
    choice,
)
from rotordyn.machine.drawbar import EVERYWHERE


class QuadraticEntry(Entry):
    """A displacement at a speed, growing with speed²."""

    value: Growth
    at: TopSpeed


class FitEntry(Entry):
    """The fit of inner ring and shaft; the bore is that of the bearing model unless given."""

    interference: Interference
    bore_diameter: Diameter | None = None


CentrifugalGrowth = Annotated[
    Annotated[str, choice("computed"), Tag("<word>")] | Annotated[QuadraticEntry, Tag("<mapping>")],
    Discriminator(form),
]


class GrowthEntry(Entry):
    """Radial growth of the inner groove; ``fit`` serves where the growth is ``computed``."""

    static: Growth = 0.0
    centrifugal: CentrifugalGrowth | None = None
    fit: FitEntry | None = None


class BearingDampingEntry(Entry):
    """Viscous damping between the rings of a bearing."""

    radial: Damping = 0.0
    axial: Damping = 0.0


class SeatEntry(Entry):
    """A bearing on the shaft; ``model_override`` is merged into the model before it is read."""

    name: Name
    model: Annotated[BearingEntry | None, BeforeValidator(none_if_unknown)]
    model_override: dict[str, Any] = {}
    x: Station
    thrust: Annotated[str, choice("+x", "-x")]
    growth: GrowthEntry | None = None
    damping: BearingDampingEntry | None = None


class SpringEntry(Entry):
    """Force at rest and stiffness of a preload spring."""

    preload: Preload
    stiffness: Rigidity


class SleeveEntry(Entry):
    """A sliding sleeve, its spring and its end stop."""

    name: Name
    bearings: Annotated[list[Name], Field(min_length=1)]
    spring: SpringEntry
    stop_travel: StopTravel = math.inf
    mass: Mass = 0.0
    radial_stiffness: Rigidity = math.inf


class SupportEntry(Entry):
    """A linear support to ground, by its matrices; nothing is made symmetric."""

    name: Name
    x: Station
    stiffness: StiffnessMatrix
    damping: DampingMatrix = DampingMatrixEntry()


def _guides_form(value: object) -> str:
    return "<list>" if form(value) == "<list>" else "<word>"


Guides = Annotated[
    Annotated[str, choice(EVERYWHERE), Tag("<word>")] | Annotated[list[Station], Tag("<list>")],
    Discriminator(_guides_form),
]


class DrawbarEntry(Entry):
    """The bar in the bore: it pulls the shaft together between two stations."""

    force: Pull
    start: Station = Field(alias="from")
    to: Station
    guides: Guides = []


class ShorteningEntry(Entry):
    """Axial shift of the seats: prescribed ``at`` a speed, or computed from ``reference``."""

    shift: Annotated[
        Annotated[str, choice("computed"), Tag("<word>")]
        | Annotated[dict[Name, Growth], Tag("<mapping>")],
        Discriminator(form),
    ]
    at: TopSpeed | None = None
    reference: Station | None = None
