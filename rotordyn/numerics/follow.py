"""Follow vectors through a sweep: who at this step is who at the last one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Complex = NDArray[np.complex128]
LEAST_LIKENESS = 0.2
NEARNESS = 0.3  # of likeness that the farthest value costs


def likeness(a: Complex, b: Complex) -> NDArray[np.float64]:
    """|aᴴ b|² / (|a|² |b|²) of the columns of a (n, k) and b (n, l): 1 alike, 0 orthogonal."""
    inner = np.abs(a.conj().T @ b) ** 2
    return inner / (
        np.einsum("ik,ik->k", np.abs(a), np.abs(a))[:, None]
        * np.einsum("il,il->l", np.abs(b), np.abs(b))
    )


def follow(vectors: list[Complex], values: list[NDArray[np.float64]]) -> NDArray[np.intp]:
    """Paths through the steps: column of each path at every step (steps, paths), −1 where absent.

    ``vectors``: one (n, k_s) array per step; ``values`` (k_s,): of vectors equally alike the nearer
    value is taken. The most alike pairs are matched first, each vector once; a vector that nobody
    claims begins a path of its own.
    """
    last = np.zeros((vectors[0].shape[0], 0), dtype=complex)
    at = np.zeros(0)
    path = np.zeros((len(vectors), 0), dtype=np.intp)
    for step, (fresh, value) in enumerate(zip(vectors, values, strict=True)):
        if last.shape[1] and fresh.shape[1]:
            distance = np.abs(value - at[:, None])
            apart = distance / (np.abs(at[:, None]) + np.abs(value) + 1e-300)
            column = _matched(likeness(last, fresh) - NEARNESS * apart)
        else:
            column = np.full(last.shape[1], -1, dtype=np.intp)
        found = column >= 0
        born = np.setdiff1d(np.arange(fresh.shape[1]), column[found])
        last[:, found], at[found] = fresh[:, column[found]], value[column[found]]
        last, at = np.concatenate([last, fresh[:, born]], axis=1), np.append(at, value[born])
        path = np.pad(path, ((0, 0), (0, born.size)), constant_values=-1)
        path[step] = np.append(column, born)
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
