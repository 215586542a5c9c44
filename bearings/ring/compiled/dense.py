"""A few linear equations without a library call, which would cost more than the work."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
REGULAR = 1e-14  # of the determinant, with a largest entry of 1


def solve(matrix: Array, right: Array) -> tuple[Array, float]:
    """x of ``matrix`` x = ``right`` by elimination with pivots, and the determinant of the matrix
    over its largest entry; x = 0 where that is singular to rounding."""
    size, largest = len(right), 1e-300
    for i in range(size):
        for j in range(size):
            largest = max(largest, abs(matrix[i, j]))
    a, x, determinant = np.empty((size, size)), np.empty(size), 1.0
    for i in range(size):
        x[i] = right[i] / largest
        for j in range(size):
            a[i, j] = matrix[i, j] / largest
    for k in range(size):
        determinant *= _pivoted(a, x, k)
        _eliminate(a, x, k)
    regular = abs(determinant) > REGULAR
    for k in range(size - 1, -1, -1):
        for j in range(k + 1, size):
            x[k] -= a[k, j] * x[j]
        x[k] = x[k] / a[k, k] if regular else 0.0
    return x, determinant


def _eliminate(a: Array, x: Array, k: int) -> None:
    """Unknown k taken out of the equations below its own."""
    if a[k, k] == 0.0:
        return
    for i in range(k + 1, len(x)):
        factor = a[i, k] / a[k, k]
        x[i] -= factor * x[k]
        for j in range(k + 1, len(x)):
            a[i, j] -= factor * a[k, j]


def _pivoted(a: Array, x: Array, k: int) -> float:
    """Brings the largest entry of column k to row k; returns it, with the sign of the exchange."""
    pivot = k
    for i in range(k + 1, len(x)):
        if abs(a[i, k]) > abs(a[pivot, k]):
            pivot = i
    if pivot == k:
        return a[k, k]
    for j in range(len(x)):
        a[k, j], a[pivot, j] = a[pivot, j], a[k, j]
    x[k], x[pivot] = x[pivot], x[k]
    return -a[k, k]
