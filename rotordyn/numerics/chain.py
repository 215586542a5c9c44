"""A chain of nodes with two freedoms each, eliminated exactly at many frequencies at once.

A ``Piece`` is a part of the chain seen at its two ends: a matrix (2, 2, f) from each end to each.
Two pieces become one as the node between them is eliminated; parts that are alike are so once.
Matrices need not be symmetric.
"""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Values = NDArray[np.inexact[Any]]
Keys = tuple[Hashable, ...]
PLAIN = None  # the name of a node to which nothing is added


class Piece(NamedTuple):
    """Forces on the ends by their motion, each (2, 2, f): ``front`` and ``rear`` on themselves,
    ``ahead`` on the front end by the rear one, ``behind`` the other way."""

    front: Values
    ahead: Values
    behind: Values
    rear: Values

    @classmethod
    def of(cls, matrix: Values) -> Piece:
        """Of an element's matrix (4, 4, f)."""
        a, b = slice(2), slice(2, 4)
        return cls(matrix[a, a], matrix[a, b], matrix[b, a], matrix[b, b])


@dataclass(frozen=True, eq=False, slots=True)
class _Part:
    """A piece; of two joined their names, and the inverse at the node between them."""

    piece: Piece
    halves: tuple[Keys, Keys] | None = None
    inverse: Values | None = None


@dataclass(eq=False, slots=True)
class Chain:
    """Elements by name in ``order``, and matrices (2, 2, f or 1) added ``at`` nodes.

    Nodes ``kept``, ascending, stay; all others are eliminated. ``doubt`` (f,): how much larger than
    their sum the terms of a pivot were at most; digits are lost where a part by itself resonates.
    """

    pieces: Mapping[Hashable, Piece]
    order: Sequence[Hashable]
    at: Mapping[int, Values]
    kept: Sequence[int]
    doubt: Array
    _known: dict[Keys, _Part] = field(default_factory=dict)

    def condensed(self) -> Values:
        """Forces on the kept nodes by their motion (kept, 2, kept, 2, f)."""
        spans = [self._part(self._keys(a, b)).piece for a, b in pairwise(self.kept)]
        own = {k: [self.at[node]] for k, node in enumerate(self.kept) if node in self.at}
        for end in self._ends():
            own.setdefault(end.place, []).append(end.added)
        every = [*(m for each in own.values() for m in each), *(p.front for p in spans)]
        size = len(self.kept)
        whole = np.zeros((size, 2, size, 2, len(self.doubt)), np.result_type(float, *every))
        for k, added in own.items():
            whole[k, :, k] += sum(added)
        for k, piece in enumerate(spans):
            whole[k, :, k] += piece.front
            whole[k + 1, :, k + 1] += piece.rear
            whole[k, :, k + 1] = piece.ahead
            whole[k + 1, :, k] = piece.behind
        return whole

    def motion(self, moved: Values, wanted: Collection[int]) -> Iterator[tuple[int, Values]]:
        """Motion (2, …, f) of each node ``wanted``, of the kept ones moving by (kept, 2, …, f)."""
        for k, node in enumerate(self.kept):
            if node in wanted:
                yield node, moved[k]
        spans = [(a, b, moved[k], moved[k + 1]) for k, (a, b) in enumerate(pairwise(self.kept))]
        for end in self._ends():
            free, at = _times(end.follows, moved[end.place]), moved[end.place]
            if end.node in wanted:
                yield end.node, free
            if end.place == 0 and end.node < self.kept[0]:
                spans.append((end.node, self.kept[0], free, at))
            else:
                spans.append((self.kept[-1], end.node, at, free))
        for a, b, front, rear in spans:
            inside = {node for node in wanted if a < node < b}
            yield from self._inside(self._keys(a, b), a, front, rear, inside)

    def _ends(self) -> Iterator[_End]:
        """The free ends of the chain, where they are not kept."""
        last = len(self.order)
        if self.kept[0] > 0:
            front, ahead, behind, rear = self._part(self._keys(0, self.kept[0])).piece
            inverse = self._inverse(front + self.at[0] if 0 in self.at else front)
            follows = -_product(inverse, ahead)
            yield _End(0, 0, follows, rear + _product(behind, follows))
        if self.kept[-1] < last:
            front, ahead, behind, rear = self._part(self._keys(self.kept[-1], last)).piece
            inverse = self._inverse(rear + self.at[last] if last in self.at else rear)
            follows = -_product(inverse, behind)
            yield _End(last, len(self.kept) - 1, follows, front + _product(ahead, follows))

    def _keys(self, a: int, b: int) -> Keys:
        """Elements and, between them, nodes from node ``a`` to node ``b``."""
        inner = [(node if node in self.at else PLAIN) for node in range(a + 1, b)]
        names: list[Hashable] = [self.order[a]]
        for node, element in zip(inner, self.order[a + 1 : b], strict=True):
            names += [node, element]
        return tuple(names)

    def _part(self, keys: Keys) -> _Part:
        if keys not in self._known:
            self._known[keys] = self._made(keys)
        return self._known[keys]

    def _made(self, keys: Keys) -> _Part:
        if len(keys) == 1:
            return _Part(self.pieces[keys[0]])
        cut = _cut(keys)
        halves = keys[:cut], keys[cut + 1 :]
        left, right = (self._part(half).piece for half in halves)
        between = left.rear + right.front
        if keys[cut] is not PLAIN:
            between = between + self.at[keys[cut]]  # type: ignore[index]
        inverse = self._inverse(between)
        ahead, behind = _product(left.ahead, inverse), _product(right.behind, inverse)
        piece = Piece(
            left.front - _product(ahead, left.behind),
            -_product(ahead, right.ahead),
            -_product(behind, left.behind),
            right.rear - _product(behind, right.ahead),
        )
        return _Part(piece, halves, inverse)

    def _inverse(self, matrix: Values) -> Values:
        """Of a batch (2, 2, f), its doubt noted."""
        (a, b), (c, d) = matrix
        ad, bc = a * d, b * c
        whole = ad - bc
        np.maximum(self.doubt, (np.abs(ad) + np.abs(bc)) / np.abs(whole), out=self.doubt)
        found = np.empty_like(matrix)
        np.divide(d, whole, out=found[0, 0])
        np.divide(a, whole, out=found[1, 1])
        np.divide(b, -whole, out=found[0, 1])
        np.divide(c, -whole, out=found[1, 0])
        return found

    def _inside(
        self, keys: Keys, first: int, front: Values, rear: Values, wanted: Collection[int]
    ) -> Iterator[tuple[int, Values]]:
        """Motion of the nodes ``wanted`` inside a part that begins at node ``first``."""
        part = self._part(keys)
        if not wanted or part.halves is None or part.inverse is None:
            return
        left, right = (self._part(half).piece for half in part.halves)
        force = _times(left.behind, front) + _times(right.ahead, rear)
        between, node = -_times(part.inverse, force), first + (len(part.halves[0]) + 1) // 2
        if node in wanted:
            yield node, between
        lower, upper = {n for n in wanted if n < node}, {n for n in wanted if n > node}
        yield from self._inside(part.halves[0], first, front, between, lower)
        yield from self._inside(part.halves[1], node, between, rear, upper)


