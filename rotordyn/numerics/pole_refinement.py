"""Least-squares refinement of the poles of a sum through samples, and their standard deviations.

    min over p of Σ |w (H − Σ R/(iω − p) − D)|², the residues R and D being the best at p

Vector fitting weighs samples by a denominator that noise shifts. From its poles a few Gauss-Newton
steps on the poles alone lead to the minimum (variable projection, with the derivative of Kaufman).
Where weights are one over standard deviations, the inverse of the last normal matrix is the
covariance of the poles, whatever the residues are.

Source: Golub and Pereyra (2003).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Complex
from rotordyn.numerics.vector_fit import (
    Fit,
    columns,
    complex_residues,
    real_residues,
    real_unknowns,
    residues,
    stacked,
)

ROUNDS = 20  # Gauss-Newton steps, at most
BETTER = 1e-7  # of the sum of squares: a smaller gain ends the steps
HALVINGS = 6  # of a step, at most


class Refined(NamedTuple):
    """``fit``; ``deviation`` (m, 2): standard deviations of the real and imaginary part of every
    pole; ``squares``: the sum of weighted squares; ``unknowns``: real numbers fitted."""

    fit: Fit
    deviation: Array
    squares: float
    unknowns: int


class _Linearised(NamedTuple):
    """Sum of squares; Jᵀr (k,) and JᵀJ (k, k) by the real unknowns of the poles over |p|."""

    squares: float
    slope: Array
    normal: Array


def refined(omega: Array, values: Complex, pole: Complex, weight: Array) -> Refined:
    """Refine ``pole`` (m,) by least squares for ``values``, ``weight`` (f, e) at ``omega`` (f,).

    Poles stay left of the imaginary axis and keep their kind, real or of a pair.
    """
    pole = np.array(pole, dtype=complex)
    current = _linearised(omega, values, pole, weight)
    for _ in range(ROUNDS):
        step = np.asarray(np.linalg.lstsq(current.normal, current.slope, rcond=1e-14)[0])
        for half in range(HALVINGS):
            trial_pole = _moved(pole, step * 0.5**half)
            trial = _linearised(omega, values, trial_pole, weight)
            if trial.squares < current.squares:
                break
        else:
            break
        gain = current.squares - trial.squares
        pole, current = trial_pole, trial
        if gain < BETTER * current.squares:
            break
    fit = residues(omega, values, pole, weight)
    unknowns = len(current.slope) + values.shape[1] * (len(current.slope) + 1)
    return Refined(fit, _deviation(pole, current.normal), current.squares, unknowns)


def carried(fit: Fit, omega: Array, weight: Array, at: Array, share: Complex) -> Array:
    """Return the standard deviations (g, 2) of real and imaginary part of Σ ``share`` (g, e) ×
    entries of ``fit`` ``at`` angular frequencies (g,), where those of every sample at ``omega``
    (f,) that it was fitted to are 1/``weight`` (f, e)."""
    rows = stacked(weight.T[:, :, None] * _derivatives(fit, omega))
    size = np.maximum(np.linalg.norm(rows, axis=(0, 1)), 1e-300)
    triangle = np.linalg.qr((rows / size).reshape(-1, len(size)), mode="r")
    gradient = np.einsum("ge,egk->gk", share, _derivatives(fit, at)) / size
    scaled = gradient @ np.linalg.pinv(triangle)
    return np.linalg.norm([scaled.real, scaled.imag], axis=2).T


def _derivatives(fit: Fit, omega: Array) -> Complex:
    """Return derivatives of every entry (e, f, k) by poles, then by its residues and constant."""
    basis = np.concatenate([columns(omega, fit.pole), np.ones((len(omega), 1))], axis=1)
    coefficients = np.concatenate([real_residues(fit.pole, fit.residue), fit.constant[None]]).T
    linear = np.einsum("ij,fk->ifjk", np.eye(len(coefficients)), basis)
    return np.concatenate(
        [_moving(omega, fit.pole, coefficients), linear.reshape(*linear.shape[:2], -1)], axis=2
    )


def _linearised(omega: Array, values: Complex, pole: Complex, weight: Array) -> _Linearised:
    """Linearise about ``pole``, residues eliminated entry by entry."""
    basis = np.concatenate([columns(omega, pole), np.ones((len(omega), 1))], axis=1)
    q, r = np.linalg.qr(stacked(weight.T[:, :, None] * basis))
    right = stacked((weight * values).T[:, :, None])
    projected = np.swapaxes(q, 1, 2) @ right
    residual = right - q @ projected
    pairs = zip(r, projected, strict=True)
    coefficients = np.array([np.linalg.lstsq(a, b, rcond=None)[0][:, 0] for a, b in pairs])
    jacobian = stacked(weight.T[:, :, None] * _moving(omega, pole, coefficients))
    jacobian -= q @ (np.swapaxes(q, 1, 2) @ jacobian)
    transposed = np.swapaxes(jacobian, 1, 2)
    slope, normal = (transposed @ residual).sum(axis=0)[:, 0], (transposed @ jacobian).sum(axis=0)
    return _Linearised(float((residual**2).sum()), slope, normal)


def _moving(omega: Array, pole: Complex, known: Array) -> Complex:
    """Return derivatives (e, f, k) by the real and imaginary part of every pole over its size, the
    real part alone of real ones; ``known`` (e, k + 1): coefficients of the columns."""
    residue = complex_residues(pole, known[:, :-1].T).T[:, None]
    s, size = 1j * omega[:, None], np.abs(pole)
    direct = residue * (size / (s - pole) ** 2)
    conjugate = residue.conj() * (size / (s - pole.conj()) ** 2)
    return np.stack([direct + conjugate, 1j * (direct - conjugate)], axis=-1)[
        ..., real_unknowns(pole)
    ]


def _moved(pole: Complex, step: Array) -> Complex:
    """Return poles after a step relative to their size, left of the axis, pairs as pairs."""
    parts = _by_pole(pole, step)
    return np.minimum(pole.real + parts[:, 0], 0.1 * pole.real) + 1j * np.maximum(
        pole.imag + parts[:, 1], 0.1 * pole.imag
    )


def _deviation(pole: Complex, normal: Array) -> Array:
    covariance = np.diag(np.linalg.pinv(normal, hermitian=True))
    return _by_pole(pole, np.sqrt(np.maximum(covariance, 0.0)))


def _by_pole(pole: Complex, relative: Array) -> Array:
    """Return real and imaginary part (m, 2) of unknowns (k,) over the sizes of their poles."""
    parts = np.zeros((len(pole), 2))
    parts[real_unknowns(pole)] = relative
    return parts * np.abs(pole)[:, None]
