"""Masses that turn with the shaft without stiffening it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from bearings.materials import Material
from rotordyn.description import Description, Faults
from rotordyn.machine.shaft import no_wall
from rotordyn.quantity import (
    MASS,
    Bore,
    Diameter,
    Inertia,
    Key,
    Length,
    Mass,
    OptionalName,
    Station,
)


@dataclass(frozen=True, slots=True)
class PointMass(Description):
    """A rigid mass [kg] with its inertias [kg·m²] at a station."""

    name: Annotated[OptionalName, "name in messages and overrides"]
    x: Annotated[Station, "station"]
    mass: Annotated[Mass, "mass of the body"]
    polar_inertia: Annotated[Inertia, "moment of inertia about the axis"] = 0.0
    diametral_inertia: Annotated[
        Inertia, "moment of inertia about a diameter through its centre"
    ] = 0.0

    def _faults(self) -> Faults:
        """Yield a fault where Jp > 2 Jd: a flat body has Jp = 2 Jd, a slender one less."""
        limit = 2.0 * self.diametral_inertia
        if self.polar_inertia > limit * (1.0 + 1e-6):
            yield (
                ("polar_inertia",),
                "impossible body: given {given}; allowed: up to twice the diametral inertia, "
                f"{limit:.6g} kg m^2",
            )


@dataclass(frozen=True, slots=True)
class Disc(Description):
    """A rigid hollow cylinder centred on a station."""

    name: Annotated[OptionalName, "name in messages and overrides"]
    x: Annotated[Station, "station of its centre"]
    outer_diameter: Annotated[Diameter, "above the inner one"]
    inner_diameter: Annotated[Bore, "bore"]
    width: Annotated[Length, "along the axis"]
    material: Annotated[Material, Key(), "name, path or mapping"]

    def _faults(self) -> Faults:
        faults = [*no_wall(self.inner_diameter, self.outer_diameter)]
        yield from faults
        mass = 0.0 if faults else self._mass
        if mass == mass and not MASS.holds(mass):
            yield (), f"the mass of the disc: {MASS.refusal(mass)}"

    @property
    def _mass(self) -> float:
        ro, ri = self.outer_diameter / 2.0, self.inner_diameter / 2.0
        return self.material.density * math.pi * (ro**2 - ri**2) * self.width

    def as_point_mass(self) -> PointMass:
        """Return the mass and inertias of the hollow cylinder about its own centre."""
        ro, ri = self.outer_diameter / 2.0, self.inner_diameter / 2.0
        polar = self._mass * (ro**2 + ri**2) / 2.0
        diametral = polar / 2.0 + self._mass * self.width**2 / 12.0
        return PointMass(self.name, self.x, self._mass, polar, diametral)
