"""Follow vectors through a sweep: who at this step is who at the last one."""

from __future__ import annotations

import math

import numpy as np

from rotordyn.arrays import Array, Complex, Flags, Indices

LEAST_MAC = 0.2
NEARNESS = 0.3  # of the MAC that the farthest value costs
CLEAR = 0.7  # MAC from which a vector is known again
FAR = 1e3  # ratio of root gaps from which they tell nothing
REPEATED = 1e-6  # of a value: nearer ones share their vectors
TOUCHING = 3e-6  # of a value: a crossing met so closely is one


def mac(a: Complex, b: Complex) -> Array:
    """|aᴴ b|² / (|a|² |b|²) of the columns of a (n, k) and b (n, l): 1 alike, 0 orthogonal."""
    inner = np.abs(a.conj().T @ b) ** 2
    return inner / (
        np.einsum("ik,ik->k", np.abs(a), np.abs(a))[:, None]
        * np.einsum("il,il->l", np.abs(b), np.abs(b))
    )


def follow(
    vectors: list[Complex], values: list[Array], ahead: list[Array] | None = None
) -> Indices:
    """Paths through the steps: column of each path at every step (steps, paths), −1 where absent.

    ``vectors``: one (n, k_s) array per step; ``values`` (k_s,); ``ahead`` (k_s,): what they are
    expected to be at the next step, the same if left out. Of vectors equally alike the one nearest
    to that is taken. The most alike pairs are matched first, each vector once; a vector that nobody
    claims begins a path of its own. Vectors of repeated values are any basis of what they span:
    each is like all that this space holds.
    """
    last, at = np.zeros((vectors[0].shape[0], 0), dtype=complex), np.zeros(0)
    before, rows, known = np.zeros(0), list[Indices](), _consecutive(vectors, values)
    for k, (fresh, value, expected) in enumerate(
        zip(vectors, values, ahead or values, strict=True)
    ):
        if k and (rows[-1] >= 0).all():
            alike = known[k - 1, rows[-1], : len(value)]
        else:
            alike = _shared(last, before, fresh, value)
        column = _partners(alike, at, value)
        matched = column >= 0
        new = np.ones(fresh.shape[1], dtype=bool)
        new[column[matched]] = False
        born = np.flatnonzero(new)
        rows.append(np.append(column, born))
        last, at, before = last.copy(), at.copy(), before.copy()
        last[:, matched], at[matched] = fresh[:, column[matched]], expected[column[matched]]
        before[matched] = value[column[matched]]
        last, at = np.concatenate([last, fresh[:, born]], axis=1), np.append(at, expected[born])
        before = np.append(before, value[born])
    path = np.full((len(rows), len(at)), -1, dtype=np.intp)
    for step, row in enumerate(rows):
        path[step, : len(row)] = row
    return path


def _partners(alike: Array, at: Array, value: Array) -> Indices:
    """Which of the fresh ones of ``value`` (l,) each of the last has become (k,), −1 for none.

    ``alike`` (k, l): their MAC; ``at`` (k,): what values of the last are expected to be now.
    """
    distance = np.abs(value - at[:, None])
    apart = distance / (np.abs(at[:, None]) + np.abs(value) + 1e-300)
    return matched(alike - NEARNESS * apart, LEAST_MAC)


def _consecutive(vectors: list[Complex], values: list[Array]) -> Array:
    """MAC of every step with the next (steps − 1, k, k), filled up with zeros."""
    most, steps = max(len(value) for value in values), len(values)
    whole = np.zeros((steps, len(vectors[0]), most), dtype=complex)
    every = np.full((steps, most), np.nan)
    for k, (vector, value) in enumerate(zip(vectors, values, strict=True)):
        whole[k, :, : len(value)], every[k, : len(value)] = vector, value
    size = np.sqrt((whole.real**2 + whole.imag**2).sum(axis=1, keepdims=True))
    whole /= np.where(size > 0.0, size, 1.0)
    inner = np.swapaxes(whole[:-1].conj(), 1, 2) @ whole[1:]
    alike = np.minimum(inner.real**2 + inner.imag**2, 1.0)
    pairs = np.abs(every[:, :, None] - every[:, None]) <= REPEATED * np.abs(every)[:, None]
    repeated = pairs.sum(axis=(1, 2)) > np.isfinite(every).sum(axis=1)
    for step in np.flatnonzero(repeated[:-1] | repeated[1:]):
        here, there = values[step], values[step + 1]
        shared = _shared(vectors[step], here, vectors[step + 1], there)
        alike[step, : len(here), : len(there)] = shared
    return np.asarray(alike)


