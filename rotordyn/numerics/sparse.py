"""Sparse matrices: dense arrays while they are small, compressed rows where they are large.

Both have ``@``, ``.T``, ``+``, ``.diagonal()`` and ``.shape``; what they do not share is here.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from rotordyn.arrays import Array, Indices

Matrix = Any  # Array, or csr_array of scipy.sparse
Part = tuple[Indices, Indices, Array]
LARGE = 300  # DOF from which Lanczos finds a few modes in compressed rows faster than LAPACK all


def summed(shape: tuple[int, int], parts: Iterable[Part], *, large: bool) -> Matrix:
    """Return the sum of blocks (…, r, c) at rows (…, r) and columns (…, c)."""
    if not large:
        total = np.zeros(shape)
        for rows, columns, blocks in parts:
            np.add.at(total, (rows[..., :, None], columns[..., None, :]), blocks)
        return total
    from scipy.sparse import coo_array

    none = np.zeros(0, dtype=np.intp)
    row, column, value = [none], [none], [np.zeros(0)]
    for rows, columns, blocks in parts:
        filled = blocks != 0.0
        row.append(np.broadcast_to(rows[..., :, None], blocks.shape)[filled])
        column.append(np.broadcast_to(columns[..., None, :], blocks.shape)[filled])
        value.append(blocks[filled])
    places = np.concatenate(row), np.concatenate(column)
    return coo_array((np.concatenate(value), places), shape=shape).tocsr()
