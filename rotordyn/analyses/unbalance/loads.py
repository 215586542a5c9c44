"""Unbalance of every kind as loads on the nodes of a shaft per Ω², and its places."""

from __future__ import annotations

import cmath
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.arrays import Array, Complex, Flags
from rotordyn.equation.elements.beam import shapes
from rotordyn.equation.elements.polynomials import points
from rotordyn.equation.mesh import Mesh
from rotordyn.machine.balance import permissible_unbalance, plane_shares
from rotordyn.machine.cross_section import area
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.rotor import Place
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.across import with_stations
from rotordyn.scene.loads import BalanceGrade, EccentricSpan


class Acting(NamedTuple):
    """One unbalance [kg·m] at a ``place``; the argument of ``size`` is the angle from y to z."""

    name: str
    place: Place
    size: complex


def unbalanced(spindle: Spindle, spec: UnbalanceSpec) -> str:
    """Return the rotor out of balance; of several at one speed the first."""
    named = {spindle.place(at).rotor for at in spec.acting}
    return next(name for name in spindle.ratios if name in named)


def marked(spindle: Spindle, spec: UnbalanceSpec) -> Spindle:
    """Return the spindle with a named point at every place of unbalance or of a result."""
    return with_stations(spindle, spec.places)


def acting(spindle: Spindle, mesh: Mesh, spec: UnbalanceSpec) -> list[Acting]:
    """Return every unbalance; that of a span as one, at its centre of mass."""
    loads = [
        Acting(point.name, spindle.place(point.at), cmath.rect(point.unbalance, point.angle))
        for point in spec.unbalances
    ]
    for span in spec.spans:
        rotor, covered = _elements_within(spindle, mesh, span)
        elements = mesh.of_rotors[rotor]
        mass = np.where(covered, elements.mass, 0.0)
        centre = float((mass * elements.centre).sum() / mass.sum())
        loads.append(Acting(span.name, Place(rotor, centre), float(mass.sum()) * _offset(span)))
    loads += _grade_unbalances(spindle, spec.grade) if spec.grade else []
    return [one._replace(name=one.name or f"unbalance {k}") for k, one in enumerate(loads, start=1)]


def node_loads(spindle: Spindle, mesh: Mesh, spec: UnbalanceSpec) -> Complex:
    """Return force and moment per Ω² (nodes of all rotors, 2) [kg·m, kg·m²] on r = y + i z and its
    tilt.

    A span loads both ends of each of its elements by the consistent loads of its mass on the cubic
    shape functions of deflection and tilt (½ and ± 1/12 of the length for a cylinder).
    """
    loads = np.zeros((len(mesh.stations), 2), dtype=complex)
    for unbalance in spec.unbalances:
        node = mesh.node_at(*spindle.place(unbalance.at))
        loads[node, 0] += cmath.rect(unbalance.unbalance, unbalance.angle)
    for load in _grade_unbalances(spindle, spec.grade) if spec.grade else []:
        loads[mesh.node_at(*load.place), 0] += load.size
    for span in spec.spans:
        rotor, covered = _elements_within(spindle, mesh, span)
        elements, of_rotor = mesh.of_rotors[rotor], loads[mesh.spans[rotor]]
        size = np.where(covered, _offset(span), 0.0)[:, None] * _end_masses(elements)
        of_rotor[:-1] += size[:, :2]
        of_rotor[1:] += size[:, 2:]
    return loads


def _grade_unbalances(spindle: Spindle, grade: BalanceGrade) -> list[Acting]:
    places = [spindle.place(at) for at in grade.planes]
    name = places[0].rotor
    rotor = rotor_inertia(spindle.part(name))
    rotor_speed = abs(spindle.ratios[name]) * grade.speed
    total = permissible_unbalance(grade.quality, rotor.mass, rotor_speed)
    ends = [place.x for place in places]
    shares = (1.0,) if len(places) == 1 else plane_shares(rotor.centre, ends[0], ends[1])
    signs = (1.0, 1.0 if grade.phase == "static" else -1.0)
    named = zip(_plane_names(grade), places, shares, signs, strict=False)
    return [
        Acting(name, place, sign * cmath.rect(share * total, grade.angle))
        for name, place, share, sign in named
    ]


def _plane_names(grade: BalanceGrade) -> Iterator[str]:
    for number, at in enumerate(grade.planes, start=1):
        yield f"G {grade.quality * 1e3:g} {at if isinstance(at, str) else f'plane {number}'}"


def _offset(span: EccentricSpan) -> complex:
    return cmath.rect(span.eccentricity, span.angle)


def _end_masses(mesh: Mesh) -> Array:
    """Return mass and its moment at both ends of each element (elements, 4) [kg, kg·m]."""
    xi, weight = points(6)
    cubic = shapes(mesh.length, np.zeros_like(mesh.length), 1, xi).deflection
    mass = mesh.density[:, None] * area(*mesh.diameters(xi)) * weight * mesh.length[:, None] / 2.0
    return np.einsum("ep,epi->ei", mass, cubic)


def _elements_within(spindle: Spindle, mesh: Mesh, span: EccentricSpan) -> tuple[str, Flags]:
    """Return the rotor of a span, and flags of its elements within the span."""
    first, last = spindle.place(span.start), spindle.place(span.to)
    middle = mesh.of_rotors[first.rotor].middle
    return first.rotor, np.asarray((first.x < middle) & (middle < last.x))
