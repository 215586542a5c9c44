"""A sum of poles through samples of a response, by vector fitting.

H(iω) ≈ Σ R/(iω − p) + D with poles in conjugate pairs. Poles are moved by those of a common
denominator σ(s) H(s) until it is 1; noise is averaged by least squares over all samples.

Source: Gustavsen and Semlyen (1999), Deschrijver and others (2008): one pole set of all entries, a
QR factorisation of each entry.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Complex, Flags

ROUNDS = 12  # in which poles are moved, at most
MOVED = 1e-10  # of a pole: a smaller change ends the rounds
LEAST_DAMPING = 1e-6  # of |pole|: least distance of poles left of the axis


class Fit(NamedTuple):
    """Poles ``pole`` (m,) of Im ≥ 0; ``residue`` (m, e) and ``constant`` (e,) of every entry;
    ``error`` (f, e): samples less the sum."""

    pole: Complex
    residue: Complex
    constant: Array
    error: Complex

    def __call__(self, omega: Array | Complex) -> Complex:
        """Return the sum at frequencies ``omega`` (f,), of Im < 0 for a growing force: (f, e)."""
        return columns(omega, self.pole) @ real_residues(self.pole, self.residue) + self.constant


def vector_fit(omega: Array, values: Complex, weight: Array, start: Complex) -> Fit:
    """Fit poles, from ``start`` (m,) on, to ``values`` (f, e) at ``omega`` (f,) [rad/s], ascending,
    with a ``weight`` of every sample, (f, e) or (f, 1) of all entries."""
    pole = start
    size = max(float(np.abs(weight * values).max()), 1e-300)
    weight = np.broadcast_to(weight / size, values.shape)
    for _ in range(ROUNDS):
        new = _moved(omega, values, pole, weight)
        change = np.abs(new - pole).max() / np.abs(new).max() if len(new) == len(pole) else 1
        pole = new
        if change < MOVED:
            break
    return residues(omega, values, pole, weight)


def residues(omega: Array, values: Complex, pole: Complex, weight: Array) -> Fit:
    """Return the sum over known poles."""
    basis = np.concatenate([columns(omega, pole), np.ones((len(omega), 1))], axis=1)
    weight = np.broadcast_to(weight, values.shape)
    coefficients = np.empty((basis.shape[1], values.shape[1]))
    for k, (entry_weight, entry) in enumerate(zip(weight.T, values.T, strict=True)):
        left = stacked(entry_weight[:, None] * basis)
        scale = np.maximum(np.linalg.norm(left, axis=0), 1e-300)
        right = stacked((entry_weight * entry)[:, None])
        coefficients[:, k] = np.linalg.lstsq(left / scale, right, rcond=None)[0][:, 0] / scale
    residue = complex_residues(pole, coefficients[:-1])
    fitted = basis @ coefficients
    return Fit(pole, residue, coefficients[-1], values - fitted)


def real_unknowns(pole: Complex) -> Flags:
    """Return which of two real numbers of a pole (m, 2) are unknown: of a real one the first."""
    return np.stack([np.ones(len(pole), dtype=bool), pole.imag != 0.0], axis=1)


def columns(omega: Array | Complex, pole: Complex) -> Complex:
    """Return functions of real coefficients (f, 2 per pair and 1 per real pole)."""
    s = 1j * omega[:, None]
    direct, conjugate = 1.0 / (s - pole), 1.0 / (s - pole.conj())
    first = np.where(pole.imag == 0.0, direct, direct + conjugate)
    both = np.stack([first, 1j * (direct - conjugate)], axis=2)
    return np.ascontiguousarray(both[:, real_unknowns(pole)])


def complex_residues(pole: Complex, rows: Array) -> Complex:
    """Return residues (m, e) from real coefficients; half for a real pole, its own conjugate."""
    parts = np.zeros((len(pole), 2, rows.shape[1]))
    parts[real_unknowns(pole)] = rows
    return np.where(pole.imag == 0.0, 0.5, 1.0)[:, None] * (parts[:, 0] + 1j * parts[:, 1])


def real_residues(pole: Complex, residue: Complex) -> Array:
    """Return real coefficients (k, e) from residues (m, e)."""
    residue = np.where(pole.imag == 0.0, 2.0, 1.0)[:, None] * residue
    return np.stack([residue.real, residue.imag], axis=1)[real_unknowns(pole)]


def stacked(rows: Complex) -> Array:
    """Stack real parts of rows (…, f, k) above imaginary ones (…, 2f, k)."""
    return np.concatenate([rows.real, rows.imag], axis=-2)


def _moved(omega: Array, values: Complex, pole: Complex, weight: Array) -> Complex:
    """Return the zeros of the common denominator, which become the poles."""
    unweighted = columns(omega, pole)
    n, rows, right = unweighted.shape[1] + 1, [], []
    for share, entry in zip(weight.T, values.T, strict=True):
        if not np.abs(entry).any():
            continue
        basis = share[:, None] * unweighted
        extended = np.concatenate([basis, share[:, None].astype(complex)], axis=1)
        block = stacked(np.concatenate([extended, -entry[:, None] * basis], axis=1))
        target = stacked((share * entry)[:, None])
        r = np.asarray(np.linalg.qr(np.concatenate([block, target], axis=1), mode="r"))
        rows.append(r[n:-1, n:-1])
        right.append(r[n:-1, -1])
    left, target = np.concatenate(rows), np.concatenate(right)
    scale = np.maximum(np.linalg.norm(left, axis=0), 1e-300)
    return _zeros(pole, np.linalg.lstsq(left / scale, target, rcond=None)[0] / scale)


def _zeros(pole: Complex, share: Array) -> Complex:
    """Return the zeros of 1 + Σ share/(s − pole), kept left of the imaginary axis."""
    size = len(share)
    matrix, column, at = np.zeros((size, size)), np.zeros(size), 0
    for p in pole:
        if p.imag == 0.0:
            matrix[at, at], column[at], at = p.real, 1.0, at + 1
            continue
        pair = [[p.real, p.imag], [-p.imag, p.real]]
        matrix[at : at + 2, at : at + 2], column[at], at = pair, 2.0, at + 2
    zeros = np.linalg.eigvals(matrix - np.outer(column, share))
    zeros = zeros[zeros.imag >= 0.0]
    decay = np.maximum(np.abs(zeros.real), LEAST_DAMPING * np.abs(zeros))
    return np.sort_complex(-decay + 1j * zeros.imag)
