"""Bending, axial motion and torsion of the free rotor in elements as fine as a tolerance asks."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements import hierarchic_bending as bending
from rotordyn.elements import hierarchic_rod as rod_element
from rotordyn.elements.plane_bending import shear_parameter
from rotordyn.errors import InvalidInput
from rotordyn.machine.cross_section import area, second_moment
from rotordyn.machine.spindle import Spindle
from rotordyn.numerics.sparse import Matrix, Part, summed
from rotordyn.system.assemble import beam_arguments, shear_coefficients
from rotordyn.system.degrees import (
    bending_wave,
    expected_error,
    parts_and_degree,
    resolved,
    rod_wave,
)
from rotordyn.system.hierarchy import Degrees, Hierarchy, divided
from rotordyn.system.jumps import BENDING, Jump, jumps
from rotordyn.system.mesh import Mesh, station_mesh

Array = NDArray[np.float64]
MOST_FREEDOMS = 200_000


def bending_hierarchy(spindle: Spindle, omega: float, spin: float, tolerance: float) -> Hierarchy:
    """Elements for whirl up to ``omega`` at speeds up to ``spin`` [rad/s] within ``tolerance``."""
    coarse = station_mesh(spindle)
    wave = bending_wave(omega, spin, *_rigidities(spindle, coarse))
    parts, degree = parts_and_degree(wave * coarse.length, tolerance)
    _refuse_many("bending", float((np.where(degree < 2, 0, 2 * degree - 1) + 2) @ parts), omega)
    mesh = divided(coarse, parts)
    return beams(spindle, mesh, np.repeat(degree, parts))


def _refuse_many(motion: str, freedoms: float, omega: float) -> None:
    """Raise InvalidInput where the matrices of a motion would not fit."""
    if freedoms > MOST_FREEDOMS:
        raise InvalidInput(
            f"{motion} up to {omega / (2.0 * math.pi):.6g} Hz takes {freedoms:.3g} freedoms; "
            f"allowed: up to {MOST_FREEDOMS}; ask for lower frequencies or speeds, less accuracy, "
            "or join sections that are alike"
        )


def resolved_whirl(spindle: Spindle, elements: Hierarchy, spin: float, tolerance: float) -> float:
    """Highest whirl [rad/s] that the elements carry within ``tolerance`` up to ``spin``."""
    mesh, rigidities = elements.mesh, _rigidities(spindle, elements.mesh)

    def error(omega: float) -> float:
        phase = bending_wave(omega, spin, *rigidities) * mesh.length
        return float(expected_error(phase, elements.degree).max())

    return resolved(error, tolerance, 1.0)


def half_wave(spindle: Spindle, mesh: Mesh, spin: float) -> float:
    """Highest whirl [rad/s] that crosses no element of ``mesh`` by more than half a wave."""
    rigidities = _rigidities(spindle, mesh)

    def phase(omega: float) -> float:
        return float((bending_wave(omega, spin, *rigidities) * mesh.length).max())

    return resolved(phase, math.pi, 1.0)


def beams(spindle: Spindle, mesh: Mesh, degree: Degrees) -> Hierarchy:
    """Bending elements of given degrees between the nodes of ``mesh``."""
    arguments = beam_arguments(spindle, mesh)

    def element(chosen: Degrees, n: int) -> dict[str, Array]:
        own = bending.hierarchic_bending(*(a[chosen] for a in arguments), degree=n)
        names = ("mass", "translational_mass", "polar", "stiffness")
        return {name: getattr(own, name) for name in names}

    inner, added = bending.inner_freedoms, bending.added_freedoms
    return Hierarchy(mesh, degree, 2, inner, element, added, jumps(spindle, BENDING))


def rigid_motions(elements: Hierarchy) -> Array:
    """Translation and tilt about the middle by all freedoms (size, 2); no inner one takes part."""
    x, whole = elements.mesh.x, np.zeros((elements.size, 2))
    nodal = whole[: 2 * len(x)].reshape(len(x), 2, 2)
    nodal[:, 0, 0], nodal[:, 0, 1], nodal[:, 1, 1] = 1.0, x - x.mean(), 1.0
    return whole


def deflections(spindle: Spindle, elements: Hierarchy, x: Array) -> Matrix:
    """Deflection and tilt at stations ``x`` by all freedoms (2·stations, size)."""
    parts = []
    for at, rows, shape in _shapes(spindle, elements, x):
        both = np.stack([shape.deflection[:, 0], shape.rotation[:, 0]], axis=1)
        parts.append((2 * at[:, None] + np.arange(2), rows, both))
    return _with_jumps(elements, parts, elements.jumped(x))


def slopes(spindle: Spindle, elements: Hierarchy, x: Array) -> Matrix:
    """Slope v′ at places ``x`` between nodes by all freedoms (places, size)."""
    found = _shapes(spindle, elements, x)
    parts = [(at[:, None], rows, shape.slope) for at, rows, shape in found]
    return _with_jumps(elements, parts, elements.jumped(x)[1::2])


def _shapes(
    spindle: Spindle, elements: Hierarchy, x: Array
) -> Iterator[tuple[Degrees, Degrees, bending.Shapes]]:
    """Of the stations ``x`` in elements of one degree: which, freedoms of their elements
    (stations, k), shape functions (stations, 1, k)."""
    mesh, (element, xi) = elements.mesh, elements.place(x)
    shear, bend = bending_rigidities(spindle, mesh)
    phi = shear_parameter(mesh.length, bend, shear)
    degree = elements.degree[element]
    for n in np.unique(degree):
        at = np.flatnonzero(degree == n)
        own = element[at]
        shape = bending.shapes(mesh.length[own], phi[own], int(n), xi[at, None])
        yield at, elements.rows(own), shape


def _with_jumps(elements: Hierarchy, parts: list[Part], jumped: Array) -> Matrix:
    """Motion of places by elements' freedoms, and by the jumps (places, jumps)."""
    every = np.arange(len(jumped))
    if jumped.size:
        own = np.arange(elements.size - jumped.shape[1], elements.size)
        parts = [*parts, (every[:, None], np.broadcast_to(own, jumped.shape), jumped[:, None])]
    return summed((len(jumped), elements.size), parts, large=elements.large)


