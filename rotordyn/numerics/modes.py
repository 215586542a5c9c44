"""Eigenvalues of q̈ + D q̇ + K q = f, many at once, and the receptances they sum up to."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Matrix = NDArray[np.inexact[Any]]


@dataclass(frozen=True, slots=True)
class Modes:
    """Poles and vectors of a batch of systems of order n with unit mass.

    ``pole`` (…, 2n) [rad/s]; ``vector`` (…, n, 2n): displacement part of the right vectors;
    ``participation`` (…, 2n, n): what each pole takes from a force on each coordinate, so that the
    receptance at s is vector · diag(1/(s − pole)) · participation.
    """

    pole: Complex
    vector: Complex
    participation: Complex

    def receptance(self, omega: Array, responses: Array, excitations: Array) -> Complex:
        """Receptance at i·``omega`` (f,) of paired rows: (…, pairs, f).

        ``responses`` and ``excitations`` (pairs, n). With λ = σ + iν, 1/(iω − λ) is
        (iν − σ − iω)/(σ² + (ω − ν)²): one real table per batch entry serves all pairs.
        """
        residues = (responses @ self.vector) * (self.participation @ excitations.T).swapaxes(-1, -2)
        batch = residues.shape[:-2]
        total = np.empty((*batch, len(responses), len(omega)), dtype=complex)
        for place in np.ndindex(*batch):
            pole, residue = self.pole[place], residues[place]
            table = 1.0 / (pole.real[:, None] ** 2 + (omega - pole.imag[:, None]) ** 2)
            turned = residue * (1j * pole.imag - pole.real)
            total[place] = _summed(turned, table) - 1j * omega * _summed(residue, table)
        return total


def _summed(residues: Complex, table: Array) -> Complex:
    """Complex times real matrix without making the real one complex."""
    return residues.real @ table + 1j * (residues.imag @ table)


def modes(stiffness: Matrix, damping: Matrix) -> Modes:
    """Modes of q̈ + D q̇ + K q = f; ``stiffness``, ``damping`` (…, n, n), real or complex."""
    shape = np.broadcast_shapes(stiffness.shape, damping.shape)
    n = shape[-1]
    matrix = np.zeros((*shape[:-2], 2 * n, 2 * n), dtype=np.result_type(stiffness, damping))
    matrix[..., :n, n:] = np.eye(n)
    matrix[..., n:, :n] = -stiffness
    matrix[..., n:, n:] = -damping
    scale = float(np.sqrt(np.abs(stiffness).max())) or 1.0  # balances displacement and velocity
    matrix[..., :n, n:] *= scale
    matrix[..., n:, :n] /= scale
    pole, vectors = (part.astype(complex) for part in np.linalg.eig(matrix))
    forces = np.asarray(np.linalg.inv(vectors)[..., n:] / scale, dtype=complex)
    return Modes(pole, vectors[..., :n, :], forces)


def residual(found: Modes, stiffness: Matrix, damping: Matrix) -> float:
    """Largest |(λ² + λ D + K) v| over (|λ|² + |λ D| + |K|) |v| of all eigenpairs."""
    pole, vector = found.pole[..., None, :], found.vector
    rest = pole**2 * vector + pole * (damping @ vector) + stiffness @ vector
    size = np.abs(found.pole) ** 2 + np.abs(found.pole) * _norm(damping) + _norm(stiffness)
    return float((np.abs(rest).max(axis=-2) / (size * np.abs(vector).max(axis=-2))).max())


def _norm(matrix: Matrix) -> Array:
    return np.abs(matrix).sum(axis=-1).max(axis=-1)[..., None]
