"""Exact eigenvalues of a rotor, from starts that need not be very close."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import NoSolution
from tests.oracles.exact_shaft.banded import solve, times
from tests.oracles.exact_shaft.rotor import ExactRotor
from tests.oracles.exact_shaft.shooting import Shooting

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
ITERATIONS = 40
CLOSE = 1e-13
STALLED = 1e-10  # a change below this that no longer shrinks is rounding
STEP = 1e-5  # of ω, for the slope of the matrix
BESIDE = 1e-10  # of ω, how far from a root its vectors are found
DEPENDENT = 1e-2  # singular values below this share of the largest are those of other roots
RIGHT_SIDES = 4  # most modes that may share a root, and one more


@dataclass(frozen=True, eq=False, slots=True)
class ExactMode:
    """Whirl frequency ω [rad/s], complex (the pole is iω), and the unknowns of the equations."""

    omega: complex
    unknowns: Complex


def exact_mode(rotor: ExactRotor, start: complex) -> ExactMode:
    """The mode that inverse iteration reaches from ``start`` [rad/s].

    Raises
    ------
    NoSolution : no convergence
    """
    found = reached(Shooting.of(rotor), np.array([complex(start)]))[0]
    if found is None:
        raise NoSolution(f"no exact mode was reached from {start:.6g} rad/s: start closer to one")
    return found


def reached(equations: Shooting, starts: Complex) -> list[ExactMode | None]:
    """The mode reached from each of ``starts`` (k,) [rad/s]; None where there is no convergence.

    Newton's method on the eigenvalue problem that is nonlinear in ω (Ruhe, SIAM J. Numer. Anal. 10
    (1973) 674): quadratic, one banded factorisation a step.
    """
    parts = equations.batches(len(starts), 3)
    return [mode for part in parts for mode in _reached(equations, starts[part])]


def _reached(equations: Shooting, starts: Complex) -> list[ExactMode | None]:
    omega = np.array(starts, dtype=complex)
    before = np.full(len(omega), np.inf)
    found: list[ExactMode | None] = [None] * len(omega)
    with np.errstate(invalid="ignore", over="ignore", divide="ignore"):
        x = _first(equations, omega)
        left = np.arange(len(omega))
        for _ in range(ITERATIONS):
            x, change = _step(equations, omega[left], x)
            omega[left] -= change
            size = np.abs(change)
            limit = np.where(size >= 0.5 * before[left], STALLED, CLOSE) * np.abs(omega[left])
            for place in np.flatnonzero(size <= limit):
                found[left[place]] = ExactMode(complex(omega[left[place]]), x[place])
            before[left] = size
            going = (size > limit) & np.isfinite(size)
            left, x = left[going], x[going]
            if not left.size:
                break
    return found


def null_space(equations: Shooting, omega: complex) -> list[Complex]:
    """Vectors (size,) of all modes at a root, more than one where modes coincide."""
    from scipy.linalg import svd

    right = np.exp(1j * np.outer(np.arange(1, RIGHT_SIDES + 1), np.arange(equations.size) ** 1.5)).T
    beside = np.array([omega * (1.0 + BESIDE)])
    answers = solve(equations.matrix(beside), right)[0]
    left, values, _ = svd(answers / np.abs(answers).max(), full_matrices=False)
    return [np.asarray(left[:, k]) for k in np.flatnonzero(values > DEPENDENT * values[0])]


def _first(equations: Shooting, omega: Complex) -> Complex:
    """Two steps of inverse iteration from a fixed vector without symmetry (k, size)."""
    x = np.exp(1j * np.arange(equations.size) ** 1.5)[None].repeat(len(omega), axis=0)
    for _ in range(2):
        x = _normal(solve(equations.matrix(omega * (1.0 + 1e-10)), x[..., None])[..., 0])
    return x


def _step(equations: Shooting, omega: Complex, x: Complex) -> tuple[Complex, Complex]:
    """Next vectors (k, size), and by how much each ω was too large.

    The slope of the matrix is taken by central differences: its accuracy sets the pace, not the
    result.
    """
    step = STEP * np.abs(omega)
    here, ahead, behind = np.split(
        equations.matrix(np.concatenate([omega, omega + step, omega - step])), 3
    )
    slope = times(ahead, x) - times(behind, x)
    y = solve(here, (slope / (2.0 * step[:, None]))[..., None])[..., 0]
    change = np.einsum("kn,kn->k", x.conj(), x) / np.einsum("kn,kn->k", x.conj(), y)
    return _normal(y), change


def _normal(x: Complex) -> Complex:
    return np.asarray(x / np.linalg.norm(x, axis=1, keepdims=True))