def rod_hierarchy(
    spindle: Spindle,
    omega: float,
    tolerance: float,
    properties: Callable[[Mesh], tuple[Array, Array]],
    way: str,
) -> Hierarchy:
    """Elements for axial motion or torsion up to ``omega`` [rad/s] within ``tolerance``.

    ``properties``: rigidity and inertia of a mesh's elements per length; ``way`` of joints.
    """
    coarse = station_mesh(spindle)
    wave = rod_wave(omega, *properties(coarse))
    parts, degree = parts_and_degree(wave * coarse.length, tolerance)
    _refuse_many("torsion" if way == "torsion" else "axial motion", float(degree @ parts), omega)
    given = jumps(spindle, (way,))
    return rods(divided(coarse, parts), np.repeat(degree, parts), properties, given)


def rods(
    mesh: Mesh,
    degree: Degrees,
    properties: Callable[[Mesh], tuple[Array, Array]],
    given: tuple[Jump, ...] = (),
) -> Hierarchy:
    """Rods of given degrees between the nodes of ``mesh``, with the jumps ``given``."""
    rigidity, inertia = properties(mesh)

    def element(chosen: Degrees, n: int) -> dict[str, Array]:
        own = rod_element.hierarchic_rod(
            mesh.length[chosen], rigidity[chosen], inertia[chosen], degree=n
        )
        return {"mass": own.mass, "stiffness": own.stiffness}

    inner, added = rod_element.inner_freedoms, rod_element.added_freedoms
    return Hierarchy(mesh, degree, 1, inner, element, added, given)


def rod_displacements(elements: Hierarchy, x: Array) -> Matrix:
    """Displacement at stations ``x`` by all freedoms (stations, size)."""
    element, xi = elements.place(x)
    degree, parts = elements.degree[element], []
    for n in np.unique(degree):
        at = np.flatnonzero(degree == n)
        shape = rod_element.shapes(int(n), xi[at, None])
        parts.append((at[:, None], elements.rows(element[at]), shape))
    return _with_jumps(elements, parts, elements.jumped(x))


def jump_damping(elements: Hierarchy, vectors: Array) -> Array:
    """Damping by the joints in the coordinates of ``vectors`` (size, m), (m, m)."""
    moved = vectors[elements.size - len(elements.jumps) :]
    return np.asarray(moved.T @ (np.array([j.damping for j in elements.jumps])[:, None] * moved))


def axial_properties(mesh: Mesh) -> tuple[Array, Array]:
    """E A [N] and ρ A [kg/m] of every element."""
    ring = area(mesh.outer_diameter, mesh.inner_diameter)
    return mesh.young_modulus * ring, mesh.density * ring


def torsion_properties(mesh: Mesh) -> tuple[Array, Array]:
    """G Ip [N·m²] and ρ Ip [kg·m] of every element."""
    polar = 2.0 * second_moment(mesh.outer_diameter, mesh.inner_diameter)
    return mesh.shear_modulus * polar, mesh.density * polar


def bending_rigidities(spindle: Spindle, mesh: Mesh) -> tuple[Array, Array]:
    """κGA [N] and EI [N·m²] of every element."""
    shear, bend, *_ = _rigidities(spindle, mesh)
    return shear, bend


def _rigidities(spindle: Spindle, mesh: Mesh) -> tuple[Array, Array, Array, Array]:
    """κGA, EI, ρA, ρI of every element."""
    ring = area(mesh.outer_diameter, mesh.inner_diameter)
    moment = second_moment(mesh.outer_diameter, mesh.inner_diameter)
    kappa = shear_coefficients(spindle, mesh)
    return (
        kappa * mesh.shear_modulus * ring,
        mesh.young_modulus * moment,
        mesh.density * ring,
        mesh.density * moment,
    )
