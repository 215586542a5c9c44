"""Fixed points x = f(x) of many affine functions at once, by GMRES (Saad and Schultz 1986).

Theory: docs/theory/statics.md.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rotordyn.arrays import Array, Flags

MOST = 60  # steps
WITHIN = 1e-13  # of f(0): residual at which the iteration ends
LARGEST = 1e-7  # of f(0): largest residual of a solution


def fixed_points(function: Callable[[Array], Array], size: int, states: int) -> tuple[Array, Flags]:
    """Return x = f(x) (states, size) of an affine ``function`` of (states, size), each state by
    itself, and where it is one (states,). One that changes few directions takes few steps."""
    at_zero = function(np.zeros((states, size)))
    if not np.isfinite(at_zero).all():
        return at_zero, np.zeros(states, dtype=bool)
    norm = np.linalg.norm(at_zero, axis=1)
    scale = np.where(norm > 0.0, norm, 1.0)[:, None]
    basis = [at_zero / scale]
    columns = np.zeros((states, MOST + 1, MOST))
    right = np.zeros((states, MOST + 1))
    right[:, 0] = 1.0
    for k in range(min(MOST, size)):
        new = basis[k] - (function(basis[k]) - at_zero)
        for _ in range(2):  # twice: rounding leaves one pass not orthogonal
            for j, vector in enumerate(basis):
                share = (vector * new).sum(axis=1)
                columns[:, j, k] += share
                new = new - share[:, None] * vector
        length = np.linalg.norm(new, axis=1)
        columns[:, k + 1, k] = length
        basis.append(new / np.where(length > 0.0, length, 1.0)[:, None])
        matrix = columns[:, : k + 2, : k + 1]
        weights = (np.linalg.pinv(matrix) @ right[:, : k + 2, None])[..., 0]
        residual = right[:, : k + 2] - (matrix @ weights[..., None])[..., 0]
        if np.abs(residual[norm > 0.0]).max(initial=0.0) <= WITHIN:
            break
    point: Array = np.einsum("ksn,sk->sn", np.array(basis[:-1]), weights) * scale
    return point, np.linalg.norm(function(point) - point, axis=1) <= LARGEST * norm
