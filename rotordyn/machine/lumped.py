"""Masses that turn with the shaft without stiffening it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from bearings.materials import Material
from rotordyn.description import Description
from rotordyn.machine.shaft import no_wall
from rotordyn.quantity import Bore, Diameter, Inertia, Length, Mass, OptionalName, Station


@dataclass(frozen=True, slots=True)
class PointMass(Description):
    """Mass [kg] with polar and diametral inertia [kg·m²] at station ``x`` [m]."""

    name: OptionalName
    x: Station
    mass: Mass
    polar_inertia: Inertia = 0.0
    diametral_inertia: Inertia = 0.0

    def _faults(self) -> Iterator[str]:
        """A flat body has Jp = 2 Jd, a slender one less."""
        most = 2.0 * self.diametral_inertia
        if self.polar_inertia > most * (1.0 + 1e-6):
            yield (
                f"impossible body: polar_inertia {self.polar_inertia:.6g} kg m^2; "
                f"allowed: up to twice the diametral inertia, {most:.6g} kg m^2"
            )


@dataclass(frozen=True, slots=True)
class Disc(Description):
    """A rigid hollow cylinder centred on station ``x`` [m]."""

    name: OptionalName
    x: Station
    outer_diameter: Diameter
    inner_diameter: Bore
    width: Length
    material: Material

    def _faults(self) -> Iterator[str]:
        yield from no_wall(self.inner_diameter, self.outer_diameter)
        if self.outer_diameter > self.inner_diameter:
            self.as_point_mass()  # refuses a body heavier than any

    def as_point_mass(self) -> PointMass:
        """Mass and inertias of the hollow cylinder about its own centre."""
        ro, ri = self.outer_diameter / 2.0, self.inner_diameter / 2.0
        mass = self.material.density * math.pi * (ro**2 - ri**2) * self.width
        polar = mass * (ro**2 + ri**2) / 2.0
        return PointMass(self.name, self.x, mass, polar, polar / 2.0 + mass * self.width**2 / 12.0)
