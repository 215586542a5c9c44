"""Single eigenpairs of q̈ + D q̇ + K q = 0 from near ones, by Newton's method."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Complex, Flags, Matrix

STEPS = 10
MET = 1e-12  # of a pole: the step is rounding
BESIDE = 1e-9  # of a pole: aside for inverse iteration
ASIDE = 1e-14  # of a pole: at itself P may have no inverse, and stop those that share its batch


def corrected(
    stiffness: Matrix, damping: Matrix, pole: Complex, vector: Complex
) -> tuple[Complex, Complex, Flags]:
    """Poles (k,), vectors (k, n) of unit length, and which of them converged (k,).

    ``stiffness`` and ``damping`` (k, n, n), ``pole`` (k,), ``vector`` (k, n): a start for each.
    With P(λ) = λ² + λ D + K, x = P⁻¹ P′ v gives the next vector and λ − vᴴv/vᴴx the next pole
    (Ruhe, SIAM J. Numer. Anal. 10 (1973) 674); both converge quadratically.
    """
    pole, one = pole.copy(), np.eye(stiffness.shape[-1])
    vector = vector / np.linalg.norm(vector, axis=-1, keepdims=True)
    met = np.zeros(len(pole), dtype=bool)
    with np.errstate(all="ignore"):
        for _ in range(STEPS):
            at = (1.0 + ASIDE) * pole[:, None, None]
            turned = damping @ vector[..., None] + 2.0 * at * vector[..., None]
            try:
                after = np.linalg.solve(stiffness + at * damping + at**2 * one, turned)[..., 0]
            except np.linalg.LinAlgError:
                return pole, vector, np.zeros_like(met)
            step = 1.0 / (vector.conj() * after).sum(axis=-1)
            pole, vector = at[:, 0, 0] - step, after / np.linalg.norm(after, axis=-1, keepdims=True)
            met = np.abs(step) <= MET * np.abs(pole)
            if met.all():
                break
    return pole, vector, met


def participation(stiffness: Matrix, damping: Matrix, pole: Complex, vector: Complex) -> Complex:
    """Of corrected eigenpairs (k,), (k, n) the left vectors w (k, n), w P′ v = 1, as ``Modes`` have
    them: by two steps of inverse iteration with Pᵀ from a pole just aside."""
    one = np.eye(stiffness.shape[-1])
    at = (1.0 + BESIDE) * pole[:, None, None]
    turned = np.swapaxes(damping, -1, -2) + 2.0 * at * one
    whole = np.swapaxes(stiffness + at * damping + at**2 * one, -1, -2)
    start = turned @ vector.conj()[..., None]
    for _ in range(2):
        left = np.linalg.solve(whole, start)
        start = turned @ (left / np.linalg.norm(left, axis=-2, keepdims=True))
    slope = damping @ vector[..., None] + 2.0 * pole[:, None, None] * vector[..., None]
    return np.asarray((left / (np.swapaxes(left, -1, -2) @ slope))[..., 0])
