"""From elements to the rotor's matrices.

M q̈ + Ω G q̇ + K q = f. ``translational_mass`` is the share of M that belongs to motion across the
axis, M_ω of what is called spin softening. Bearings and supports are not included: they join the
rotor in its reduced coordinates.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tests.oracles.dense_rotor.lumped import LumpedElement, lumped_element
from rotordyn.model.elements.standard_beam import plane_bending
from rotordyn.model.elements.rod import rod
from rotordyn.model.elements.shear import shear_coefficient
from tests.oracles.dense_rotor.timoshenko import shaft_element
from rotordyn.machine.cross_section import area, second_moment
from rotordyn.machine.spindle import Spindle
from rotordyn.numerics.sparse import Matrix, is_sparse, summed
from tests.oracles.dense_rotor.selection import ALL, AXIAL, PLANE_Y, PLANE_Z, TORSION, Selection
from rotordyn.model.hierarchy import Hierarchy
from rotordyn.system.jumps import hinged
from rotordyn.model.mesh import Mesh

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class RotorMatrices:
    """Free rotor, each of shape (width·nodes, width·nodes); ``gyroscopic`` per unit of spin."""

    mass: Matrix
    gyroscopic: Matrix
    stiffness: Matrix
    translational_mass: Matrix


@dataclass(frozen=True, eq=False, slots=True)
class BendingPlane:
    """One lateral plane of the free rotor, each of shape (2·nodes, 2·nodes), symmetric.

    Order (r, φ) node by node; whirl at ω (its sign the direction) obeys
    (K + ω Ω Jp − ω² M) φ = 0 with ``polar`` Jp ≥ 0.
    """

    mass: Matrix
    polar: Matrix
    stiffness: Matrix
    translational_mass: Matrix


@dataclass(frozen=True, eq=False, slots=True)
class RodMatrices:
    """Axial or torsional motion of the free rotor, each of shape (nodes, nodes)."""

    mass: Matrix
    stiffness: Matrix


def rotor_matrices(spindle: Spindle, mesh: Mesh, selection: Selection = ALL) -> RotorMatrices:
    """The freedoms of ``selection`` only, assembled directly (never sliced from 6 per node)."""
    element = shaft_element(*beam_arguments(spindle, mesh))
    lumped = _Lumped.of(spindle, mesh)
    return RotorMatrices(
        mass=_joined(selection.take(element.mass), lumped, lumped.mass(selection)),
        gyroscopic=_joined(
            selection.take(element.gyroscopic), lumped, lumped.gyroscopic(selection, selection)
        ),
        stiffness=chain(selection.take(element.stiffness)),
        translational_mass=_joined(
            selection.take(element.translational_mass), lumped, lumped.translational(selection)
        ),
    )


def bending_plane(spindle: Spindle, mesh: Mesh) -> BendingPlane:
    """The half-size complex form of an isotropic rotor (``dofs.PLANE_Y`` order)."""
    element = plane_bending(*beam_arguments(spindle, mesh))
    lumped = _Lumped.of(spindle, mesh)
    return BendingPlane(
        mass=_joined(element.mass, lumped, lumped.mass(PLANE_Y)),
        polar=_joined(element.polar, lumped, lumped.gyroscopic(PLANE_Y, PLANE_Z)),
        stiffness=chain(_jointed(spindle, mesh, element.stiffness)),
        translational_mass=_joined(
            element.translational_mass, lumped, lumped.translational(PLANE_Y)
        ),
    )


def _jointed(spindle: Spindle, mesh: Mesh, blocks: Array) -> Array:
    """Elements behind joints hang on these: right at rest, masses do not know of it."""
    if not spindle.joints:
        return blocks
    whole = blocks.copy()
    for joint in spindle.joints:
        k = mesh.node_of(joint.x)
        whole[k] = hinged(blocks[k], joint)
    return whole


def loaded_plane(spindle: Spindle, elements: Hierarchy) -> BendingPlane:
    """A bending plane of any elements, with what is lumped at their nodes."""
    (nodes, at_nodes), matrices = lumped_plane(spindle, elements.mesh), elements.matrices()
    added = {n: _loaded(elements, matrices[n], nodes, b) for n, b in at_nodes.items()}
    return BendingPlane(stiffness=matrices["stiffness"], **added)


def lumped_plane(spindle: Spindle, mesh: Mesh) -> tuple[tuple[int, ...], dict[str, Array]]:
    """Nodes of point masses and discs, and their matrices by name (bodies, 2, 2) in a bending
    plane; a node may be named more than once."""
    lumped = _Lumped.of(spindle, mesh)
    return lumped.nodes, {
        "mass": lumped.mass(PLANE_Y),
        "polar": lumped.gyroscopic(PLANE_Y, PLANE_Z),
        "translational_mass": lumped.translational(PLANE_Y),
    }


def loaded_rod(spindle: Spindle, elements: Hierarchy, selection: Selection) -> RodMatrices:
    """Axial motion or torsion of any rods, likewise."""
    lumped, matrices = _Lumped.of(spindle, elements.mesh), elements.matrices()
    mass = _loaded(elements, matrices["mass"], lumped.nodes, lumped.mass(selection))
    return RodMatrices(mass, matrices["stiffness"])


def _loaded(elements: Hierarchy, matrix: Matrix, nodes: Sequence[int], blocks: Array) -> Matrix:
    """``matrix`` plus what sits at nodes, which the jumps in front of them move as well."""
    return matrix + elements.at_nodes(nodes, blocks) if nodes else matrix


def axial_rod(spindle: Spindle, mesh: Mesh) -> RodMatrices:
    """Axial motion: freedoms x."""
    ring = area(mesh.outer_diameter, mesh.inner_diameter)
    element = rod(mesh.length, mesh.young_modulus * ring, mesh.density * ring)
    lumped = _Lumped.of(spindle, mesh)
    return RodMatrices(_joined(element.mass, lumped, lumped.mass(AXIAL)), chain(element.stiffness))


def torsion_rod(spindle: Spindle, mesh: Mesh) -> RodMatrices:
    """Torsion: freedoms thx."""
    polar = 2.0 * second_moment(mesh.outer_diameter, mesh.inner_diameter)
    element = rod(mesh.length, mesh.shear_modulus * polar, mesh.density * polar)
    lumped = _Lumped.of(spindle, mesh)
    return RodMatrices(
        _joined(element.mass, lumped, lumped.mass(TORSION)), chain(element.stiffness)
    )


def shear_coefficients(spindle: Spindle, mesh: Mesh) -> Array:
    """κ of every element (elements,)."""
    ratio = mesh.inner_diameter / mesh.outer_diameter
    return shear_coefficient(spindle.shaft.shear_coefficient, mesh.poisson_ratio, ratio)


def chain(blocks: Array) -> Matrix:
    """Elements in a row, (elements, 2w, 2w), each sharing a node with the next -> (N, N)."""
    elements, width = len(blocks), blocks.shape[-1] // 2
    rows = width * np.arange(elements)[:, None] + np.arange(2 * width)
    size = (elements + 1) * width
    return summed((size, size), [(rows, rows, blocks)], large=size >= 1000)


def add_at_nodes(matrix: Matrix, nodes: Sequence[int], blocks: Array) -> Matrix:
    """``matrix`` (…, N, N) plus blocks (…, k, w, w) on the diagonal at k nodes; a new array.

    Leading dimensions broadcast; a node may be named more than once. Of compressed rows, (N, N).
    """
    width = blocks.shape[-1]
    if is_sparse(matrix):
        rows = width * np.asarray(nodes, dtype=np.intp)[:, None] + np.arange(width)
        return matrix + summed(matrix.shape, [(rows, rows, blocks)], large=True)
    leading = np.broadcast_shapes(matrix.shape[:-2], blocks.shape[:-3])
    total = np.broadcast_to(matrix, (*leading, *matrix.shape[-2:])).copy()
    for place, node in enumerate(nodes):
        rows = slice(width * node, width * (node + 1))
        total[..., rows, rows] += blocks[..., place, :, :]
    return total


@dataclass(frozen=True, slots=True)
class _Lumped:
    """Point masses and discs with the nodes they sit on."""

    nodes: tuple[int, ...]
    elements: tuple[LumpedElement, ...]

    @classmethod
    def of(cls, spindle: Spindle, mesh: Mesh) -> _Lumped:
        bodies = spindle.lumped
        return cls(
            tuple(mesh.node_of(body.x) for body in bodies),
            tuple(lumped_element(body) for body in bodies),
        )

    def mass(self, selection: Selection) -> Array:
        return selection.take(_stack([e.mass for e in self.elements]))

    def translational(self, selection: Selection) -> Array:
        return selection.take(_stack([e.translational_mass for e in self.elements]))

    def gyroscopic(self, rows: Selection, columns: Selection) -> Array:
        return rows.take(_stack([e.gyroscopic for e in self.elements]), columns)


def _stack(matrices: list[Array]) -> Array:
    return np.array(matrices).reshape(-1, 6, 6)


def _joined(blocks: Array, lumped: _Lumped, at_nodes: Array) -> Matrix:
    return add_at_nodes(chain(blocks), lumped.nodes, at_nodes)


def beam_arguments(
    spindle: Spindle, mesh: Mesh
) -> tuple[Array, Array, Array, Array, Array, Array, Array]:
    """The arguments of a beam element, for all elements at once."""
    return (
        mesh.length,
        mesh.outer_diameter,
        mesh.inner_diameter,
        mesh.young_modulus,
        mesh.shear_modulus,
        mesh.density,
        shear_coefficients(spindle, mesh),
    )
