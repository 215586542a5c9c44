"""Vectors of repeated values: any basis of what they span is as good as any other."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array, Complex, Flags, Indices

REPEATED = 1e-6  # of a value: nearer ones are known again together, by what their vectors span
EQUAL = 1e-9  # of a pole: nearer ones differ by rounding, and their vectors are any of that span
APART = 0.3  # least singular value of unit vectors that are clearly independent


def near(values: Array | Complex, share: float = REPEATED) -> Flags:
    """Which of the values (…, k) are within a share of one another, themselves among them
    (…, k, k)."""
    here, there = values[..., :, None], values[..., None, :]
    return np.asarray(np.abs(here - there) <= share * np.abs(here))


def joined(values: Array | Complex, share: float = REPEATED) -> Flags:
    """The same of values (k,), also by those between them (k, k)."""
    found = near(values, share)
    found |= found.T
    while (found @ found != found).any():
        found = found @ found
    return found


def groups(values: Array | Complex, share: float = REPEATED) -> list[Indices]:
    """Places of repeated values among all (k,), each once."""
    same = joined(values, share)
    return [np.flatnonzero(row) for row in np.unique(same[same.sum(axis=1) > 1], axis=0)]


def spanning(vectors: Complex, values: Array | Complex) -> Complex:
    """Vectors (n, k), those of repeated ``values`` (k,) as an orthonormal basis of their span."""
    vectors = vectors.copy()
    for group in groups(values):
        vectors[:, group] = np.linalg.qr(vectors[:, group])[0]
    return vectors


def as_beside(at: Array, poles: Complex, vectors: Complex) -> Complex:
    """Vectors (steps, n, paths) of ``poles`` (steps, paths) at ``at`` (steps,); of equal poles what
    their span holds of the vectors at the nearest step where all of them have poles of their own.
    They stay as they are where there is no such step, or where it holds too little of these.

    So shapes and whirl at rest are those of slow rotation, whatever rounding has made of them.
    """
    present = ~np.isnan(poles)
    repeats = near(poles, EQUAL).sum(axis=(1, 2)) > present.sum(axis=1)
    vectors = vectors.copy() if repeats.any() else vectors
    for step in np.flatnonzero(repeats).tolist():
        for group in groups(poles[step], EQUAL):
            alone = near(poles[:, group], EQUAL).sum(axis=(1, 2)) == len(group)
            parted = np.flatnonzero(alone & present[:, group].all(axis=1))
            if not parted.size:
                continue
            here = vectors[step][:, group]
            beside = vectors[parted[np.abs(at[parted] - at[step]).argmin()]][:, group]
            basis = np.linalg.qr(here)[0]
            held = basis.conj().T @ (beside / np.linalg.norm(beside, axis=0))
            if np.linalg.svd(held, compute_uv=False).min() > APART:
                size = np.linalg.norm(here, axis=0) / np.linalg.norm(held, axis=0)
                vectors[step][:, group] = basis @ (size * held)
    return vectors