def _shared(last: Complex, before: Array, fresh: Complex, value: Array) -> Array:
    """MAC of columns (k, l), those of repeated values together."""
    one, other = (np.abs(v[:, None] - v) <= REPEATED * np.abs(v) for v in (before, value))
    alike = mac(_spanning(last, one), _spanning(fresh, other))
    return np.minimum(one @ alike @ other, 1.0)


def _spanning(vectors: Complex, repeated: Flags) -> Complex:
    """Vectors (n, k), those of ``repeated`` values (k, k) as an orthonormal basis of their span."""
    groups = {tuple(np.flatnonzero(row)) for row in repeated if row.sum() > 1}
    if groups:
        vectors = vectors.copy()
    for group in groups:
        vectors[:, group] = np.linalg.qr(vectors[:, group])[0]
    return vectors


def doubts(
    at: Array, vectors: list[Complex], values: list[Array], within: float, narrowest: float
) -> list[float]:
    """Places between the steps ``at`` (steps,) where another one would tell who is who.

    Where a vector with a value below ``within`` is like no single one of the next step, as in a
    veering, the nearer to a step the closer values are there; and where two that stay themselves
    change their order, at the crossing, until it is met so closely that a veering as narrow would
    show. No step becomes smaller than ``narrowest``.
    """
    wanted, alike = [], _consecutive(vectors, values)
    for k in np.flatnonzero(np.diff(at) > 2.0 * narrowest):
        one, other = values[k : k + 2]
        share = _doubt(alike[k, : len(one), : len(other)], one, other, within)
        if share is not None:
            room = narrowest / (at[k + 1] - at[k])
            wanted.append(float(at[k] + (at[k + 1] - at[k]) * np.clip(share, room, 1.0 - room)))
    return wanted


def _doubt(alike: Array, one: Array, other: Array, within: float) -> float | None:
    """Where between two steps of values (k,), (l,) and MAC (k, l) to look, as a share of the way;
    None where all is clear."""
    if not alike.size:
        return None
    unclear = [
        np.flatnonzero((alike.max(axis=1 - side) < CLEAR) & (value < within))
        for side, value in enumerate((one, other))
    ]
    if unclear[0].size or unclear[1].size:
        return _veering([one, other], unclear)
    return _crossing(one, other[alike.argmax(axis=1)], one < within)


def _veering(values: list[Array], unclear: list[Indices]) -> float:
    """A place whose distance to its neighbours is to be the mean, in ratio, of what it is at the
    two steps: vectors change where it is small. Half-way where one only comes or goes."""
    if not (unclear[0].size and unclear[1].size):
        return 0.5
    gaps = []
    for value, unclear_at in zip(values, unclear, strict=True):
        apart = np.abs(value[unclear_at, None] - value)
        apart[np.arange(len(unclear_at)), unclear_at] = np.inf
        gaps.append(math.sqrt(float(apart.min(initial=1e300))))
    if max(gaps) >= FAR * min(gaps):  # also where both are none
        return 0.5
    return gaps[0] / (gaps[0] + gaps[1])


def _crossing(one: Array, other: Array, wanted: Flags) -> float | None:
    """Where the first two values that change their order meet, if no step is there yet."""
    before, after = one[:, None] - one, other[:, None] - other
    size = np.minimum(np.abs(one), np.abs(other))
    apart = np.minimum(np.abs(before), np.abs(after)) > TOUCHING * size
    swapped = (before * after < 0.0) & apart & wanted[:, None] & wanted
    if not swapped.any():
        return None
    share = before / np.where(swapped, before - after, 1.0)
    return float(share[swapped].min())


def matched(score: Array, least: float) -> Indices:
    """Column of each row (rows,) by greedy matching, best ``score`` (rows, columns) first; −1 where
    none of ``least`` is left."""
    partner = np.full(score.shape[0], -1, dtype=np.intp)
    if not score.size:
        return partner
    best = score.argmax(axis=1)
    if len(set(best.tolist())) == len(best) and score.max(axis=1).min() >= least:
        return best  # each its own
    left = score.copy()
    for _ in range(min(score.shape)):
        row, column = np.unravel_index(int(left.argmax()), left.shape)
        if left[row, column] < least:
            break
        partner[row] = column
        left[row, :] = -np.inf
        left[:, column] = -np.inf
    return partner