class _End(NamedTuple):
    """A free end: its ``node``, the ``place`` of the kept node before it, how it ``follows`` that
    one, and what it ``added`` there."""

    node: int
    place: int
    follows: Values
    added: Values


def _cut(keys: Keys) -> int:
    """Where to divide: between parts that differ, else in the middle, so that halves recur."""
    middle = len(keys) // 2
    nodes = range(1, len(keys), 2)
    apart = [k for k in nodes if keys[k] is not PLAIN or keys[k - 1] != keys[k + 1]]
    return min(apart or nodes, key=lambda k: abs(k - middle))


def _product(a: Values, b: Values) -> Values:
    """Of two batches of matrices (2, 2, f)."""
    return np.asarray(a[:, :1] * b[0] + a[:, 1:] * b[1])


def _times(a: Values, x: Values) -> Values:
    """A batch of matrices (2, 2, f) times vectors (2, …, f)."""
    wide = (slice(None), *(None for _ in x.shape[2:]))
    return np.asarray(a[:, 0][wide] * x[0] + a[:, 1][wide] * x[1])


def without_inner(matrix: Values, ends: int, doubt: Array) -> Values:
    """A batch (k, k, f) without all but its first ``ends`` freedoms, one after another.

    ``doubt`` (f,) is raised by that of the pivots. ``matrix`` is overwritten.
    """
    inner = range(ends, len(matrix))
    size = np.abs(matrix[inner, inner])
    for p in reversed(inner):
        pivot = matrix[p, p]
        np.maximum(doubt, size[p - ends] / np.abs(pivot), out=doubt)
        matrix[:p, :p] -= matrix[:p, p, None] * (matrix[p, :p] / pivot)
    return matrix[:ends, :ends]
