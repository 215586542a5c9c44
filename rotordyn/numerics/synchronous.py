"""Whirl at a multiple of the spin, integer or not, solved for at once.

Where M does not depend on the spin Ω and K = K₀ + Ω K₁ is at most linear in it, undamped whirl ω =
±nΩ of K + ωΩP − ω² M is an eigenproblem of Ω, K₀ φ + Ω K₁ φ = (nΩ)² (M ∓ P/n) φ: every root at
once, without a search for crossings.
"""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array, Complex, Matrix

REAL = 1e-6  # of Ω²: less imaginary part is rounding or a slight asymmetry


def synchronous(
    stiffness: Matrix, gyroscopic: Matrix, order: float, slope: Matrix | None = None
) -> tuple[Array, Complex]:
    """Return spins Ω > 0 (k,), ascending, and vectors (n, k) of q̈ + Ω G q̇ + (K₀ + Ω K₁) q = 0
    with e^(i n Ω t).

    Of unit mass: (K₀ + Ω K₁) φ = (nΩ)² (1 − i G/n) φ. ``stiffness`` K₀, ``gyroscopic`` G and
    ``slope`` K₁ (n, n), which is zero if not given; G is −iP in the complex form, where backward
    whirl, e^(−i n Ω t), follows from the conjugate G.
    """
    from scipy.linalg import eig

    size = len(stiffness)
    inertia = np.eye(size) - 1j * gyroscopic / order
    if slope is None or not slope.any():
        squares, vectors = _finite(*eig(stiffness, inertia))
        squares = squares / order**2
    else:
        eye, zero = np.eye(size), np.zeros((size, size))
        scale = np.sqrt(np.abs(stiffness).max()) / order
        a = np.block([[zero, eye], [stiffness / scale**2, slope / scale]])
        spins, vectors = _finite(*eig(a, np.block([[eye, zero], [zero, order**2 * inertia]])))
        spins, vectors = scale * spins[spins.real > 0.0], vectors[:size, spins.real > 0.0]
        squares = spins**2
    with np.errstate(invalid="ignore"):
        real = np.isfinite(squares) & (squares.real > 0.0)
        real &= np.abs(squares.imag) <= REAL * np.abs(squares)
    spin = np.sqrt(squares[real].real)
    ascending = np.argsort(spin)
    return spin[ascending], vectors[:, real][:, ascending]


def _finite(values: Complex, vectors: Complex) -> tuple[Complex, Complex]:
    """Return pairs with inertia: a thin disc, Jp = 2 Jd, tilting at twice its speed has none."""
    finite = np.isfinite(values)
    return values[finite], vectors[:, finite]
