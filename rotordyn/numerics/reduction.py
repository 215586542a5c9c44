"""A few vectors that carry a symmetric vibration problem: modes and static answers to forces."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
LEAST_MODES = 8
NEW = 1e-5  # of its length: a vector that adds less to the others is spanned by them


def ritz_basis(
    mass: Array,
    stiffness: Array,
    cutoff: float,
    loads: Array,
    rigid: int,
    couplings: Sequence[Array] = (),
) -> tuple[Array, Array]:
    """Basis Φ (n, m) with ΦᵀMΦ = 1 and ΦᵀKΦ diagonal, and that diagonal (m,), ascending.

    It spans the eigenvectors of K φ = ω² M φ up to ω = ``cutoff`` exactly, completed by the static
    answers to ``loads`` (n, l), so that forces on those freedoms meet the right flexibility, and to
    the forces that each of ``couplings`` (n, n), such as the gyroscopic matrix, makes of the lowest
    modes.
    The ``rigid`` lowest eigenvalues are known to be zero; M must be positive definite.
    """
    from scipy.linalg import eigh, solve

    values, vectors = eigh(stiffness, mass)
    kept = max(int(np.searchsorted(values, cutoff**2)), min(LEAST_MODES, len(values)))
    low = vectors[:, :kept]
    shift = values[min(rigid, len(values) - 1)]
    loads = np.concatenate([loads, *(c @ low[:, :LEAST_MODES] for c in couplings)], axis=1)
    answers = _completed(mass, low, solve(stiffness + shift * mass, loads, assume_a="pos"))
    basis = np.concatenate([low, answers], axis=1)
    values, turn = eigh(basis.T @ stiffness @ basis, basis.T @ mass @ basis)
    values[:rigid] = 0.0
    return basis @ turn, values


def _completed(mass: Array, low: Array, answers: Array) -> Array:
    """M-orthonormal span of what ``answers`` (n, l) add to ``low``; what is rounding is dropped."""
    answers = answers / _norms(mass, answers)
    for _ in range(2):
        answers = answers - low @ (low.T @ (mass @ answers))
        size = _norms(mass, answers)
        answers = answers[:, size > NEW] / size[size > NEW]  # small ones may still differ much
        values, turn = np.linalg.eigh(answers.T @ mass @ answers)
        keep = values > NEW**2
        answers = answers @ (turn[:, keep] / np.sqrt(values[keep]))
    return answers


def _norms(mass: Array, vectors: Array) -> Array:
    return np.sqrt(np.maximum(np.einsum("ij,ij->j", vectors, mass @ vectors), 0.0))
