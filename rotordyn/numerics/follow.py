"""Following of vectors through a sweep: which one at a step continues which at the last one."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rotordyn.arrays import Array, Complex, Flags, Indices
from rotordyn.numerics.repeated import joined, near, spanning

LEAST_MAC = 0.2  # score below which two vectors are not matched
NEARNESS = 0.3  # of the MAC that the farthest pole costs
CLEAR = 0.7  # MAC from which a vector is identified
FAR = 1e3  # ratio of root gaps from which they locate nothing
TOUCHING = 3e-6  # of a value: a crossing bracketed this closely is one


def mac(a: Complex, b: Complex) -> Array:
    """Return |aᴴ b|² / (|a|² |b|²) of columns a (n, k) and b (n, l): 1 parallel, 0 orthogonal."""
    inner = np.abs(a.conj().T @ b) ** 2
    return inner / (
        np.einsum("ik,ik->k", np.abs(a), np.abs(a))[:, None]
        * np.einsum("il,il->l", np.abs(b), np.abs(b))
    )


@dataclass(frozen=True, eq=False)
class Steps:
    """``vectors`` (steps, n, k) of ``poles`` (steps, k) through a sweep; a step with fewer has them
    first, then vectors of zeros and poles of NaN."""

    vectors: Complex
    poles: Complex

    @cached_property
    def many(self) -> Indices:
        """Number of vectors at each step (steps,)."""
        return np.asarray((~np.isnan(self.poles)).sum(axis=1))

    def of(self, step: int) -> tuple[Complex, Complex]:
        """Return vectors and poles of one step, (n, k) and (k,)."""
        count = self.many[step]
        return self.vectors[step, :, :count], self.poles[step, :count]

    @cached_property
    def alike(self) -> Array:
        """MAC of every step with the next (steps − 1, k, k); zero where either is absent."""
        size = np.sqrt((self.vectors.real**2 + self.vectors.imag**2).sum(axis=1, keepdims=True))
        unit = self.vectors / np.where(size > 0.0, size, 1.0)
        inner = np.swapaxes(unit[:-1].conj(), 1, 2) @ unit[1:]
        alike = np.minimum(inner.real**2 + inner.imag**2, 1.0)
        repeated = near(self.poles).sum(axis=(1, 2)) > self.many
        for step in np.flatnonzero(repeated[:-1] | repeated[1:]).tolist():
            count, next_count = self.many[step], self.many[step + 1]
            alike[step, :count, :next_count] = _shared(*self.of(step), *self.of(step + 1))
        return np.asarray(alike)


def follow(steps: Steps, ahead: Complex | None = None) -> Indices:
    """Return the column of each path through the steps (steps, paths), −1 where absent.

    ``ahead`` (steps, k): poles expected at the next step, unchanged by default. Of vectors with
    equal MAC the one nearest to that is taken. Pairs with the highest score are matched first, each
    vector once; a vector without partner begins a path of its own. Vectors of repeated poles are
    any basis of their space: each is compared with the whole space.
    """
    expected = steps.poles if ahead is None else ahead
    score = _score(steps.alike, expected[:-1], steps.poles[1:])
    last = np.arange(steps.many[0])  # column of each path at the step where it was last seen
    seen, rows = np.zeros(len(last), dtype=np.intp), [last]
    for k in range(1, len(steps.many)):
        fresh, pole = steps.of(k)
        if (seen == k - 1).all():  # no path was lost
            column = matched(score[k - 1, last, : len(pole)], LEAST_MAC)
        else:
            shared = _shared(steps.vectors[seen, :, last].T, steps.poles[seen, last], fresh, pole)
            column = matched(_score(shared, expected[seen, last], pole), LEAST_MAC)
        continues = column >= 0
        new = np.delete(np.arange(len(pole)), column[continues])
        last = np.append(np.where(continues, column, last), new)
        seen = np.append(np.where(continues, k, seen), np.full(len(new), k))
        rows.append(np.append(column, new))
    path = np.full((len(rows), len(last)), -1, dtype=np.intp)
    for step, row in enumerate(rows):
        path[step, : len(row)] = row
    return path


def _score(alike: Array, at: Complex, pole: Complex) -> Array:
    """Return the score (…, k, l) of every pair: the MAC ``alike`` (…, k, l) less the distance of
    ``pole`` (…, l) from the expected ``at`` (…, k): modes may differ in damping alone."""
    pole, at = pole[..., None, :], at[..., None]
    distance = np.abs(pole - at) / (np.abs(at) + np.abs(pole) + 1e-300)
    return np.asarray(alike - NEARNESS * distance)


def _shared(last: Complex, before: Complex, fresh: Complex, pole: Complex) -> Array:
    """Return the MAC of columns (k, l), those of repeated poles together."""
    assurance = mac(spanning(last, before), spanning(fresh, pole))
    return np.minimum(joined(before) @ assurance @ joined(pole), 1.0)


def doubts(at: Array, steps: Steps, within: float, narrowest: float) -> list[float]:
    """Return places between the steps ``at`` (steps,) where another step would identify vectors.

    Where a vector with a frequency below ``within`` has no single partner at the next step, as in a
    veering, nearer to the step with the closer poles; and where the frequencies of two identified
    vectors change their order, at the crossing, until it is bracketed so closely that a veering as
    narrow would show. No step becomes smaller than ``narrowest``.
    """
    assurance, first, second = steps.alike, steps.poles[:-1].imag, steps.poles[1:].imag
    wide = (np.diff(at) > 2.0 * narrowest) & (steps.many[:-1] > 0) & (steps.many[1:] > 0)
    if not wide.any():
        return []
    unclear = [
        (assurance.max(axis=2 - side) < CLEAR) & (frequency < within)
        for side, frequency in enumerate((first, second))
    ]
    veers = wide & (unclear[0].any(axis=1) | unclear[1].any(axis=1))
    after = np.take_along_axis(second, assurance.argmax(axis=2), axis=1)
    share = np.where(wide, _crossings(first, after, first < within), np.inf)
    for k in np.flatnonzero(veers).tolist():
        poles = [steps.of(k)[1], steps.of(k + 1)[1]]
        share[k] = _veering(poles, [np.flatnonzero(flags[k]) for flags in unclear])
    chosen = np.flatnonzero(share < np.inf)
    width, share = np.diff(at)[chosen], share[chosen]
    room = narrowest / width
    places: list[float] = (at[chosen] + width * np.clip(share, room, 1.0 - room)).tolist()
    return places


def _veering(poles: list[Complex], unclear: list[Indices]) -> float:
    """Return the share of a step at which a pole's distance to others is the geometric mean of that
    at both ends: vectors change where it is small. Half-way where one only comes or goes."""
    if not (unclear[0].size and unclear[1].size):
        return 0.5
    gaps = []
    for pole, unclear_at in zip(poles, unclear, strict=True):
        distance = np.abs(pole[unclear_at, None] - pole)
        distance[np.arange(len(unclear_at)), unclear_at] = np.inf
        gaps.append(math.sqrt(float(distance.min(initial=1e300))))
    if max(gaps) >= FAR * min(gaps):  # also where both are none
        return 0.5
    return gaps[0] / (gaps[0] + gaps[1])


def _crossings(one: Array, other: Array, considered: Flags) -> Array:
    """Return the share of each step (steps,) at which the first two values that change their order
    (steps, k) meet; infinite where none do, or where they meet at a step already."""
    before, after = (value[:, :, None] - value[:, None] for value in (one, other))
    size = np.minimum(np.abs(one), np.abs(other))[:, None]
    resolved = np.minimum(np.abs(before), np.abs(after)) > TOUCHING * size
    swapped = (before * after < 0.0) & resolved & considered[:, :, None] & considered[:, None]
    share = np.full(swapped.shape, np.inf)
    np.divide(before, before - after, out=share, where=swapped)
    return np.asarray(share.min(axis=(1, 2), initial=np.inf))


def matched(score: Array, least: float) -> Indices:
    """Return the column of each row (rows,) by greedy matching, best ``score`` (rows, columns)
    first; −1 where none of ``least`` remains."""
    partner = np.full(score.shape[0], -1, dtype=np.intp)
    if not score.size:
        return partner
    best = score.argmax(axis=1)
    if len(set(best.tolist())) == len(best) and score.max(axis=1).min() >= least:
        return best  # one to one already
    remaining = score.copy()
    for _ in range(min(score.shape)):
        row, column = np.unravel_index(int(remaining.argmax()), remaining.shape)
        if remaining[row, column] < least:
            break
        partner[row] = column
        remaining[row, :] = -np.inf
        remaining[:, column] = -np.inf
    return partner
