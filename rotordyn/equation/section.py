"""Rigidities and inertias of the section of a shaft, anywhere along its elements."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array
from rotordyn.equation.elements.shear import RIGID, shear_coefficient
from rotordyn.equation.mesh import Mesh
from rotordyn.machine.cross_section import area, second_moment
from rotordyn.machine.spindle import Spindle

MIDDLE, ENDS = np.array([0.0]), np.array([-1.0, 0.0, 1.0])  # ξ of the middle; with the ends


def sheared(spindle: Spindle) -> bool:
    """True if the shaft deforms in shear."""
    return spindle.shaft.shear_coefficient != RIGID


def sections_at(spindle: Spindle, mesh: Mesh, xi: Array) -> tuple[Array, Array, Array, Array]:
    """Return κGA [N], EI [N·m²], ρA [kg/m], ρI [kg·m] at ``xi`` on [−1, 1], (elements, places)."""
    outer, inner = mesh.diameters(xi)
    ring, moment = area(outer, inner), second_moment(outer, inner)
    young, density = mesh.young_modulus[:, None], mesh.density[:, None]
    kappa = shear_coefficient(
        spindle.shaft.shear_coefficient, mesh.poisson_ratio[:, None], inner / outer
    )
    shear = kappa * mesh.shear_modulus[:, None] * ring
    return shear, young * moment, density * ring, density * moment


def axial(mesh: Mesh, xi: Array) -> tuple[Array, Array]:
    """Return E A [N] and ρ A [kg/m] at ``xi`` on [−1, 1], (elements, places)."""
    ring = area(*mesh.diameters(xi))
    return mesh.young_modulus[:, None] * ring, mesh.density[:, None] * ring


def torsion(mesh: Mesh, xi: Array) -> tuple[Array, Array]:
    """Return G Ip [N·m²] and ρ Ip [kg·m] at ``xi`` on [−1, 1], (elements, places)."""
    polar = 2.0 * second_moment(*mesh.diameters(xi))
    return mesh.shear_modulus[:, None] * polar, mesh.density[:, None] * polar
