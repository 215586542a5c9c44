"""Poles of lightly damped systems: those of their conservative part, refined all together.

With poles λ_j, vectors q_j (columns of Q) and participations p_i (rows of P) so far, and the rest
R = Q Λ² + D Q Λ + K Q, better ones are

    λ_i − (P R)_ii / G_ii,   Q (1 + F),   (2 − G − F) P,

G = P (Q Λ + D Q) + Λ P Q, the unit matrix in the end, and F_ij = (P R)_ij/(λ_i − λ_j), F_ii = 0.
What they are off by is squared, as in Newton's method: it is one step for all vectors (Λ Q, Q) of
the first-order form and their inverse. (Where that is symmetric the inverse is the transpose: Ogita
and Aishima, Iterative refinement for symmetric eigenvalue decomposition, 2018.) As all vectors are
refined at once and stay independent, none is lost and none comes twice.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rotordyn.arrays import Complex, Flags, Matrix
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
    """Poles (2n,), vectors (n, 2n) and participations (2n, n) of a system, as ``modes``.

    ``before``: those of the system before in a chain.
    """

    modes: tuple[Complex, Complex, Complex]
    before: tuple[Complex, Complex, Complex] | None = None

    @classmethod
    def begun(cls, stiffness: Matrix, damping: Matrix) -> _Near | None:
        """Of a system by itself; None where its conservative part is no start."""
        known = whirls(_hermitian(stiffness), 1j * _hermitian(-1j * damping))
        if known is None:
            return None
        order, _, rate, both = known
        pole = np.asarray(1j * rate, dtype=complex)
        vector = np.asarray(both[: len(order)][order.argsort()], dtype=complex)
        left = np.asarray(vector.conj().T / pole[:, None], dtype=complex)
        found = cls((pole, vector, left)).refined(stiffness, damping)
        return None if found is None else replace(found, before=None)

    def refined(self, stiffness: Matrix, damping: Matrix) -> _Near | None:
        """Of a system near by; None where the vectors are too far, or two poles too close."""
        pole, vector, left = self.modes
        if self.before is not None:  # on in a straight line
            ahead = (2.0 * now - then for now, then in zip(self.modes, self.before, strict=True))
            pole, vector, left = ahead
        n, diagonal = len(stiffness), slice(None, None, 2 * len(stiffness) + 1)
        both = np.concatenate([damping, stiffness]).astype(complex)
        for _ in range(STEPS):
            pushed = both @ vector
            slope = vector * pole + pushed[:n]
            rest = slope * pole + pushed[n:]
            found = (left @ np.hstack([vector, slope, rest])).reshape(2 * n, 3, 2 * n)
            off, change = pole[:, None] * found[:, 0] + found[:, 1], found[:, 2]
            pole = pole - change.diagonal() / off.diagonal()
            apart = pole[:, None] - pole
            off.flat[diagonal] -= 1.0
            apart.flat[diagonal] = 1.0
            with np.errstate(divide="ignore", invalid="ignore"):  # of equal poles: not below FAR
                change = change / apart
            change.flat[diagonal] = 0.0
            size = max(np.abs(change.view(float)).max(), np.abs(off.view(float)).max())
            if not size < FAR:
                return None
            vector, left = vector + vector @ change, left - (off + change) @ left
            if size < SAME:
                if not np.abs(pole).min() > SLOWEST * np.abs(pole).max():
                    return None  # as of ``whirls``
                return _Near((pole, vector, left), self.modes)
        return None


def _hermitian(matrix: Matrix) -> Matrix:
    return 0.5 * (matrix + np.swapaxes(matrix.conj(), -1, -2))
