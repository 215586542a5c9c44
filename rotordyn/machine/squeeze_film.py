"""Squeeze-film dampers between the shaft and ground."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Protocol

from rotordyn.description import Description
from rotordyn.quantity import Choice, EccentricityRatio, Length, Name, Station, Viscosity

FILMS = ("cavitated", "full")


@dataclass(frozen=True, slots=True)
class SqueezeFilmDamper(Description):
    """An oil film of ``length`` [m], ``radius`` [m] and radial ``clearance`` [m], open at its ends.

    Its journal does not spin; it whirls at the speed of the spindle on a circle about the centre,
    whose radius over the clearance is ``eccentricity_ratio`` [-]. ``viscosity`` [Pa·s] is dynamic.
    ``film``: ``"cavitated"`` carries pressure over half the circumference (π film), ``"full"`` over
    all of it (2π film). A centring spring is a linear support at the same station.
    """

    name: Name
    x: Station
    viscosity: Viscosity
    length: Length
    radius: Length
    clearance: Length
    eccentricity_ratio: EccentricityRatio = 0.0
    film: Annotated[str, Choice(FILMS)] = "cavitated"

    def _faults(self) -> Iterator[str]:
        yield from film_faults(self)


class Film(Protocol):
    """A damper, as it is given or as it is read."""

    @property
    def radius(self) -> float: ...
    @property
    def clearance(self) -> float: ...


def film_faults(film: Film) -> Iterator[str]:
    """The film is thin."""
    if film.clearance >= film.radius:
        yield f"clearance must be below the radius: given {film.clearance:g} m, {film.radius:g} m"
