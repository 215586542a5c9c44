"""A spindle's motion without any reduction: every freedom of every node, dense matrices."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cholesky, eigh, eigvals, solve_triangular

from rotordyn.elements.support import node_matrix, turn
from rotordyn.machine.spindle import Spindle
from rotordyn.system.assemble import add_at_nodes, rotor_matrices
from rotordyn.system.dofs import LATERAL, Selection
from rotordyn.system.mesh import Mesh

Array = NDArray[np.float64]


class FullRotor:
    """A spindle at one speed, the freedoms of ``selection`` node by node (bending if not given).

    Sleeves are part of the housing.
    """

    def __init__(
        self,
        spindle: Spindle,
        mesh: Mesh,
        tangents: Array,
        speed: float,
        selection: Selection = LATERAL,
    ) -> None:
        free = rotor_matrices(spindle, mesh, selection)
        self.mesh, self.selection = mesh, selection
        nodes = [mesh.node_of(s.x) for s in (*spindle.seats, *spindle.supports)]
        springs = [turn(k, s.thrust) for k, s in zip(tangents, spindle.seats, strict=True)]
        springs += [node_matrix(s.stiffness) for s in spindle.supports]
        dampers = [
            np.diag([s.axial_damping, s.radial_damping, s.radial_damping, 0, 0, 0])
            for s in spindle.seats
        ]
        dampers += [node_matrix(s.damping) for s in spindle.supports]
        self.mass = free.mass
        self.stiffness = add_at_nodes(free.stiffness, nodes, selection.take(np.array(springs)))
        self.damping = add_at_nodes(
            speed * free.gyroscopic + _modal_damping(free, spindle.rotor_damping),
            nodes,
            selection.take(np.array(dampers)),
        )

    def row(self, x: float, freedom: str) -> int:
        """Row of a freedom at station ``x`` [m]."""
        return self.selection.row(self.mesh.node_of(x), freedom)

    def poles(self, highest: float) -> NDArray[np.complex128]:
        """Oscillating poles up to ``highest`` [Hz], by imaginary part."""
        lower = cholesky(self.mass, lower=True)
        k, c = (_unit_mass(lower, matrix) for matrix in (self.stiffness, self.damping))
        size, scale = len(k), math.sqrt(np.abs(k).max())
        zero, one = np.zeros_like(k), np.eye(size)
        found = scale * eigvals(np.block([[zero, one], [-k / scale**2, -c / scale]]))
        found = found[(found.imag > 1.0) & (found.imag < 2.0 * math.pi * highest)]
        return found[np.argsort(found.imag)]

    def receptance(
        self, ends: Sequence[tuple[int, int]], frequency: Array
    ) -> NDArray[np.complex128]:
        """(pairs, frequencies) between rows (response, excitation), solved one by one."""
        columns = sorted({excitation for _, excitation in ends})
        unit = np.eye(len(self.mass))[:, columns]
        values = np.empty((len(ends), len(frequency)), dtype=complex)
        for k, omega in enumerate(2.0 * math.pi * frequency):
            dynamic = self.stiffness + 1j * omega * self.damping - omega**2 * self.mass
            answer = np.linalg.solve(dynamic, unit)
            values[:, k] = [answer[row, columns.index(column)] for row, column in ends]
        return values


def _unit_mass(lower: Array, matrix: Array) -> Array:
    """L⁻¹ A L⁻ᵀ."""
    half = solve_triangular(lower, matrix, lower=True)
    return solve_triangular(lower, half.T, lower=True).T


def _modal_damping(free: object, ratios: tuple[float, ...]) -> Array:
    """M Φ diag(2 ζ ω) Φᵀ M over the flexible free-free modes of both planes, in pairs."""
    mass, stiffness = free.mass, free.stiffness  # type: ignore[attr-defined]
    if not ratios:
        return np.zeros_like(mass)
    squares, shapes = eigh(stiffness, mass)
    order = np.arange(len(squares)) // 2 - 2
    ratio = np.where(order < 0, 0.0, np.array(ratios)[np.clip(order, 0, len(ratios) - 1)])
    weighted = mass @ shapes
    return weighted * (2.0 * ratio * np.sqrt(np.maximum(squares, 0.0))) @ weighted.T
