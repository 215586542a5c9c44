"""Vectors of repeated values, which are an arbitrary basis of their span."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array, Complex, Flags, Indices
from rotordyn.numerics.groups import first_joined

REPEATED = 1e-6  # of a value: closer ones are identified together, by the span of their vectors
EQUAL = 1e-9  # of a pole: closer ones differ by rounding, and their vectors are any of that span
APART = 0.3  # least singular value of unit vectors that are clearly independent


def near(values: Array | Complex, share: float = REPEATED) -> Flags:
    """Return which values (…, k) are within a share of one another (…, k, k), each of itself."""
    rows, columns = values[..., :, None], values[..., None, :]
    return np.asarray(np.abs(rows - columns) <= share * np.abs(rows))


def joined(values: Array | Complex, share: float = REPEATED) -> Flags:
    """Return which values (k,) are as near, also by those between them (k, k)."""
    first = first_joined(near(values, share))
    return np.asarray(first[:, None] == first)


def groups(values: Array | Complex, share: float = REPEATED) -> list[Indices]:
    """Return the indices of repeated values among all (k,), each group once."""
    same = joined(values, share)
    return [np.flatnonzero(row) for row in np.unique(same[same.sum(axis=1) > 1], axis=0)]


def spanning(vectors: Complex, values: Array | Complex) -> Complex:
    """Return vectors (n, k), those of repeated ``values`` (k,) as an orthonormal basis."""
    vectors = vectors.copy()
    for group in groups(values):
        vectors[:, group] = np.linalg.qr(vectors[:, group])[0]
    return vectors


def continued_vectors(at: Array, poles: Complex, vectors: Complex) -> Complex:
    """Return vectors (steps, n, paths) of ``poles`` (steps, paths) at ``at`` (steps,); those of
    equal poles as projections on their span of the vectors at the nearest step where all of them
    have distinct poles. They stay where there is no such step, or where projections are too small.

    So shapes and whirl at rest are those of slow rotation, whatever rounding has made of them.
    """
    present = ~np.isnan(poles)
    repeats = near(poles, EQUAL).sum(axis=(1, 2)) > present.sum(axis=1)
    vectors = vectors.copy() if repeats.any() else vectors
    for step in np.flatnonzero(repeats).tolist():
        for group in groups(poles[step], EQUAL):
            distinct = near(poles[:, group], EQUAL).sum(axis=(1, 2)) == len(group)
            candidates = np.flatnonzero(distinct & present[:, group].all(axis=1))
            if not candidates.size:
                continue
            current = vectors[step][:, group]
            adjacent = vectors[candidates[np.abs(at[candidates] - at[step]).argmin()]][:, group]
            basis = np.linalg.qr(current)[0]
            projected = basis.conj().T @ (adjacent / np.linalg.norm(adjacent, axis=0))
            if np.linalg.svd(projected, compute_uv=False).min() > APART:
                size = np.linalg.norm(current, axis=0) / np.linalg.norm(projected, axis=0)
                vectors[step][:, group] = basis @ (size * projected)
    return vectors
