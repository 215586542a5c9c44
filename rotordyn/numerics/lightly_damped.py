"""Poles of lightly damped systems: those of their conservative part, refined all together.

In the vectors of the conservative part (``numerics.conservative``) the matrix of the system is
nearly diagonal. Where it is Λ + R in the vectors X so far, Λ its diagonal, F_ij = R_ij/(Λ_j − Λ_i)
and F_ii = 0, X (1 + F) are better ones: there it is Λ + (1 + F)⁻¹ R F, so that what is left beside
the diagonal is squared, as in Jacobi's method for matrices that are nearly diagonal. As all vectors
are refined at once and stay independent, none is lost and none comes twice.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Complex, Flags, Indices, Matrix
from rotordyn.numerics.conservative import SLOWEST, whirls
from rotordyn.numerics.threads import in_threads

STEPS = 7
FAR = 0.5  # of a vector, from another one: so much is no small correction
CLOSE = 1e-4  # the series of (1 + F)⁻¹ up to F² lacks rounding alone
SAME = 1e-7  # its square is rounding
CHAIN = 8  # systems, the first of which begins anew: so threads do not change a digit


def lightly_damped_modes(
    stiffness: Matrix, damping: Matrix
) -> tuple[Complex, Complex, Complex, Flags]:
    """Poles (s, 2n), vectors (s, n, 2n), participations (s, 2n, n) of ``numerics.modes``, and
    where they were found (s,).

    Stiffness and damping (s, n, n) of systems that change little from one to the next: the vectors
    of one are the start for the next.
    """
    count, n = stiffness.shape[:2]
    pole, known = np.ones((count, 2 * n), dtype=complex), np.zeros(count, dtype=bool)
    vector, left = np.ones((count, n, 2 * n), complex), np.ones((count, 2 * n, n), complex)

    def refine(part: slice) -> None:
        near: _Near | None = None
        for k in range(count)[CHAIN * part.start : CHAIN * part.stop]:
            system = stiffness[k], damping[k]
            found = None if near is None or k % CHAIN == 0 else near.refined(*system)
            if found is None and (near := _Near.conservative(*system)) is not None:
                found = near.refined(*system)
            near = found
            if found is not None:
                pole[k], vector[k], left[k] = found.modes
                known[k] = True

    in_threads(refine, -(-count // CHAIN), 1)
    return pole, vector, left, known


@dataclass(frozen=True, eq=False, slots=True)
class _Near:
    """Eigenvalues iν, ``rate`` (2n,), vectors and their inverse (2n, 2n), of a matrix

        [[i D, K L⁻ᴴ], [Lᴴ, 0]],   (v, u), v = ν q, u = Lᴴ q,

    coordinates in the ``order`` (n,) of ``whirls``, with the root ``upper`` Lᴴ of some near K and
    its inverse ``back`` L⁻ᴴ."""

    order: Indices
    upper: Matrix
    back: Matrix
    rate: NDArray[np.inexact]
    vectors: Matrix
    inverse: Matrix

    @classmethod
    def conservative(cls, stiffness: Matrix, damping: Matrix) -> _Near | None:
        """Of the conservative part of a system; None where that is no start."""
        known = whirls(_hermitian(stiffness), 1j * _hermitian(-1j * damping))
        if known is None:
            return None
        order, upper, rate, both = known
        return cls(order, upper, np.linalg.inv(upper), rate, both, both.conj().T)  # orthonormal

    def refined(self, stiffness: Matrix, damping: Matrix) -> _Near | None:
        """Of a system near by; None where the vectors are too far, or two eigenvalues too close."""
        n, swapped = len(self.order), (self.order[:, None], self.order)
        matrix = np.zeros((2 * n, 2 * n), dtype=complex)
        matrix[:n, :n] = 1j * damping[swapped]
        matrix[:n, n:] = stiffness[swapped] @ self.back
        matrix[n:, :n] = self.upper
        vectors, diagonal = self.vectors.astype(complex), slice(None, None, 2 * n + 1)
        rest = self.inverse @ (matrix @ vectors)
        rate = rest.diagonal().copy()
        for _ in range(STEPS):
            apart = rate - rate[:, None]
            rest.flat[diagonal], apart.flat[diagonal] = 0.0, 1.0
            with np.errstate(divide="ignore", invalid="ignore"):  # of equal rates: not below FAR
                change = rest / apart
            size = np.abs(change).max()
            if not size < FAR:
                return None
            vectors = vectors + vectors @ change
            if size < SAME:
                if not np.abs(rate).min() > SLOWEST * np.abs(rate).max():
                    return None  # as of ``whirls``
                return replace(self, rate=rate, vectors=vectors, inverse=np.linalg.inv(vectors))
            rest = rest @ change
            if size < CLOSE:
                rest = rest - change @ (rest - change @ rest)
            else:
                change.flat[diagonal] = 1.0
                rest = np.linalg.solve(change, rest)
            rate = rate + rest.diagonal()
        return None

    @property
    def modes(self) -> tuple[Complex, Complex, Complex]:
        """Poles (2n,), vectors (n, 2n), participations (2n, n)."""
        pole, back = np.asarray(1j * self.rate, dtype=complex), self.order.argsort()
        left = np.asarray(self.inverse[:, back] / pole[:, None], dtype=complex)
        return pole, np.asarray(self.vectors[back], dtype=complex), left


def _hermitian(matrix: Matrix) -> Matrix:
    return 0.5 * (matrix + np.swapaxes(matrix.conj(), -1, -2))
