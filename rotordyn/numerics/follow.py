"""Follow vectors through a sweep: who at this step is who at the last one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Complex = NDArray[np.complex128]
LEAST_LIKENESS = 0.2


def likeness(a: Complex, b: Complex) -> NDArray[np.float64]:
    """|aᴴ b|² / (|a|² |b|²) of the columns of a (n, k) and b (n, l): 1 alike, 0 orthogonal."""
    inner = np.abs(a.conj().T @ b) ** 2
    return inner / (
        np.einsum("ik,ik->k", np.abs(a), np.abs(a))[:, None]
        * np.einsum("il,il->l", np.abs(b), np.abs(b))
    )


def follow(vectors: list[Complex], values: list[NDArray[np.float64]]) -> NDArray[np.intp]:
    """For every vector of the first step, its column at every step, −1 where it is lost.

    ``vectors``: one (n, k_s) array per step; ``values`` (k_s,): ties between vectors equally alike
    go to the nearer value. The most alike pairs are matched first, each vector once.
    """
    start = vectors[0].shape[1]
    path = np.full((len(vectors), start), -1, dtype=np.intp)
    path[0] = np.arange(start)
    last, at = vectors[0], values[0].copy()
    for step in range(1, len(vectors)):
        if not vectors[step].shape[1]:
            continue
        score = likeness(last, vectors[step])
        distance = np.abs(values[step] - at[:, None])
        score = score - 0.3 * distance / (np.abs(at[:, None]) + np.abs(values[step]) + 1e-300)
        path[step] = _matched(score)
        found = path[step] >= 0
        last = last.copy()
        last[:, found] = vectors[step][:, path[step][found]]
        at[found] = values[step][path[step][found]]
    return path


def _matched(score: NDArray[np.float64]) -> NDArray[np.intp]:
    """Greedy matching of rows to columns, best score first."""
    partner = np.full(score.shape[0], -1, dtype=np.intp)
    left = score.copy()
    for _ in range(min(score.shape)):
        row, column = np.unravel_index(int(left.argmax()), left.shape)
        if left[row, column] < LEAST_LIKENESS:
            break
        partner[row] = column
        left[row, :] = -np.inf
        left[:, column] = -np.inf
    return partner
