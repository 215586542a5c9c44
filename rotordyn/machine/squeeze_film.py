"""Squeeze-film dampers between the shaft and ground."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description, Faults
from rotordyn.quantity import Choice, EccentricityRatio, Length, Name, Station, Viscosity

FILMS = ("cavitated", "full")


@dataclass(frozen=True, slots=True)
class SqueezeFilmDamper(Description):
    """A short oil film between a journal that does not spin and ground.

    The journal whirls on a circle about the centre, at the speed of what excites it or else of the
    spindle. Viscosity [Pa·s], lengths [m]. A centring spring is a linear support at the same
    station.
    """

    name: Annotated[Name, "name of the damper"]
    x: Annotated[Station, "station"]
    viscosity: Annotated[Viscosity, "dynamic, of the oil in the film"]
    length: Annotated[Length, "length of the film, open at both ends; short against the radius"]
    radius: Annotated[Length, "radius of the journal, which does not spin"]
    clearance: Annotated[Length, "radial clearance"]
    eccentricity_ratio: Annotated[
        EccentricityRatio, "ratio of the radius of the circular orbit to the clearance"
    ] = 0.0
    film: Annotated[
        str,
        Choice(FILMS),
        "`cavitated`: pressure over half the circumference (π film); `full`: over all of it "
        "([theory](theory/supports.md#squeeze-film-dampers))",
    ] = "cavitated"

    @property
    def stiff(self) -> bool:
        """Whether it has a stiffness, which is in proportion to the whirl speed."""
        return self.film == "cavitated" and self.eccentricity_ratio > 0.0

    def _faults(self) -> Faults:
        if self.clearance >= self.radius:
            yield (
                ("clearance",),
                "not thin: given {given}; allowed: below the radius, {given:radius}",
            )
