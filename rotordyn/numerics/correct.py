"""Single eigenpairs of q̈ + D q̇ + K q = 0 from approximate ones, by Newton's method."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Complex, Flags, Matrix

STEPS = 10  # at most
MET = 1e-12  # of a pole: a smaller step is rounding
BESIDE = 1e-9  # of a pole: shift for inverse iteration
ASIDE = 1e-14  # of a pole: shift, as P at the pole may be singular and fail the whole batch


def corrected(
    stiffness: Matrix, damping: Matrix, pole: Complex, vector: Complex
) -> tuple[Complex, Complex, Flags]:
    """Return poles (k,), vectors (k, n) of unit length, and which of them converged (k,).

    ``stiffness`` and ``damping`` (k, n, n), ``pole`` (k,), ``vector`` (k, n): a start for each.
    With P(λ) = λ² + λ D + K, x = P⁻¹ P′ v gives the next vector and λ − vᴴv/vᴴx the next pole
    (Ruhe, SIAM J. Numer. Anal. 10 (1973) 674); both converge quadratically.
    """
    pole, unit = pole.copy(), np.eye(stiffness.shape[-1])
    vector = vector / np.linalg.norm(vector, axis=-1, keepdims=True)
    converged = np.zeros(len(pole), dtype=bool)
    with np.errstate(all="ignore"):
        for _ in range(STEPS):
            at = (1.0 + ASIDE) * pole[:, None, None]
            right = damping @ vector[..., None] + 2.0 * at * vector[..., None]
            try:
                new = np.linalg.solve(stiffness + at * damping + at**2 * unit, right)[..., 0]
            except np.linalg.LinAlgError:
                return pole, vector, np.zeros_like(converged)
            step = 1.0 / (vector.conj() * new).sum(axis=-1)
            pole, vector = at[:, 0, 0] - step, new / np.linalg.norm(new, axis=-1, keepdims=True)
            converged = np.abs(step) <= MET * np.abs(pole)
            if converged.all():
                break
    return pole, vector, converged


def participation(stiffness: Matrix, damping: Matrix, pole: Complex, vector: Complex) -> Complex:
    """Return the left vectors w (k, n), w P′ v = 1, of corrected eigenpairs (k,), (k, n), as in
    ``Modes``: by two steps of inverse iteration with Pᵀ from a slightly shifted pole."""
    unit = np.eye(stiffness.shape[-1])
    at = (1.0 + BESIDE) * pole[:, None, None]
    derivative = np.swapaxes(damping, -1, -2) + 2.0 * at * unit
    transposed = np.swapaxes(stiffness + at * damping + at**2 * unit, -1, -2)
    start = derivative @ vector.conj()[..., None]
    for _ in range(2):
        left = np.linalg.solve(transposed, start)
        start = derivative @ (left / np.linalg.norm(left, axis=-2, keepdims=True))
    slope = damping @ vector[..., None] + 2.0 * pole[:, None, None] * vector[..., None]
    return np.asarray((left / (np.swapaxes(left, -1, -2) @ slope))[..., 0])
