"""A few vectors that carry a symmetric vibration problem: modes and static answers to forces."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
LEAST_MODES = 8


def ritz_basis(
    mass: Array, stiffness: Array, cutoff: float, loads: Array, rigid: int
) -> tuple[Array, Array]:
    """Basis Φ (n, m) with ΦᵀMΦ = 1 and ΦᵀKΦ diagonal, and that diagonal (m,), ascending.

    It spans the eigenvectors of K φ = ω² M φ up to ω = ``cutoff`` exactly, completed by the static
    answers to ``loads`` (n, l), so that forces on those freedoms meet the right flexibility. The
    ``rigid`` lowest eigenvalues are known to be zero; M must be positive definite.
    """
    from scipy.linalg import eigh, solve

    values, vectors = eigh(stiffness, mass)
    kept = max(int(np.searchsorted(values, cutoff**2)), min(LEAST_MODES, len(values)))
    low = vectors[:, :kept]
    shift = values[min(rigid, len(values) - 1)]
    answers = solve(stiffness + shift * mass, loads, assume_a="pos")
    for _ in range(2):
        answers = _orthonormal(mass, answers - low @ (low.T @ (mass @ answers)))
    basis = np.concatenate([low, answers], axis=1)
    values, turn = eigh(basis.T @ stiffness @ basis, basis.T @ mass @ basis)
    values[:rigid] = 0.0
    return basis @ turn, values


def _orthonormal(mass: Array, vectors: Array) -> Array:
    """M-orthonormal span of ``vectors`` (n, l); directions lost to rounding are dropped."""
    norms = np.sqrt(np.maximum(np.einsum("ij,ij->j", vectors, mass @ vectors), 0.0))
    vectors = vectors[:, norms > 0.0] / norms[norms > 0.0]
    values, turn = np.linalg.eigh(vectors.T @ mass @ vectors)
    keep = values > 1e-8
    return vectors @ (turn[:, keep] / np.sqrt(values[keep]))
