"""How rings and shaft deform with speed: given values, or computed from fit and sections."""

from __future__ import annotations

from typing import Annotated

from pydantic import Discriminator, Tag

from rotordyn.case.schema.base import Entry, form
from rotordyn.case.schema.values import (
    Diameter,
    Growth,
    Interference,
    Name,
    Station,
    TopSpeed,
    choice,
)


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


class ShorteningEntry(Entry):
    """Axial shift of the seats: prescribed ``at`` a speed, or computed from ``reference``."""

    shift: Annotated[
        Annotated[str, choice("computed"), Tag("<word>")]
        | Annotated[dict[Name, Growth], Tag("<mapping>")],
        Discriminator(form),
    ]
    at: TopSpeed | None = None
    reference: Station | None = None
