"""Poles of conservative systems: a symmetric eigenproblem.

With K = L Lᴴ, H = i D and λ = iν, λ² q + λ D q + K q = 0 is

    ν (v, u) = [[H, L], [Lᴴ, 0]] (v, u),   v = ν q, u = Lᴴ q,

whose matrix is Hermitian: its eigenvectors are orthonormal and give the left ones, too. It is real
where the stiffness is real and D imaginary, as of an isotropic rotor without damping. Stiff
coordinates come first: tridiagonalisation, which begins there, then keeps the digits of slow ones.
"""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array, Complex, Indices, Matrix
from rotordyn.numerics.threads import in_threads

ROUNDING = 1e-14  # of the largest entry of a coordinate's row
HELD = 1e-6  # of a coordinate's stiffness: less, with the others free to follow, loses digits
SLOWEST = 1e-8  # of the fastest: slower poles lose digits
LEAST = 8  # systems to a thread


def conservative_modes(stiffness: Matrix, damping: Matrix) -> tuple[Complex, ...] | None:
    """Return poles (…, 2n), vectors (…, n, 2n) and participations (…, 2n, n) of ``numerics.modes``.

    None where the stiffness (…, n, n) is not Hermitian and clearly positive definite, or the
    damping not anti-Hermitian, or where digits would be lost.
    """
    if not (_hermitian(stiffness) and _hermitian(1j * damping)):
        return None
    solution = whirls(stiffness, damping)
    if solution is None:
        return None
    order, upper, rate, both = solution
    vector = np.linalg.solve(upper, both[..., len(order) :, :])[..., order.argsort(), :]
    pole = np.asarray(1j * rate, dtype=complex)
    left = pole.conj()[..., None] * np.swapaxes(vector.conj(), -1, -2)
    return pole, np.asarray(vector, dtype=complex), left


def whirls(stiffness: Matrix, damping: Matrix) -> tuple[Indices, Matrix, Array, Matrix] | None:
    """Return the order (n,) of the coordinates, and in that order Lᴴ (…, n, n), ν (…, 2n),
    ascending, and the vectors (v, u) (…, 2n, 2n) of Hermitian K and anti-Hermitian D; None if
    digits would be lost."""
    order = np.argsort(-_largest(stiffness))
    swapped = order[:, None], order
    root = _root(_real_if_so(stiffness[..., *swapped]))
    if root is None:
        return None
    upper = np.swapaxes(root.conj(), -1, -2)
    rate, both = _solved(_real_if_so(1j * damping[..., *swapped]), upper)
    if not np.abs(rate).min() > SLOWEST * np.abs(rate).max():
        return None
    return order, upper, rate, both


def _root(stiffness: Matrix) -> Matrix | None:
    """Return L (…, n, n), None where K is not clearly positive definite."""
    try:
        root = np.linalg.cholesky(stiffness)
    except np.linalg.LinAlgError:
        return None
    pivots, size = (np.abs(np.diagonal(part, axis1=-2, axis2=-1)) for part in (root, stiffness))
    return root if (pivots**2 > HELD * size).all() else None


def _solved(turning: Matrix, upper: Matrix) -> tuple[Array, Matrix]:
    """Return ν (…, 2n), ascending, and (v, u) (…, 2n, 2n) from H and Lᴴ."""
    n = upper.shape[-1]
    shape = np.broadcast_shapes(upper.shape, turning.shape)[:-2]
    matrix = np.zeros((*shape, 2 * n, 2 * n), dtype=np.result_type(upper, turning))
    matrix[..., :n, :n] = turning
    matrix[..., n:, :n] = upper  # the lower half is all that is read
    flat = matrix.reshape(-1, 2 * n, 2 * n)
    parts = in_threads(lambda part: np.linalg.eigh(flat[part]), len(flat), LEAST)
    rate = np.concatenate([values for values, _ in parts])
    both = np.concatenate([vectors for _, vectors in parts])
    return rate.reshape(*shape, 2 * n), both.reshape(*shape, 2 * n, 2 * n)


def _largest(stiffness: Matrix) -> Array:
    """Return the stiffness of each coordinate, the largest of the batch (n,)."""
    diagonal = np.abs(np.diagonal(stiffness, axis1=-2, axis2=-1))
    return np.asarray(diagonal.reshape(-1, diagonal.shape[-1]).max(axis=0))


def _hermitian(matrix: Matrix) -> bool:
    size = np.abs(matrix)
    difference = np.abs(matrix - np.swapaxes(matrix.conj(), -1, -2))
    row_size = np.maximum(size.max(axis=-1), size.max(axis=-2))
    return bool(
        (difference <= ROUNDING * np.maximum(row_size[..., None], row_size[..., None, :])).all()
    )


def _real_if_so(matrix: Matrix) -> Matrix:
    return matrix.real if np.iscomplexobj(matrix) and not matrix.imag.any() else matrix
