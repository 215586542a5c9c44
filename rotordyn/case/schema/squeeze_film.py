"""Squeeze-film dampers."""

from __future__ import annotations

from typing import Annotated

from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.values import (
    EccentricityRatio,
    Length,
    Name,
    Station,
    Viscosity,
    choice,
)
from rotordyn.machine.squeeze_film import FILMS


class SqueezeFilmDamperEntry(Entry):
    """A short oil film between a journal that does not spin and ground."""

    name: Name
    x: Station
    viscosity: Viscosity
    length: Length
    radius: Length
    clearance: Length
    eccentricity_ratio: EccentricityRatio = 0.0
    film: Annotated[str, choice(*FILMS)] = "cavitated"
