"""Mass, centre of gravity and inertias of everything that turns, in closed form."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rotordyn.machine.lumped import PointMass
from rotordyn.machine.shaft import Section
from rotordyn.machine.spindle import Spindle


@dataclass(frozen=True, slots=True)
class MassProperties:
    """``mass`` [kg], ``centre`` of gravity on the axis [m], inertias [kg·m²] about that centre."""

    mass: float
    centre: float
    polar_inertia: float
    diametral_inertia: float


def mass_properties(spindle: Spindle) -> MassProperties:
    """Of the shaft's sections, the discs and the point masses together."""
    edges = spindle.shaft.boundaries
    parts = [_cylinder(s, x) for s, x in zip(spindle.shaft.sections, edges, strict=False)]
    parts += spindle.lumped
    mass = sum(p.mass for p in parts)
    centre = sum(p.mass * p.x for p in parts) / mass
    polar = sum(p.polar_inertia for p in parts)
    diametral = sum(p.diametral_inertia + p.mass * (p.x - centre) ** 2 for p in parts)
    return MassProperties(mass, centre, polar, diametral)


def _cylinder(section: Section, left: float) -> PointMass:
    """A section as a point mass at its own middle."""
    outer, inner = section.outer_diameter / 2.0, section.inner_diameter / 2.0
    mass = section.material.density * math.pi * (outer**2 - inner**2) * section.length
    polar = mass * (outer**2 + inner**2) / 2.0
    diametral = polar / 2.0 + mass * section.length**2 / 12.0
    return PointMass(section.name, left + section.length / 2.0, mass, polar, diametral)
