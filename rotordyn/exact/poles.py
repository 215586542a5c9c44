"""Exact eigenvalues of a rotor, from starts that need not be very close."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import NoSolution
from rotordyn.exact.rotor import ExactRotor
from rotordyn.exact.shooting import Shooting

Complex = NDArray[np.complex128]
ITERATIONS = 40
CLOSE = 1e-13
STEP = 1e-5  # of ω, for the slope of the matrix


@dataclass(frozen=True, eq=False, slots=True)
class ExactMode:
    """Whirl frequency ω [rad/s], complex (the pole is iω), and shape (nodes, w)."""

    omega: complex
    shape: Complex


def exact_mode(rotor: ExactRotor, start: complex) -> ExactMode:
    """The mode that inverse iteration reaches from ``start`` [rad/s].

    Newton's method on the eigenvalue problem that is nonlinear in ω (Ruhe, SIAM J. Numer. Anal. 10
    (1973) 674): quadratic, one banded factorisation a step.

    Raises
    ------
    NoSolution : no convergence
    """
    equations = Shooting.of(rotor)
    omega = complex(start)
    x = _first(equations, omega)
    for _ in range(ITERATIONS):
        y = _solve(equations, omega, _slope(equations, omega, x))
        change = np.vdot(x, x) / np.vdot(x, y)
        x, omega = y / np.linalg.norm(y), complex(omega - change)
        if abs(change) <= CLOSE * abs(omega):
            return ExactMode(omega, equations.displacement(x, omega))
    raise NoSolution(f"no exact mode was reached from {start:.6g} rad/s: start closer to one")


def _first(equations: Shooting, omega: complex) -> Complex:
    """Two steps of inverse iteration from a fixed vector without symmetry."""
    x = np.exp(1j * np.arange(equations.size) ** 1.5)
    for _ in range(2):
        x = _solve(equations, omega * (1.0 + 1e-10), x)
        x = x / np.linalg.norm(x)
    return np.asarray(x)


def _slope(equations: Shooting, omega: complex, x: Complex) -> Complex:
    """(dA/dω) x by central differences: its accuracy sets the pace, not the result."""
    step = STEP * abs(omega)
    ahead, behind = (equations.matrix(omega + s) for s in (step, -step))
    return _times((ahead - behind) / (2.0 * step), x)


def _times(banded: Complex, x: Complex) -> Complex:
    half = (len(banded) - 1) // 2
    size = len(x)
    product = np.zeros(size, dtype=complex)
    for k in range(2 * half + 1):
        shift = k - half  # row minus column
        columns = slice(max(0, -shift), min(size, size - shift))
        rows = slice(columns.start + shift, columns.stop + shift)
        product[rows] += banded[k, columns] * x[columns]
    return product


def _solve(equations: Shooting, omega: complex, right: Complex) -> Complex:
    from scipy.linalg import solve_banded

    band = equations.half_band
    return np.asarray(
        solve_banded((band, band), equations.matrix(omega), right, check_finite=False)
    )
