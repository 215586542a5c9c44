"""Poles of lightly damped systems: those of their conservative part, refined all together.

In the vectors of the conservative part (``numerics.conservative``) the matrix of the system is
nearly diagonal. With B the matrix in the vectors X so far, F_ij = B_ij/(B_jj − B_ii) and F_ii = 0,
X (1 + F) are better ones: what is left beside the diagonal is squared, as in Jacobi's method for
matrices that are nearly diagonal. As all vectors are refined at once and stay independent, none is
lost and none comes twice.
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
CLOSE = 1e-7  # its square is rounding
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

    coordinates in the ``order`` (n,) of ``whirls``, with the root ``upper`` Lᴴ of some near K."""

    order: Indices
    upper: Matrix
    rate: NDArray[np.inexact]
    vectors: Matrix
    inverse: Matrix

    @classmethod
    def conservative(cls, stiffness: Matrix, damping: Matrix) -> _Near | None:
        """Of the conservative part of a system; None where that is no start."""
        known = whirls(_hermitian(stiffness), 1j * _hermitian(-1j * damping))
        if known is None:
            return None
        return cls(*known, known[-1].conj().T)  # its vectors are orthonormal

    def refined(self, stiffness: Matrix, damping: Matrix) -> _Near | None:
        """Of a system near by; None where the vectors are too far, or two eigenvalues too close."""
        n, swapped = len(self.order), np.ix_(self.order, self.order)
        matrix = np.zeros((2 * n, 2 * n), dtype=complex)
        matrix[:n, :n] = 1j * damping[swapped]
        matrix[:n, n:] = np.linalg.solve(self.upper.T, stiffness[swapped].T).T
        matrix[n:, :n] = self.upper
        vectors, one = self.vectors.astype(complex), np.eye(2 * n)
        rest = self.inverse @ (matrix @ vectors)
        for _ in range(STEPS):
            rate = rest.diagonal().copy()
            apart = rate - rate[:, None]
            apart.flat[:: 2 * n + 1] = 1.0
            with np.errstate(divide="ignore", invalid="ignore"):  # of equal ones, not below FAR
                change = rest / apart
            change.flat[:: 2 * n + 1] = 0.0
            size = (change.real**2 + change.imag**2).max()
            if not size < FAR**2:
                return None
            vectors = vectors + vectors @ change
            if size < CLOSE**2:
                if not np.abs(rate).min() > SLOWEST * np.abs(rate).max():
                    return None  # as of ``whirls``
                return replace(self, rate=rate, vectors=vectors, inverse=np.linalg.inv(vectors))
            turn = one + change
            rest = np.linalg.solve(turn, rest @ turn)
        return None

    @property
    def modes(self) -> tuple[Complex, Complex, Complex]:
        """Poles (2n,), vectors (n, 2n), participations (2n, n)."""
        pole, back = np.asarray(1j * self.rate, dtype=complex), self.order.argsort()
        left = np.asarray(self.inverse[:, back] / pole[:, None], dtype=complex)
        return pole, np.asarray(self.vectors[back], dtype=complex), left


def _hermitian(matrix: Matrix) -> Matrix:
    return 0.5 * (matrix + np.swapaxes(matrix.conj(), -1, -2))
