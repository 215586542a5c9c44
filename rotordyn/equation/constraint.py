"""Motions that rigid supports allow, and that very stiff links do not strain: R q = 0 is solved.

In coordinates of unit mass and stiffness ω², rigid motions of a body (ω = 0) follow its elastic
ones as far as they can, q_r = −R_r⁺ R_e q_e, which costs no energy; the remainder of R constrains
elastic motions, scaled as ω q_e. The basis is the left singular vectors of these motions:
orthonormal, slow motions first, which keep their digits however stiff the rest is.

Theory: docs/theory/supports.md#linear-supports.
"""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np

from rotordyn.arrays import Array, Matrix

DEPENDENT = 1e-10  # of the largest singular value: a smaller constraint follows from others
HELD = 1e-12  # of a row: a smaller remainder of one that rigid supports hold is rounding
T = TypeVar("T", bound=Matrix)


def allowed_motions(rows: Array, stiffness: Array) -> Array:
    """Return an orthonormal basis (n, m) of the coordinates q with ``rows`` (c, n) q = 0.

    ``stiffness`` ω² (n,) [rad²/s²] of the coordinates by themselves, 0 of rigid motions. Rows that
    follow from others constrain nothing more.
    """
    rows = rows / np.abs(rows).max(axis=1, keepdims=True)
    first = np.argmax(np.abs(rows) > 0.5, axis=1)
    rows = rows * np.sign(rows[np.arange(len(rows)), first])[:, None]  # the same in both planes
    free = stiffness <= 0.0
    left, size, right = np.linalg.svd(rows[:, free])
    rank = int((size > DEPENDENT).sum())
    follow = -right[:rank].T @ ((left[:, :rank] / size[:rank]).T @ rows[:, ~free])
    soft = np.sqrt(stiffness[~free].min(initial=np.inf) / stiffness[~free])
    _, size, further = np.linalg.svd(left[:, rank:].T @ rows[:, ~free], full_matrices=False)
    further = (size[:, None] * further)[size > DEPENDENT]  # smaller ones are rounding
    elastic = soft[:, None] * _null_space(further * soft)
    motions = np.zeros((len(stiffness), elastic.shape[1]))
    motions[free], motions[~free] = follow @ elastic, elastic
    rigid = np.zeros((len(stiffness), right.shape[0] - rank))
    rigid[free] = right[rank:].T
    basis = np.hstack([rigid, np.linalg.svd(motions, full_matrices=False)[0]])
    _, size, normal = np.linalg.svd(rows, full_matrices=False)
    normal = normal[size > DEPENDENT * size.max(initial=0.0)]  # fast motions have lost digits
    return np.asarray(np.linalg.qr(basis - normal.T @ (normal @ basis))[0])


def strained_motions(still: Array, allowed: Array, rows: Array) -> Array:
    """Return the complement (n, m − k) of ``still`` (n, k), motions that do not strain links
    ``rows`` (c, n), in the span of ``allowed`` (n, m): each strains one more link than the last."""
    left, size, _ = np.linalg.svd(allowed - still @ (still.T @ allowed), full_matrices=False)
    complement = left[:, size > 0.5]  # σ is 0 or 1
    return np.asarray(complement @ np.linalg.qr((rows @ complement).T, mode="complete")[0])


def along(rows: T, allowed: Array) -> T:
    """Return forces or displacements ``rows`` (…, n) in the motions ``allowed`` (n, m): (…, m),
    zero for those that the supports hold."""
    projected: Any = rows @ allowed  # of the type of ``rows``
    size, full = (np.abs(values).max(axis=-1, initial=0.0) for values in (projected, rows))
    projected[size <= HELD * full] = 0.0
    return projected


def _null_space(rows: Array) -> Array:
    """Return the null space (n, m) of rows (c, n)."""
    _, size, right = np.linalg.svd(rows)
    return np.asarray(right[int((size > DEPENDENT * size.max(initial=0.0)).sum()) :].T)
