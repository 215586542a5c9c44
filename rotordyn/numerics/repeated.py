"""Vectors of repeated values: any basis of what they span is as good as any other."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array, Complex, Flags, Indices

REPEATED = 1e-6  # of a value: nearer ones share their vectors


def near(values: Array | Complex) -> Flags:
    """Which of the values (…, k) are so near as to be one, themselves among them (…, k, k)."""
    here, there = values[..., :, None], values[..., None, :]
    return np.asarray(np.abs(here - there) <= REPEATED * np.abs(here))


def joined(values: Array | Complex) -> Flags:
    """Which of the values (k,) are one, or are so by those between them (k, k)."""
    found = near(values)
    found |= found.T
    while (found @ found != found).any():
        found = found @ found
    return found


def groups(values: Array | Complex) -> list[Indices]:
    """Places of repeated values among all (k,), each once."""
    same = joined(values)
    return [np.flatnonzero(row) for row in np.unique(same[same.sum(axis=1) > 1], axis=0)]


def spanning(vectors: Complex, values: Array) -> Complex:
    """Vectors (n, k), those of repeated ``values`` (k,) as an orthonormal basis of their span."""
    vectors = vectors.copy()
    for group in groups(values):
        vectors[:, group] = np.linalg.qr(vectors[:, group])[0]
    return vectors


def as_beside(at: Array, poles: Complex, vectors: Complex) -> Complex:
    """Vectors (steps, n, paths) of ``poles`` (steps, paths) at ``at`` (steps,); those of a repeated
    pole as an orthogonal basis of their span, turned as near as may be to the vectors of the
    nearest step where all of them have poles of their own, and as they are where there is none.

    So shapes and whirl at rest are those of slow rotation, whatever rounding has made of them.
    """
    present = ~np.isnan(poles)
    repeats = near(poles).sum(axis=(1, 2)) > present.sum(axis=1)
    vectors = vectors.copy() if repeats.any() else vectors
    for step in np.flatnonzero(repeats).tolist():
        for group in groups(poles[step]):
            alone = near(poles[:, group]).sum(axis=(1, 2)) == len(group)
            parted = np.flatnonzero(alone & present[:, group].all(axis=1))
            if parted.size:
                beside = parted[np.abs(at[parted] - at[step]).argmin()]
                basis, length = np.linalg.qr(vectors[step][:, group])
                turn, _, back = np.linalg.svd(basis.conj().T @ vectors[beside][:, group])
                vectors[step][:, group] = abs(length[0, 0]) * basis @ (turn @ back)
    return vectors
