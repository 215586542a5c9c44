"""Unbalance of every kind as what the nodes of a shaft carry per Ω², and where it acts."""

from __future__ import annotations

import cmath
from collections.abc import Iterator
from dataclasses import replace
from itertools import count
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.loads import BalanceGrade, EccentricSpan, station
from rotordyn.analysis.specs import UnbalanceSpec
from rotordyn.machine.balance import permissible_unbalance, plane_shares
from rotordyn.machine.cross_section import area
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.spindle import Spindle
from rotordyn.system.mesh import Mesh

Complex = NDArray[np.complex128]


class Acting(NamedTuple):
    """One unbalance [kg·m] at ``x`` [m]; its argument is the angle from y to z."""

    name: str
    x: float
    size: complex


def marked(spindle: Spindle, spec: UnbalanceSpec) -> Spindle:
    """With a named point wherever unbalance acts, so that nodes and static answers are there."""
    free = (name for k in count(1) if (name := f"station {k}") not in spindle.points)
    known = {station(spindle, at) for at in spec.places} - set(spindle.points.values())
    own = {next(free): x for x in sorted(known)}
    return replace(spindle, points={**spindle.points, **own}) if own else spindle


def acting(spindle: Spindle, mesh: Mesh, spec: UnbalanceSpec) -> list[Acting]:
    """Every unbalance; that of a span as a whole, at its middle by mass."""
    found = [
        Acting(each.name, station(spindle, each.at), cmath.rect(each.unbalance, each.angle))
        for each in spec.unbalances
    ]
    for span in spec.spans:
        own, mass = _covered(spindle, mesh, span), _mass(mesh)
        total = float(mass[own].sum())
        middle = float((mass * mesh.middle)[own].sum()) / total
        found.append(Acting(span.name, middle, total * _off_axis(span)))
    found += _permitted(spindle, spec.grade) if spec.grade else []
    return [one._replace(name=one.name or f"unbalance {k}") for k, one in enumerate(found, start=1)]


def node_loads(spindle: Spindle, mesh: Mesh, spec: UnbalanceSpec) -> Complex:
    """Force and moment per Ω² (nodes, 2) [kg·m, kg·m²] on r = y + i z and its tilt.

    A span loads both ends of each of its elements by ½ and ± 1/12 of the length, which does the
    work of a uniform load on them.
    """
    loads = np.zeros((mesh.nodes, 2), dtype=complex)
    for each in spec.unbalances:
        node = mesh.node_of(station(spindle, each.at))
        loads[node, 0] += cmath.rect(each.unbalance, each.angle)
    for one in _permitted(spindle, spec.grade) if spec.grade else []:
        loads[mesh.node_of(one.x), 0] += one.size
    for span in spec.spans:
        own = _covered(spindle, mesh, span)
        size = np.where(own, _mass(mesh) * _off_axis(span), 0.0)
        turn = size * mesh.length / 12.0
        loads[:-1] += np.stack([size / 2.0, turn], axis=1)
        loads[1:] += np.stack([size / 2.0, -turn], axis=1)
    return loads


def _permitted(spindle: Spindle, grade: BalanceGrade) -> list[Acting]:
    rotor = rotor_inertia(spindle)
    whole = permissible_unbalance(grade.quality, rotor.mass, grade.speed)
    places = [station(spindle, at) for at in grade.planes]
    shares = (1.0,) if len(places) == 1 else plane_shares(rotor.centre, places[0], places[1])
    signs = (1.0, 1.0 if grade.phase == "static" else -1.0)
    named = zip(_plane_names(grade), places, shares, signs, strict=False)
    return [
        Acting(name, x, sign * cmath.rect(share * whole, grade.angle))
        for name, x, share, sign in named
    ]


def _plane_names(grade: BalanceGrade) -> Iterator[str]:
    for number, at in enumerate(grade.planes, start=1):
        yield f"G {grade.quality * 1e3:g} {at if isinstance(at, str) else f'plane {number}'}"


def _off_axis(span: EccentricSpan) -> complex:
    return cmath.rect(span.eccentricity, span.angle)


def _mass(mesh: Mesh) -> NDArray[np.float64]:
    section = area(mesh.outer_diameter, mesh.inner_diameter)
    return np.asarray(mesh.density * section * mesh.length)


def _covered(spindle: Spindle, mesh: Mesh, span: EccentricSpan) -> NDArray[np.bool_]:
    first, last = station(spindle, span.start), station(spindle, span.to)
    return np.asarray((first < mesh.middle) & (mesh.middle < last))
