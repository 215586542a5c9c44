"""Masses that turn with the shaft without stiffening it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from bearings.materials import Material


@dataclass(frozen=True, slots=True)
class PointMass:
    """Mass [kg] with polar and diametral inertia [kg·m²] at station ``x`` [m]."""

    name: str
    x: float
    mass: float
    polar_inertia: float = 0.0
    diametral_inertia: float = 0.0


@dataclass(frozen=True, slots=True)
class Disc:
    """A rigid hollow cylinder centred on station ``x`` [m]."""

    name: str
    x: float
    outer_diameter: float
    inner_diameter: float
    width: float
    material: Material

    def as_point_mass(self) -> PointMass:
        """Mass and inertias of the hollow cylinder about its own centre."""
        ro, ri = self.outer_diameter / 2.0, self.inner_diameter / 2.0
        mass = self.material.density * math.pi * (ro**2 - ri**2) * self.width
        polar = mass * (ro**2 + ri**2) / 2.0
        return PointMass(self.name, self.x, mass, polar, polar / 2.0 + mass * self.width**2 / 12.0)
