"""Mass, centre of gravity and moments of inertia of a rotor, in closed form."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotordyn.arrays import Array
from rotordyn.machine.cross_section import area_moments, mean_area, mean_second_moment
from rotordyn.machine.shaft import Section, Shaft
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
    """Return the inertia of all rotating parts: sections, point masses, discs."""
    bodies = tuple(_bodies(spindle))
    mass = sum(body.mass for body in bodies)
    centre = sum(body.mass * body.centre for body in bodies) / mass
    polar = sum(body.polar for body in bodies)
    shifted = (body.diametral + body.mass * (body.centre - centre) ** 2 for body in bodies)
    return RotorInertia(mass, centre, polar, sum(shifted))


def section_inertia(section: Section, front: float) -> RotorInertia:
    """Return the inertia of a rigid hollow cylinder or cone with its ``front`` end there [m]."""
    line, length = section.density * section.length, section.length
    mass = line * mean_area(section.outer, section.inner)
    first, second = (line * moment for moment in area_moments(section.outer, section.inner))
    transverse = line * mean_second_moment(section.outer, section.inner)
    diametral = transverse + (second - first**2 / mass) * length**2
    centre = front + (0.5 + first / mass) * length
    return RotorInertia(mass, centre, 2.0 * transverse, diametral)


def mass_in_front(shaft: Shaft, x: Array) -> Array:
    """Return the mass of the shaft in front of stations ``x`` [m], without bodies on it [kg]."""
    columns: Any = [(*s.outer, *s.inner, s.density, s.length) for s in shaft.sections]
    front_outer, rear_outer, front_inner, rear_inner, density, length = np.array(columns).T
    edges = np.array(shaft.boundaries)
    outer, inner = (front_outer, rear_outer), (front_inner, rear_inner)
    masses = density * length * mean_area(outer, inner)
    k = np.clip(np.searchsorted(edges, x) - 1, 0, len(masses) - 1)
    share = np.clip((x - edges[k]) / length[k], 0.0, 1.0)
    ends = [(a[k], a[k] + share * (b - a)[k]) for a, b in (outer, inner)]
    cumulative = np.concatenate([[0.0], np.cumsum(masses)])
    return np.asarray(cumulative[k] + density[k] * length[k] * share * mean_area(ends[0], ends[1]))


def _bodies(spindle: Spindle) -> Iterator[RotorInertia]:
    shaft = spindle.shaft
    for section, left in zip(shaft.sections, shaft.boundaries, strict=False):
        yield section_inertia(section, left)
    for body in spindle.lumped:
        yield RotorInertia(body.mass, body.x, body.polar_inertia, body.diametral_inertia)
