"""A spindle's motion without any reduction: every freedom of every node, dense matrices."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cholesky, eigh, eigvals, solve_triangular

from rotordyn.equation.elements.shear import shear_coefficient
from rotordyn.equation.mesh import Mesh
from rotordyn.equation.seat import turn
from rotordyn.equation.support import node_matrix
from rotordyn.machine.cross_section import area, second_moment
from rotordyn.machine.spindle import Spindle
from tests.oracles.beam_column import axial_force_stiffness
from tests.oracles.dense_rotor.assemble import add_at_nodes, rotor_matrices
from tests.oracles.dense_rotor.selection import LATERAL, Selection
from tests.oracles.standard_beam import shear_parameter

Array = NDArray[np.float64]


class FullRotor:
    """A spindle at one speed, the DOF of ``selection`` node by node (bending if not given).

    Sleeves are part of the housing. ``axial_force`` (elements,) [N]: in the shaft, tension
    positive, where the DOF are those of bending.
    """

    def __init__(
        self,
        spindle: Spindle,
        mesh: Mesh,
        tangents: Array,
        speed: float,
        selection: Selection = LATERAL,
        axial_force: Array | None = None,
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
        if axial_force is not None:
            self._stiffen(spindle, axial_force)
        self.damping = add_at_nodes(
            speed * free.gyroscopic + _modal_damping(free, spindle.rotor_damping),
            nodes,
            selection.take(np.array(dampers)),
        )

    def _stiffen(self, spindle: Spindle, axial_force: Array) -> None:
        """Add K_geo element by element in both planes, and the drawbar between its contacts."""
        mesh, ring = self.mesh, (self.mesh.outer[0], self.mesh.inner[0])
        ratio = mesh.inner[0] / mesh.outer[0]
        kappa = shear_coefficient(spindle.shaft.shear_coefficient, mesh.poisson_ratio, ratio)
        bending = mesh.young_modulus * second_moment(*ring)
        phi = shear_parameter(mesh.length, bending, kappa * mesh.shear_modulus * area(*ring))
        for k, block in enumerate(axial_force_stiffness(mesh.length, phi, axial_force)):
            for plane in (("y", "thz"), ("z", "thy")):
                rows = [self.selection.row(n, f) for n in (k, k + 1) for f in plane]
                signs = np.array([1.0, 1.0 if plane[0] == "y" else -1.0] * 2)
                self.stiffness[np.ix_(rows, rows)] += block * np.outer(signs, signs)
        bar = spindle.drawbar
        for a, b in pairwise(bar.contacts if bar else ()):
            for freedom in ("y", "z"):
                rows = [self.row(a, freedom), self.row(b, freedom)]
                string = bar.force / (b - a) * np.array([[1.0, -1.0], [-1.0, 1.0]])
                self.stiffness[np.ix_(rows, rows)] += string

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
