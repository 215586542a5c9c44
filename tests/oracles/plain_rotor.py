"""A uniform solid shaft with rigid discs, written down apart from the program.

Elements are not those of any table of matrices: v(x) is a cubic whose rotation is that of a beam
in balance, θ = v′ + (EI/κGA) v‴, and the energies are summed at Gauss points. Both planes side by
side, q = (v, θz, w, −θy) node by node; motion e^(iωt).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class PlainRotor:
    """``discs``: (node, mass, polar, diametral inertia); ``bearings``: (node, ky, kz, cy, cz)."""

    length: float
    diameter: float
    elements: int
    young_modulus: float
    shear_modulus: float
    shear_coefficient: float
    density: float
    discs: tuple[tuple[int, float, float, float], ...] = ()
    bearings: tuple[tuple[int, float, float, float, float], ...] = ()

    def matrices(self) -> tuple[Array, Array, Array, Array]:
        """(mass, gyroscopic per rad/s, damping, stiffness)."""
        size = 4 * (self.elements + 1)
        mass, gyroscopic, damping, stiffness = (np.zeros((size, size)) for _ in range(4))
        inertia, polar, elastic = self._element()
        for k in range(self.elements):
            for plane in (0, 2):
                rows = 4 * k + plane + np.array([0, 1, 4, 5])
                other = 4 * k + (2 - plane) + np.array([0, 1, 4, 5])
                mass[np.ix_(rows, rows)] += inertia
                stiffness[np.ix_(rows, rows)] += elastic
                gyroscopic[np.ix_(rows, other)] += polar if plane == 0 else -polar
        for node, body, about_axis, about_diameter in self.discs:
            here = 4 * node
            mass[range(here, here + 4), range(here, here + 4)] += [body, about_diameter] * 2
            gyroscopic[here + 1, here + 3] += about_axis
            gyroscopic[here + 3, here + 1] -= about_axis
        for node, ky, kz, cy, cz in self.bearings:
            for row, k, c in ((4 * node, ky, cy), (4 * node + 2, kz, cz)):
                stiffness[row, row] += k
                damping[row, row] += c
        return mass, gyroscopic, damping, stiffness

    def _element(self) -> tuple[Array, Array, Array]:
        """Mass, polar inertia and stiffness (4, 4) of one element in one plane."""
        h, d = self.length / self.elements, self.diameter
        area, second = math.pi * d**2 / 4.0, math.pi * d**4 / 64.0
        bending = self.young_modulus * second
        shear = self.shear_coefficient * self.shear_modulus * area
        ratio = bending / shear

        def at(x: float) -> Array:
            """Rows v, θ, θ′, γ at x of the four coefficients of the cubic."""
            return np.array(
                [
                    [1.0, x, x**2, x**3],
                    [0.0, 1.0, 2.0 * x, 3.0 * x**2 + 6.0 * ratio],
                    [0.0, 0.0, 2.0, 6.0 * x],
                    [0.0, 0.0, 0.0, -6.0 * ratio],
                ]
            )

        shapes = np.linalg.inv(np.vstack([at(0.0)[:2], at(h)[:2]]))
        points, weights = np.polynomial.legendre.leggauss(4)
        mass, polar, stiffness = (np.zeros((4, 4)) for _ in range(3))
        for x, weight in zip(0.5 * h * (points + 1.0), 0.5 * h * weights, strict=True):
            v, theta, curvature, slip = at(x) @ shapes
            turning = weight * self.density * second * np.outer(theta, theta)
            mass += weight * self.density * area * np.outer(v, v) + turning
            polar += 2.0 * turning
            stiffness += weight * bending * np.outer(curvature, curvature)
            stiffness += weight * shear * np.outer(slip, slip)
        return mass, polar, stiffness

    def unbalanced(self, node: int, unbalance: float, speed: Array) -> Complex:
        """Y and Z of every node (speeds, nodes, 2) by U [kg·m], which points to y at t = 0."""
        mass, gyroscopic, damping, stiffness = self.matrices()
        answer = np.empty((len(speed), len(mass)), dtype=complex)
        for row, spin in enumerate(speed):
            force = np.zeros(len(mass), dtype=complex)
            force[[4 * node, 4 * node + 2]] = unbalance * spin**2 * np.array([1.0, -1j])
            dynamic = stiffness + 1j * spin * (damping + spin * gyroscopic) - spin**2 * mass
            answer[row] = np.linalg.solve(dynamic, force)
        return answer.reshape(len(speed), -1, 4)[..., ::2]

    def synchronous(self) -> Array:
        """Speeds [rad/s] at which something turns with the shaft, without damping, ascending."""
        mass, gyroscopic, _, stiffness = self.matrices()
        squares = np.linalg.eigvals(np.linalg.solve(stiffness, mass - 1j * gyroscopic)).real
        return np.sort(1.0 / np.sqrt(squares[squares > 1e-12 * squares.max()]))
