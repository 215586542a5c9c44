"""From standard elements to the rotor's matrices, M q̈ + Ω G q̇ + K q = f, dense.

Bearings, supports and joints are not included.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.equation.elements.shear import shear_coefficient
from rotordyn.equation.mesh import Mesh
from rotordyn.machine.spindle import Spindle
from tests.oracles.dense_rotor.lumped import lumped_element
from tests.oracles.dense_rotor.selection import ALL, AXIAL, PLANE_Y, PLANE_Z, TORSION, Selection
from tests.oracles.dense_rotor.timoshenko import shaft_element

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class RotorMatrices:
    """Free rotor, each of shape (width·nodes, width·nodes); ``gyroscopic`` per unit of spin.

    ``translational_mass``: the share of the mass that belongs to motion across the axis, M_ω of
    what is called spin softening.
    """

    mass: Array
    gyroscopic: Array
    stiffness: Array
    translational_mass: Array


@dataclass(frozen=True, eq=False, slots=True)
class BendingPlane:
    """One bending plane of the free rotor, each of shape (2·nodes, 2·nodes), symmetric.

    Order (r, φ) node by node; whirl at ω (its sign the direction) obeys
    (K + ω Ω Jp − ω² M) φ = 0 with ``polar`` Jp ≥ 0.
    """

    mass: Array
    polar: Array
    stiffness: Array
    translational_mass: Array


def rotor_matrices(spindle: Spindle, mesh: Mesh, selection: Selection = ALL) -> RotorMatrices:
    """Of the DOF of ``selection``."""
    names = ("mass", "gyroscopic", "stiffness", "translational_mass")
    return RotorMatrices(*(_matrix(spindle, mesh, name, selection, selection) for name in names))


def bending_plane(spindle: Spindle, mesh: Mesh) -> BendingPlane:
    """The half-size complex form of an isotropic rotor."""
    own = rotor_matrices(spindle, mesh, PLANE_Y)
    polar = _matrix(spindle, mesh, "gyroscopic", PLANE_Y, PLANE_Z)
    return BendingPlane(own.mass, polar, own.stiffness, own.translational_mass)


def axial_rod(spindle: Spindle, mesh: Mesh) -> RotorMatrices:
    """Axial motion, a row a node."""
    return rotor_matrices(spindle, mesh, AXIAL)


def torsion_rod(spindle: Spindle, mesh: Mesh) -> RotorMatrices:
    """Torsion, a row a node."""
    return rotor_matrices(spindle, mesh, TORSION)


def chain(blocks: Array) -> Array:
    """Elements in a row, (elements, 2w, 2w), each sharing a node with the next -> (N, N)."""
    width = blocks.shape[-1] // 2
    total = np.zeros((len(blocks) * width + width,) * 2)
    for k, block in enumerate(blocks):
        own = slice(width * k, width * (k + 2))
        total[own, own] += block
    return total


def add_at_nodes(matrix: Array, nodes: Sequence[int], blocks: Array) -> Array:
    """``matrix`` (…, N, N) plus blocks (…, k, w, w) on the diagonal at k nodes; a new array.

    Leading dimensions broadcast; a node may be named more than once.
    """
    width = blocks.shape[-1]
    leading = np.broadcast_shapes(matrix.shape[:-2], blocks.shape[:-3])
    total = np.broadcast_to(matrix, (*leading, *matrix.shape[-2:])).copy()
    for place, node in enumerate(nodes):
        rows = slice(width * node, width * (node + 1))
        total[..., rows, rows] += blocks[..., place, :, :]
    return total


def _matrix(spindle: Spindle, mesh: Mesh, name: str, rows: Selection, columns: Selection) -> Array:
    if (mesh.steepness > 1.0).any():
        raise ValueError("standard elements of the dense rotor are cylinders")
    element = shaft_element(
        mesh.length,
        mesh.outer[0],
        mesh.inner[0],
        mesh.young_modulus,
        mesh.shear_modulus,
        mesh.density,
        shear_coefficient(
            spindle.shaft.shear_coefficient,
            mesh.poisson_ratio,
            mesh.inner[0] / mesh.outer[0],
        ),
    )
    shaft = chain(rows.take(getattr(element, name), columns))
    if name == "stiffness" or not spindle.lumped:
        return shaft
    bodies = np.array([getattr(lumped_element(body), name) for body in spindle.lumped])
    nodes = [mesh.node_of(body.x) for body in spindle.lumped]
    return add_at_nodes(shaft, nodes, rows.take(bodies, columns))
