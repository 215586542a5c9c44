"""Timoshenko beam of any polynomial degree in one plane, with the standard element as its core.

DOF: (v1, φ1, v2, φ2) of the nodes, then between them, for degree n ≥ 2,

- n of shear: v = ψ_2 … ψ_(n+1), φ = 0;
- one of constant shear: φ = ψ_2 and the v whose slope differs from it by a constant;
- n − 2 of bending without shear: φ = ψ_3 … ψ_n and v = ∫φ dx.

Together v has degree n + 1 and φ = v′ degree n: nothing locks at any slenderness, and frequencies
err as h^(2n). In the energy of deformation all inner DOF are uncoupled, which keeps slender
elements well conditioned. A beam rigid in shear (Φ = 0) has no DOF of shear. In a cone the
shapes are those of the section in its middle, and all energies are integrated at Gauss points.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rotordyn.arrays import Array, Indices
from rotordyn.equation.elements.polynomials import bubbles, points

_CONSTANT = 1.0 / 6.0**0.5  # shear angle of the DOF of constant shear: −½ ∫ψ_2 dξ


@dataclass(frozen=True, eq=False, slots=True)
class PlaneBending:
    """Matrices (elements, k, k), k = 4 + ``inner_dofs(degree)``, real and symmetric.

    ``mass`` = ``translational_mass`` + rotary mass; ``polar`` Jp ≥ 0 couples the two planes by
    ω Ω Jp in (K + ω Ω Jp − ω² M) φ = 0. Both planes of a shaft have these matrices: φ = θz in the
    x–y plane, φ = −θy in the x–z plane.
    """

    mass: Array
    translational_mass: Array
    polar: Array
    stiffness: Array


def inner_dofs(degree: Indices, sheared: bool = True) -> Indices:
    """Return the number of inner DOF of elements of ``degree`` n ≥ 1 (1: the standard element)."""
    return np.where(degree < 2, 0, 2 * degree - 1 if sheared else degree - 2)


def quadrature(degree: int) -> tuple[Array, Array]:
    """Return Gauss points on [−1, 1] and weights, exact for a cone but its shear coefficient."""
    return points(max(2 * degree, 4) + 10)


def shear_parameter(length: Array, bending_rigidity: Array, shear_rigidity: Array) -> Array:
    """Return Φ = 12 E I / (κ G A L²) [1]: 0 for a slender element, large for a stubby one."""
    return 12.0 * bending_rigidity / (shear_rigidity * length**2)


def beam_matrices(
    length: Array,
    phi: Array,
    shear: Array,
    bending: Array,
    line_mass: Array,
    rotary: Array,
    *,
    degree: int,
) -> PlaneBending:
    """Return the matrices of elements of a ``length`` (elements,) [m], all of one ``degree``.

    ``phi`` (elements,): Φ of their shapes. κGA [N], EI [N·m²], ρA [kg/m] and ρI [kg·m]
    (elements, points) at the points of ``quadrature``.
    """
    xi, weight = quadrature(degree)
    shape, dx = shapes(length, phi, degree, xi), weight * length[:, None] / 2.0
    translational = _product(shape.deflection, line_mass, dx)
    rotation = _product(shape.rotation, rotary, dx)
    stiffness = _product(shape.curvature, bending, dx)
    if phi.any():
        stiffness = stiffness + _product(shape.shear, shear, dx)
    return PlaneBending(
        mass=translational + rotation,
        translational_mass=translational,
        polar=2.0 * rotation,
        stiffness=stiffness,
    )


@dataclass(frozen=True, eq=False, slots=True)
class Shapes:
    """Shape functions of all DOF, each (elements, points, DOF); ``shear``: v′ − φ."""

    deflection: Array
    slope: Array
    rotation: Array
    curvature: Array
    shear: Array


def shapes(length: Array, phi: Array, degree: int, xi: Array) -> Shapes:
    """Return v, v′, φ and φ′ at ``xi`` on [−1, 1]; ``phi`` Φ = 12 EI/(κGA L²), (elements,): zeros
    of beams rigid in shear.

    ``xi``: (points,) the same of all elements, or (elements, points).
    """
    nodal = _nodal(length, phi, xi)
    if degree < 2:
        return Shapes(*nodal)
    inner = _inner(length, degree, xi)
    if not phi.any():
        inner = [values[..., degree + 1 :] for values in inner]
    return Shapes(*(np.concatenate(pair, axis=-1) for pair in zip(nodal, inner, strict=True)))


def _inner(length: Array, degree: int, xi: Array) -> list[Array]:
    """Return v, v′, φ, φ′, v′ − φ of the inner DOF."""
    half = length[:, None, None] / 2.0
    integral, psi, derivative = bubbles(degree + 1, xi)
    zero = np.zeros((*xi.shape, degree))
    level = integral[..., :1] + _CONSTANT * (xi[..., None] + 1.0)  # vanishes at both ends
    bent = np.concatenate([level, integral[..., 1:-1]], axis=-1)
    slope = np.concatenate([psi[..., :1] + _CONSTANT, psi[..., 1:-1]], axis=-1)
    unit = np.ones_like(half)
    sheared = np.where(np.arange(degree - 1) == 0, _CONSTANT, 0.0) * np.ones_like(xi)[..., None]
    return [
        np.concatenate([psi * unit, half * bent], axis=-1),
        np.concatenate([derivative / half, slope * unit], axis=-1),
        np.concatenate([zero, psi[..., :-1]], axis=-1) * unit,
        np.concatenate([zero, derivative[..., :-1]], axis=-1) / half,
        np.concatenate([derivative / half, sheared * unit], axis=-1),
    ]


def _nodal(length: Array, phi: Array, xi: Array) -> list[Array]:
    """Return v, v′, φ, φ′, v′ − φ of exact static responses to unit displacements of the nodes: of
    constant shear force.

    Cubics in the position s from 0 to 1: those without shear and Φ times others, over 1 + Φ.
    """
    s = (xi + 1.0) / 2.0 * np.ones((len(length), 1))
    h, f = length[:, None, None], phi[:, None, None]
    unit = np.ones_like(s)
    powers = np.stack([unit, s, s * s, s * s * s], axis=-1)
    slopes = np.stack([0.0 * unit, unit, 2.0 * s, 3.0 * s * s], axis=-1) / h
    lever = np.where(_TILTS, h, 1.0)
    v = (_DEFLECTION + f * _DEFLECTION_SHEAR) / (1.0 + f) * lever
    tilt = (_ROTATION + f * _ROTATION_SHEAR) / (1.0 + f) * lever / h
    shear = f / (1.0 + f) * np.where(_TILTS, -0.5, np.array([-1.0, 0.0, 1.0, 0.0]) / h)
    return [powers @ v, slopes @ v, powers @ tilt, slopes @ tilt, shear * unit[..., None]]


# Coefficients of 1, s, s², s³ (rows) in the responses to (v1, φ1, v2, φ2).
_TILTS = np.array([False, True, False, True])
_DEFLECTION = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [-3, -2, 3, -1], [2, 1, -2, 1]], dtype=float)
_DEFLECTION_SHEAR = np.array([[1, 0, 0, 0], [-1, 0.5, 1, -0.5], [0, -0.5, 0, 0.5], [0, 0, 0, 0]])
_ROTATION = np.array([[0, 1, 0, 0], [-6, -4, 6, -2], [6, 3, -6, 3], [0, 0, 0, 0]], dtype=float)
_ROTATION_SHEAR = np.array([[0, 1, 0, 0], [0, -1, 0, 1], [0, 0, 0, 0], [0, 0, 0, 0]], dtype=float)


def _product(shape: Array, factor: Array, dx: Array) -> Array:
    """Return ∫ factor · shapeᵀ shape dx of every element (elements, DOF, DOF); ``factor``
    (elements, points or 1)."""
    weighted = shape * (factor * dx)[..., None]
    return np.asarray(np.swapaxes(weighted, -1, -2) @ shape)
