"""Rod of any polynomial degree (axial motion or torsion): the linear rod is degree 1.

DOF: those of the nodes, then the amplitudes of ψ_2 … ψ_n, which are uncoupled in the stiffness of a
cylinder; frequencies err as h^(2n).
"""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array
from rotordyn.equation.elements.polynomials import bubbles, points


def quadrature(degree: int) -> tuple[Array, Array]:
    """Return Gauss points on [−1, 1] and weights, exact for a conical rod."""
    return points(2 * degree + 4)


def rod_matrices(
    length: Array, rigidity: Array, line_inertia: Array, *, degree: int
) -> tuple[Array, Array]:
    """Return mass and stiffness (elements, degree + 1, degree + 1) of rods of a ``length``
    (elements,) [m], all of one ``degree``.

    ``rigidity`` E A [N] or G Ip [N·m²] and ``line_inertia`` ρ A [kg/m] or ρ Ip [kg·m]
    (elements, points) at the points of ``quadrature``.
    """
    xi, weight = quadrature(degree)
    shape, half = shapes(degree, xi), length[:, None] / 2.0
    derivative = np.stack([-0.5 + 0.0 * xi, 0.5 + 0.0 * xi], axis=-1)
    if degree > 1:
        derivative = np.concatenate([derivative, bubbles(degree, xi)[2]], axis=-1)
    mass, stiffness = (line_inertia * weight * half), (rigidity * weight / half)
    return shape.T @ (mass[..., None] * shape), derivative.T @ (stiffness[..., None] * derivative)


def shapes(degree: int, xi: Array) -> Array:
    """Return shape functions at ``xi`` (…) on [−1, 1], (…, degree + 1)."""
    linear = np.stack([(1.0 - xi) / 2.0, (1.0 + xi) / 2.0], axis=-1)
    return linear if degree < 2 else np.concatenate([linear, bubbles(degree, xi)[1]], axis=-1)
