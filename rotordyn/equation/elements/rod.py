"""Rod of any polynomial degree (axial motion or torsion): the linear rod is degree 1.

DOF: those of the nodes, then the amplitudes of ψ_2 … ψ_n, which stand alone in stiffness;
frequencies err as h^(2n).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.equation.elements.polynomials import bubbles, points

Array = NDArray[np.float64]

_STIFFNESS = np.array([[1.0, -1.0], [-1.0, 1.0]])
_MASS = np.array([[2.0, 1.0], [1.0, 2.0]]) / 6.0


@dataclass(frozen=True, eq=False, slots=True)
class Rod:
    """Matrices of shape (…, 2, 2)."""

    mass: Array
    stiffness: Array


def rod(length: Array, rigidity: Array, line_inertia: Array) -> Rod:
    """Consistent matrices of rods, leading dimensions broadcast.

    ``length`` [m]; ``rigidity`` E A [N] or G Ip [N·m²]; ``line_inertia`` ρ A [kg/m] or ρ Ip [kg·m].
    """
    mass = _spread(line_inertia * length) * _MASS
    return Rod(mass=mass, stiffness=_spread(rigidity / length) * _STIFFNESS)


def _spread(values: Array) -> Array:
    return np.asarray(values)[..., None, None]


def inner_dofs(degree: int) -> int:
    """DOF between the nodes of a rod of ``degree`` n ≥ 1."""
    return degree - 1


def hierarchic_rod(length: Array, rigidity: Array, line_inertia: Array, *, degree: int) -> Rod:
    """Matrices (elements, degree + 1, degree + 1) of rods, all of one ``degree``.

    ``length`` (elements,) [m]; ``rigidity`` E A [N] or G Ip [N·m²]; ``line_inertia`` ρ A [kg/m] or
    ρ Ip [kg·m].
    """
    core = rod(length, rigidity, line_inertia)
    if degree < 2:
        return core
    xi, weight = points(2 * degree + 2)
    shape = shapes(degree, xi)
    unit = shape.T @ (weight[:, None] / 2.0 * shape)
    mass = (line_inertia * length)[:, None, None] * unit
    mass[:, :2, :2] = core.mass
    stiffness = np.zeros_like(mass)
    stiffness[:, :2, :2] = core.stiffness
    inner = np.arange(2, degree + 1)
    stiffness[:, inner, inner] = (2.0 * rigidity / length)[:, None]
    return Rod(mass=mass, stiffness=stiffness)


def tapered_points(degree: int) -> tuple[Array, Array]:
    """Gauss points on [−1, 1] and weights, exact for a conical rod."""
    return points(2 * degree + 4)


def tapered_rod(
    length: Array, rigidity: Array, line_inertia: Array, *, degree: int, xi: Array, weight: Array
) -> Rod:
    """The same of rods that change along the axis: ``rigidity`` and ``line_inertia`` (elements,
    points) at the points ``xi`` of a quadrature."""
    shape, half = shapes(degree, xi), length[:, None] / 2.0
    rise = np.stack([-0.5 + 0.0 * xi, 0.5 + 0.0 * xi], axis=-1)
    if degree > 1:
        rise = np.concatenate([rise, bubbles(degree, xi)[2]], axis=-1)
    mass, stiffness = (line_inertia * weight * half), (rigidity * weight / half)
    return Rod(
        mass=np.einsum("ep,pi,pj->eij", mass, shape, shape, optimize=True),
        stiffness=np.einsum("ep,pi,pj->eij", stiffness, rise, rise, optimize=True),
    )


def shapes(degree: int, xi: Array) -> Array:
    """Shape functions at ``xi`` (…) on [−1, 1], (…, degree + 1)."""
    linear = np.stack([(1.0 - xi) / 2.0, (1.0 + xi) / 2.0], axis=-1)
    return linear if degree < 2 else np.concatenate([linear, bubbles(degree, xi)[1]], axis=-1)
