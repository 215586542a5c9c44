"""Many dense equations with the same right sides, solved at once."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Values = NDArray[np.inexact[Any]]


def solutions(matrices: Values, right: Array) -> Values:
    """Of a batch (n, n, f) and ``right`` (n, e): (n, e, f), infinite where a matrix has no
    inverse."""
    each = np.ascontiguousarray(np.moveaxis(matrices, -1, 0))
    try:
        found = np.linalg.solve(each, right)
    except np.linalg.LinAlgError:
        found = np.stack([_solution(one, right) for one in each])
    return np.ascontiguousarray(np.moveaxis(found, 0, -1))


def _solution(matrix: Values, right: Array) -> Values:
    try:
        return np.asarray(np.linalg.solve(matrix, right))
    except np.linalg.LinAlgError:
        return np.full(right.shape, np.inf + 0j)
