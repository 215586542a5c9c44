"""Motions that turn at a multiple of the spin, whole or not, solved for at once.

Where K and M do not depend on the spin Ω, undamped whirl ω = ±nΩ of K + ωΩP − ω² M is an ordinary
eigenproblem, K φ = ω² (M ∓ P/n) φ: every root at once, no crossing to be looked for.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Matrix = NDArray[np.inexact[Any]]
REAL = 1e-6  # of ω²: less imaginary part than that is rounding or a slight asymmetry


def synchronous(stiffness: Matrix, gyroscopic: Matrix, order: float) -> tuple[Array, Complex]:
    """Spins Ω > 0 (k,), ascending, and vectors (n, k) of q̈ + Ω G q̇ + K q = 0 with e^(i n Ω t).

    Of unit mass: K φ = (nΩ)² (1 − i G/n) φ. ``gyroscopic`` G (n, n); −iP in the complex form, where
    e^(−i n Ω t), backward, is found by the conjugate G.
    """
    from scipy.linalg import eig

    mass = np.eye(len(stiffness)) - 1j * gyroscopic / order
    squares, vectors = eig(stiffness, mass)
    with np.errstate(invalid="ignore"):
        turning = np.isfinite(squares) & (squares.real > 0.0)
        turning &= np.abs(squares.imag) <= REAL * np.abs(squares)
    spin = np.sqrt(squares[turning].real) / order
    ascending = np.argsort(spin)
    return spin[ascending], vectors[:, turning][:, ascending]
