"""Poles of lightly damped systems: those of their conservative part, refined all together.

With approximate poles λ_j, vectors q_j (columns of Q) and participations p_i (rows of P), and the
residual R = Q Λ² + D Q Λ + K Q, better ones are

    λ_i − (P R)_ii / G_ii,   Q (1 + F),   (2 − G − F) P,

G = P (Q Λ + D Q) + Λ P Q, the unit matrix in the end, and F_ij = (P R)_ij/(λ_i − λ_j), F_ii = 0.
Errors are squared, as in Newton's method: it is one step for all vectors (Λ Q, Q) of the
first-order form and their inverse. (Where that is symmetric the inverse is the transpose: Ogita and
Aishima, Iterative refinement for symmetric eigenvalue decomposition, 2018.) As all vectors are
refined at once and stay independent, none is lost or repeated.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rotordyn.arrays import Complex, Flags, Matrix
from rotordyn.numerics.conservative import SLOWEST, whirls
from rotordyn.numerics.threads import in_threads

STEPS = 7  # of refinement, at most
FAR = 0.5  # of a vector: a larger share of another one is no small correction
SAME = 1e-7  # last correction: vectors err by its square, and poles, once polished, by less
CHAIN = 16  # systems, the first solved by itself: so threads do not change a digit


def lightly_damped_modes(
    stiffness: Matrix, damping: Matrix
) -> tuple[Complex, Complex, Complex, Flags]:
    """Return poles (s, 2n), vectors (s, n, 2n), participations (s, 2n, n) of ``numerics.modes``,
    and where they converged (s,).

    Stiffness and damping (s, n, n) of systems that change little from one to the next: the vectors
    of one are the start for the next.
    """
    count, n = stiffness.shape[:2]
    pole, converged = np.ones((count, 2 * n), dtype=complex), np.zeros(count, dtype=bool)
    vector, left = np.ones((count, n, 2 * n), complex), np.ones((count, 2 * n, n), complex)

    def refine(part: slice) -> None:
        solution: _Solution | None = None
        for k in range(count)[CHAIN * part.start : CHAIN * part.stop]:
            system = stiffness[k], damping[k]
            solution = solution.refined(*system) if solution is not None and k % CHAIN else None
            solution = solution or _Solution.begun(*system)
            if solution is not None:
                pole[k], vector[k], left[k] = solution.modes
                converged[k] = True

    in_threads(refine, -(-count // CHAIN), 1)
    return pole, vector, left, converged


@dataclass(frozen=True, eq=False, slots=True)
class _Solution:
    """Poles (2n,), vectors (n, 2n) and participations (2n, n) of a system, as ``modes``.

    ``before``: those of the previous system in a chain.
    """

    modes: tuple[Complex, Complex, Complex]
    before: tuple[Complex, Complex, Complex] | None = None

    @classmethod
    def begun(cls, stiffness: Matrix, damping: Matrix) -> _Solution | None:
        """Solve a system by itself; None where its conservative part is no start."""
        conservative = whirls(_hermitian(stiffness), 1j * _hermitian(-1j * damping))
        if conservative is None:
            return None
        order, _, rate, both = conservative
        pole = np.asarray(1j * rate, dtype=complex)
        vector = np.asarray(both[: len(order)][order.argsort()], dtype=complex)
        left = np.asarray(vector.conj().T / pole[:, None], dtype=complex)
        solution = cls((pole, vector, left)).refined(stiffness, damping)
        return None if solution is None else replace(solution, before=None)

    def refined(self, stiffness: Matrix, damping: Matrix) -> _Solution | None:
        """Solve a similar system; None where the vectors are too far, or two poles too close."""
        pole, vector, left = self.modes
        if self.before is not None:  # extrapolated linearly
            start = (2.0 * now - then for now, then in zip(self.modes, self.before, strict=True))
            pole, vector, left = start
        n, diagonal = len(stiffness), slice(None, None, 2 * len(stiffness) + 1)
        both = np.concatenate([damping, stiffness]).astype(complex)
        for _ in range(STEPS):
            forces = both @ vector
            slope = vector * pole + forces[:n]
            residual = slope * pole + forces[n:]
            products = (left @ np.hstack([vector, slope, residual])).reshape(2 * n, 3, 2 * n)
            defect, change = pole[:, None] * products[:, 0] + products[:, 1], products[:, 2]
            pole = pole - change.diagonal() / defect.diagonal()
            distance = pole[:, None] - pole
            defect.flat[diagonal] -= 1.0
            distance.flat[diagonal] = 1.0
            with np.errstate(divide="ignore", invalid="ignore"):  # equal poles: not below FAR
                change = change / distance
            change.flat[diagonal] = 0.0
            size = max(np.abs(change.view(float)).max(), np.abs(defect.view(float)).max())
            if not size < FAR:
                return None
            vector, left = vector + vector @ change, left - (defect + change) @ left
            if size < SAME:
                if not np.abs(pole).min() > SLOWEST * np.abs(pole).max():
                    return None  # as of ``whirls``
                return _Solution((pole, vector, left), self.modes)
        return None


def _hermitian(matrix: Matrix) -> Matrix:
    return 0.5 * (matrix + np.swapaxes(matrix.conj(), -1, -2))
