"""Products of real matrices with complex vectors, at the price of real ones."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Matrix


def times(matrix: Matrix, vector: Matrix) -> Matrix:
    """Return ``matrix`` (…, m, n) @ ``vector`` (…, n, k), real if the values of both are."""
    if np.iscomplexobj(matrix) or not np.iscomplexobj(vector):
        return np.asarray(matrix @ vector)
    real = matrix @ np.ascontiguousarray(vector.real)
    if not vector.imag.any():
        return np.asarray(real)
    return np.asarray(real + 1j * (matrix @ np.ascontiguousarray(vector.imag)))
