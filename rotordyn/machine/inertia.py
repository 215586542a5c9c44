"""Mass, centre of gravity and moments of inertia of a rotor, in closed form."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from rotordyn.machine.cross_section import area, second_moment
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
    centre = sum(body.mass * body.centre for body in bodies) / mass
    polar = sum(body.polar for body in bodies)
    shifted = (body.diametral + body.mass * (body.centre - centre) ** 2 for body in bodies)
    return RotorInertia(mass, centre, polar, sum(shifted))


def section_inertia(section: Section, centre: float) -> RotorInertia:
    """A hollow cylinder as a rigid body at its ``centre`` [m]."""
    mass = section.material.density * section.length * _area(section)
    ring = second_moment(section.outer_diameter, section.inner_diameter)
    transverse = section.material.density * section.length * ring
    diametral = transverse + mass * section.length**2 / 12.0
    return RotorInertia(mass, centre, 2.0 * transverse, diametral)


def _area(section: Section) -> float:
    return area(section.outer_diameter, section.inner_diameter)


def _bodies(spindle: Spindle) -> Iterator[RotorInertia]:
    shaft = spindle.shaft
    for section, left in zip(shaft.sections, shaft.boundaries, strict=False):
        yield section_inertia(section, left + section.length / 2.0)
    for body in spindle.lumped:
        yield RotorInertia(body.mass, body.x, body.polar_inertia, body.diametral_inertia)
