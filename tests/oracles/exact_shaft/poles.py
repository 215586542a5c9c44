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
ITERATIONS = 24
CLOSE = 1e-13
STALLED = 1e-10  # a change below this that no longer shrinks is rounding
STEP = 1e-5  # of ω, for the slope of the matrix
ROUNDED = 1e-6  # steps that stay below this come from rounding beside very stiff supports
BESIDE = 1e-6  # of ω, how far from a root its neighbours are looked for
NEAR = 1e-2  # of ω, how far away these are at most
NEIGHBOURS, ROUNDS = 4, 5  # most modes beside one another and one more; steps of inverse iteration


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


def reached(
    equations: Shooting, starts: Complex, vectors: Complex | None = None
) -> list[ExactMode | None]:
    """The mode reached from each of ``starts`` (k,) [rad/s], and ``vectors`` (k, size) if they are
    known; None where there is no convergence.

    Newton's method on the eigenvalue problem that is nonlinear in ω (Ruhe, SIAM J. Numer. Anal. 10
    (1973) 674): quadratic, one banded factorisation a step.
    """
    parts = equations.batches(len(starts), 3)
    given = [None if vectors is None else vectors[part] for part in parts]
    return [
        mode
        for part, x in zip(parts, given, strict=True)
        for mode in _reached(equations, starts[part], x)
    ]


def _reached(equations: Shooting, starts: Complex, x: Complex | None) -> list[ExactMode | None]:
    omega = np.array(starts, dtype=complex)
    before = np.full(len(omega), np.inf)
    late = np.zeros(len(omega))  # largest step of the later ones
    found: list[ExactMode | None] = [None] * len(omega)
    with np.errstate(invalid="ignore", over="ignore", divide="ignore"):
        x = _first(equations, omega) if x is None else x
        left = np.arange(len(omega))
        for iteration in range(ITERATIONS):
            x, change = _step(equations, omega[left], x)
            omega[left] -= change
            size = np.abs(change)
            limit = np.where(size >= 0.5 * before[left], STALLED, CLOSE) * np.abs(omega[left])
            for place in np.flatnonzero(size <= limit):
                found[left[place]] = ExactMode(complex(omega[left[place]]), x[place])
            before[left] = size
            if iteration >= ITERATIONS // 2:
                late[left] = np.maximum(late[left], size / np.abs(omega[left]))
            going = (size > limit) & np.isfinite(size)
            left, x = left[going], x[going]
            if not left.size:
                break
    for place, vector in zip(left, x, strict=True):
        if late[place] <= ROUNDED:
            found[place] = ExactMode(complex(omega[place]), vector)
    return found


def neighbours(equations: Shooting, omega: complex) -> list[ExactMode]:
    """All modes near a root, itself included, each with its own vector; more than one at the root
    where modes coincide.

    They are those of the equations linear in ω beside it, by inverse iteration of a few vectors
    together, so that frequencies are good to the square of their distance from it.
    """
    beside, step = omega * (1.0 + BESIDE), STEP * abs(omega)
    here, ahead, behind = equations.matrix(np.array([beside, beside + step, beside - step]))
    x = np.exp(1j * np.outer(np.arange(1, NEIGHBOURS + 1), np.arange(equations.size) ** 1.5)).T
    for _ in range(ROUNDS):
        x, _ = np.linalg.qr(x)
        slope = (times(ahead, x.T) - times(behind, x.T)).T / (2.0 * step)
        y = solve(here[None].copy(), slope)[0]
        x, held = y, x
    value, turn = np.linalg.eig(held.conj().T @ y)
    modes = zip(beside - 1.0 / value, _normal((held @ turn).T), strict=True)
    return [ExactMode(complex(w), v) for w, v in modes if abs(w - omega) < NEAR * abs(omega)]


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
