"""Plain dense eigenvalue problems with which tests judge the assembled matrices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag, eig, eigh

Array = NDArray[np.float64]


def frequencies_at_rest(mass: Array, stiffness: Array) -> Array:
    """Ascending [rad/s]; numerically negative squares count as zero."""
    squares = eigh(stiffness, mass, eigvals_only=True)
    return np.sqrt(np.maximum(squares, 0.0))


def whirl_frequencies(mass: Array, polar: Array, stiffness: Array, spin: float) -> Array:
    """Signed frequencies of (K + ωΩ Jp − ω² M) φ = 0 by modulus; K positive definite."""
    zero = np.zeros_like(mass)
    inverse = eigh(
        np.block([[-spin * polar, mass], [mass, zero]]),
        block_diag(stiffness, mass),
        eigvals_only=True,
    )
    return by_modulus(1.0 / inverse)


def eigenvalues(mass: Array, damping: Array, stiffness: Array) -> NDArray[np.complex128]:
    """λ of (λ² M + λ C + K) q = 0, only those with a positive imaginary part, by that part."""
    values = state_space(mass, damping, stiffness)[0]
    values = values[values.imag > 0]
    return values[np.argsort(values.imag)]


def state_space(
    mass: Array, damping: Array, stiffness: Array
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Eigenvalues and displacement vectors of the damped system."""
    size = len(mass)
    zero, one = np.zeros((size, size)), np.eye(size)
    values, vectors = eig(np.block([[zero, one], [-stiffness, -damping]]), block_diag(one, mass))
    return values, vectors[:size]


def by_modulus(values: Array) -> Array:
    return values[np.argsort(np.abs(values))]
