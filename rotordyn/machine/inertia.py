"""Mass, centre of gravity and moments of inertia of a rotor, in closed form."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from rotordyn.machine.cross_section import area, second_moment
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.shaft import Section
from rotordyn.machine.spindle import Spindle


@dataclass(frozen=True, slots=True)
class RotorInertia:
    """``mass`` [kg], ``centre`` of gravity x [m], ``polar`` inertia about the axis and
    ``diametral`` inertia about a diameter through the centre of gravity [kg·m²]."""

    mass: float
    centre: float
    polar: float
    diametral: float


def rotor_inertia(spindle: Spindle) -> RotorInertia:
    """Everything that turns: sections, point masses, discs."""
    bodies = tuple(_bodies(spindle))
    mass = sum(body.mass for body in bodies)
    centre = sum(body.mass * body.x for body in bodies) / mass
    polar = sum(body.polar_inertia for body in bodies)
    shifted = (body.diametral_inertia + body.mass * (body.x - centre) ** 2 for body in bodies)
    return RotorInertia(mass, centre, polar, sum(shifted))


def section_inertia(section: Section, centre: float) -> PointMass:
    """A hollow cylinder as a rigid body at its ``centre`` [m]."""
    mass = section.material.density * section.length * _area(section)
    ring = second_moment(section.outer_diameter, section.inner_diameter)
    transverse = section.material.density * section.length * ring
    diametral = transverse + mass * section.length**2 / 12.0
    return PointMass(section.name, centre, mass, 2.0 * transverse, diametral)


def _area(section: Section) -> float:
    return area(section.outer_diameter, section.inner_diameter)


def _bodies(spindle: Spindle) -> Iterator[PointMass]:
    shaft = spindle.shaft
    for section, left in zip(shaft.sections, shaft.boundaries, strict=False):
        yield section_inertia(section, left + section.length / 2.0)
    yield from spindle.lumped
