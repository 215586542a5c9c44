"""Geometric stiffness of the standard beam element with shear, in closed form."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def axial_force_stiffness(length: Array, phi: Array, force: Array) -> Array:
    """N ∫ v′² dx of DOF (v, θ, v, θ), shape (…, 4, 4), tension positive.

    Przemieniecki, *Theory of Matrix Structural Analysis*, with the shear parameter Φ.
    """
    length, phi, force = np.broadcast_arrays(length, phi, force)
    a, b = 36.0 + 60.0 * phi + 30.0 * phi**2, 3.0 * length
    c, d = (
        (4.0 + 5.0 * phi + 2.5 * phi**2) * length**2,
        (1.0 + 5.0 * phi + 2.5 * phi**2) * length**2,
    )
    rows = [[a, b, -a, b], [b, c, -b, -d], [-a, -b, a, -b], [b, -d, -b, c]]
    table = np.moveaxis(np.array(rows), (0, 1), (-2, -1))
    scale = force / (30.0 * length * (1.0 + phi) ** 2)
    return np.asarray(scale[..., None, None] * table)
