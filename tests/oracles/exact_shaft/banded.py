"""Many banded matrices at once, in the storage of LAPACK with room for its pivots.

A batch is an array (…, size, 3·half + 1): entry (i, j) of a matrix stands in row j, place
2·half + i − j, so that each matrix transposed is what LAPACK factorises in place.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Complex = NDArray[np.complex128]
Places = NDArray[np.intp]


def empty(batch: tuple[int, ...], size: int, half: int) -> Complex:
    """Zero matrices with ``half`` diagonals on either side of the main one."""
    return np.zeros((*batch, size, 3 * half + 1), dtype=complex)


def place(banded: Complex, blocks: NDArray[Any], row: Places, column: Places) -> None:
    """Write blocks (…, k, r, c) with their upper left corners at (row, column) (k,)."""
    half = (banded.shape[-1] - 1) // 3
    down, across = np.indices(blocks.shape[-2:])
    i = row[:, None, None] + down
    j = column[:, None, None] + across
    banded[..., j, 2 * half + i - j] = blocks


def times(banded: Complex, x: Complex) -> Complex:
    """Products with one vector each (…, size)."""
    half, size = (banded.shape[-1] - 1) // 3, banded.shape[-2]
    product = np.zeros(np.broadcast_shapes(banded.shape[:-1], x.shape), dtype=complex)
    for shift in range(-half, half + 1):  # row minus column
        columns = slice(max(0, -shift), min(size, size - shift))
        rows = slice(columns.start + shift, columns.stop + shift)
        product[..., rows] += banded[..., columns, 2 * half + shift] * x[..., columns]
    return product


def solve(banded: Complex, right: Complex) -> Complex:
    """Solutions (k, size, m) of a batch (k, size, …), one factorisation for all m right sides.

    ``right`` (k, size, m), or (size, m) for all alike. A matrix singular to the last bit gives
    infinite values. ``banded`` is overwritten.
    """
    from scipy.linalg.lapack import zgbsv

    half = (banded.shape[-1] - 1) // 3
    right = np.broadcast_to(right, (len(banded), *right.shape[-2:]))
    found = np.empty(right.shape, dtype=complex)
    for k, matrix in enumerate(banded):
        _, _, found[k], singular = zgbsv(half, half, matrix.T, right[k], overwrite_ab=True)
        if singular:
            found[k] = np.inf
    return found


def phases(banded: Complex) -> NDArray[np.float64]:
    """Argument of each determinant of a batch (k,) [rad]; NaN where it is zero.

    ``banded`` is overwritten.
    """
    from scipy.linalg.lapack import zgbtrf

    half, size = (banded.shape[-1] - 1) // 3, banded.shape[-2]
    found = np.empty(len(banded))
    for k, matrix in enumerate(banded):
        factors, pivots, singular = zgbtrf(matrix.T, half, half, overwrite_ab=True)
        swaps = int((pivots != np.arange(size)).sum())
        angle = np.angle(factors[2 * half]).sum() + np.pi * swaps
        found[k] = np.nan if singular else angle
    return found
