"""Poles of lightly damped systems: those of their conservative part, refined all together.

In the vectors of the conservative part (``numerics.conservative``) the matrix A of the system is
nearly diagonal. With vectors X so far and Y near their inverse, S = Y A X and G = Y X, better ones
are X (1 + F) and (2 − G − F) Y, where F_ij = (S_ij − λ_j G_ij)/(λ_j − λ_i), F_ii = 0 and
λ_i = S_ii/G_ii. What they are off by is squared, as in Newton's method. (Where A is symmetric the
inverse is the transpose: Ogita and Aishima, Iterative refinement for symmetric eigenvalue
decomposition, 2018.) As all vectors are refined at once and stay independent, none is lost and none
comes twice.
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
SAME = 1e-7  # vectors are off by its square, and poles, once polished, by less
CHAIN = 16  # systems, the first of which begins anew: so threads do not change a digit


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
            near = near.refined(*system) if near is not None and k % CHAIN else None
            near = near or _Near.begun(*system)
            if near is not None:
                pole[k], vector[k], left[k] = near.modes
                known[k] = True

    in_threads(refine, -(-count // CHAIN), 1)
    return pole, vector, left, known


@dataclass(frozen=True, eq=False, slots=True)
class _Near:
    """Eigenvalues iν, ``rate`` (2n,), vectors and their inverse (2n, 2n), of a matrix

        [[i D, K L⁻ᴴ], [Lᴴ, 0]],   (v, u), v = ν q, u = Lᴴ q,

    coordinates in the ``order`` (n,) of ``whirls``, with the root ``upper`` Lᴴ of some near K and
    its inverse ``back`` L⁻ᴴ. ``before``: vectors and inverse of the system before in a chain."""

    order: Indices
    upper: Matrix
    back: Matrix
    rate: NDArray[np.inexact]
    vectors: Matrix
    inverse: Matrix
    before: tuple[Matrix, Matrix] | None = None

    @classmethod
    def begun(cls, stiffness: Matrix, damping: Matrix) -> _Near | None:
        """Of a system by itself; None where its conservative part is no start."""
        known = whirls(_hermitian(stiffness), 1j * _hermitian(-1j * damping))
        if known is None:
            return None
        order, upper, rate, both = known
        pair = both.astype(complex), both.conj().T.astype(complex)  # orthonormal
        near = cls(order, upper, np.linalg.inv(upper), rate, *pair)
        found = near.refined(stiffness, damping)
        return None if found is None else replace(found, before=None)

    def refined(self, stiffness: Matrix, damping: Matrix) -> _Near | None:
        """Of a system near by; None where the vectors are too far, or two eigenvalues too close."""
        n, swapped = len(self.order), (self.order[:, None], self.order)
        matrix = np.zeros((2 * n, 2 * n), dtype=complex)
        matrix[:n, :n] = 1j * damping[swapped]
        matrix[:n, n:] = stiffness[swapped] @ self.back
        matrix[n:, :n] = self.upper
        vectors, inverse, diagonal = self.vectors, self.inverse, slice(None, None, 2 * n + 1)
        if self.before is not None:  # on in a straight line
            vectors, inverse = 2.0 * vectors - self.before[0], 2.0 * inverse - self.before[1]
        for _ in range(STEPS):
            change, off = inverse @ (matrix @ vectors), inverse @ vectors
            rate = change.diagonal() / off.diagonal()
            off.flat[diagonal] -= 1.0
            apart = rate - rate[:, None]
            apart.flat[diagonal] = 1.0
            with np.errstate(divide="ignore", invalid="ignore"):  # of equal rates: not below FAR
                change = (change - off * rate) / apart
            change.flat[diagonal] = 0.0
            size = max(np.abs(change).max(), np.abs(off).max())
            if not size < FAR:
                return None
            vectors, inverse = vectors + vectors @ change, inverse - (off + change) @ inverse
            if size < SAME:
                if not np.abs(rate).min() > SLOWEST * np.abs(rate).max():
                    return None  # as of ``whirls``
                known = self.order, self.upper, self.back
                return _Near(*known, rate, vectors, inverse, (self.vectors, self.inverse))
        return None

    @property
    def modes(self) -> tuple[Complex, Complex, Complex]:
        """Poles (2n,), vectors (n, 2n), participations (2n, n)."""
        pole, back = np.asarray(1j * self.rate, dtype=complex), self.order.argsort()
        left = np.asarray(self.inverse[:, back] / pole[:, None], dtype=complex)
        return pole, np.asarray(self.vectors[back], dtype=complex), left


def _hermitian(matrix: Matrix) -> Matrix:
    return 0.5 * (matrix + np.swapaxes(matrix.conj(), -1, -2))
