"""Motions that rigid supports allow, and that very stiff links do not strain: R q = 0 is solved.

In coordinates of unit mass and stiffness ω², rigid motions of a body (ω = 0) follow its elastic
ones as far as they can, q_r = −R_r⁺ R_e q_e, which costs no energy; what then is left of R holds
elastic motions, taken in the measure ω q_e. The basis is the left singular vectors of these
motions: orthonormal, slow motions first, which keep their digits however stiff the rest is.

Theory: docs/theory/supports.md#linear-supports.
"""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np

from rotordyn.arrays import Array, Matrix

DEPENDENT = 1e-10  # of the largest: a constraint with less follows from the others
HELD = 1e-12  # of a row: what is left of one that rigid supports hold is rounding
T = TypeVar("T", bound=Matrix)


def allowed_motions(rows: Array, stiffness: Array) -> Array:
    """Orthonormal basis (n, m) of the coordinates q with ``rows`` (c, n) q = 0.

    ``stiffness`` ω² (n,) [rad²/s²] of the coordinates by themselves, 0 of rigid motions. Rows that
    follow from others hold nothing more.
    """
    rows = rows / np.abs(rows).max(axis=1, keepdims=True)
    first = np.argmax(np.abs(rows) > 0.5, axis=1)
    rows = rows * np.sign(rows[np.arange(len(rows)), first])[:, None]  # alike in both planes
    free = stiffness <= 0.0
    ways, size, turn = np.linalg.svd(rows[:, free])
    rank = int((size > DEPENDENT).sum())
    follow = -turn[:rank].T @ ((ways[:, :rank] / size[:rank]).T @ rows[:, ~free])
    soft = np.sqrt(stiffness[~free].min(initial=np.inf) / stiffness[~free])
    _, size, further = np.linalg.svd(ways[:, rank:].T @ rows[:, ~free], full_matrices=False)
    further = (size[:, None] * further)[size > DEPENDENT]  # what is left of the others is rounding
    elastic = soft[:, None] * _null_space(further * soft)
    motions = np.zeros((len(stiffness), elastic.shape[1]))
    motions[free], motions[~free] = follow @ elastic, elastic
    still = np.zeros((len(stiffness), turn.shape[0] - rank))
    still[free] = turn[rank:].T
    basis = np.hstack([still, np.linalg.svd(motions, full_matrices=False)[0]])
    _, size, held = np.linalg.svd(rows, full_matrices=False)
    held = held[size > DEPENDENT * size.max(initial=0.0)]  # fast motions have lost digits
    return np.asarray(np.linalg.qr(basis - held.T @ (held @ basis))[0])


def strained_motions(still: Array, allowed: Array, rows: Array) -> Array:
    """What completes ``still`` (n, k), motions that do not strain the links ``rows`` (c, n), to the
    span of ``allowed`` (n, m): (n, m − k), each strains one more of the links than those before."""
    ways, size, _ = np.linalg.svd(allowed - still @ (still.T @ allowed), full_matrices=False)
    others = ways[:, size > 0.5]  # σ is 0 or 1
    return np.asarray(others @ np.linalg.qr((rows @ others).T, mode="complete")[0])


def along(rows: T, allowed: Array) -> T:
    """Forces or displacements ``rows`` (…, n) in the motions ``allowed`` (n, m): (…, m), zero of
    such as the supports hold."""
    left: Any = rows @ allowed  # of the type of ``rows``
    size, whole = (np.abs(each).max(axis=-1, initial=0.0) for each in (left, rows))
    left[size <= HELD * whole] = 0.0
    return left


def _null_space(rows: Array) -> Array:
    """(n, m) of rows (c, n)."""
    _, size, turn = np.linalg.svd(rows)
    return np.asarray(turn[int((size > DEPENDENT * size.max(initial=0.0)).sum()) :].T)
