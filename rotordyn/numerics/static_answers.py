"""Static answers that complete a few modes: to loads, and to what couplings make of these modes."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.numerics.sparse import Matrix

Array = NDArray[np.float64]
UP_TO = 0.5  # of the cutoff: forces that couplings make of modes up to there are answered
NEW = 1e-5  # of its length: a vector that adds less to the others is spanned by them
CANCELLED = 1e-12  # of its summands: what is left of a force then is rounding


class Made(NamedTuple):
    """``forces`` (n, k), of which the mixtures f of an energy f K⁻¹ f of ``least`` or more are to
    be answered."""

    forces: Array
    least: float


class Coupling(NamedTuple):
    """Forces that ``matrix`` (n, n), such as the gyroscopic one, makes of motions of ω ≤ ``band``.

    They are answered from an energy of ``least`` on, all of them with 0. Modes above the band take
    less part in such motions, as the square of their frequency, and so their forces count.
    """

    matrix: Matrix
    least: float = 0.0
    band: float = math.inf

    def made(self, modes: Array, values: Array) -> Made:
        """Those by each of some modes (n, k) of ``values`` ω² (k,), but what is rounding."""
        force = self.matrix @ modes
        size = (abs(self.matrix) @ np.abs(modes)).max(axis=0)
        clear = np.abs(force).max(axis=0) > CANCELLED * size
        if self.least:
            force = force * (self.band**2 / np.maximum(values, self.band**2))
        return Made(force[:, clear], self.least)


class Answers(NamedTuple):
    """Static answers ``vectors`` (n, l), K times them ``forces`` (n, l), and the ``share`` (r, l)
    that other modes have in them."""

    vectors: Array
    forces: Array
    share: Array

    def mixed(self, turn: Array) -> Answers:
        """Mixtures of them, the columns of ``turn`` (l, k)."""
        return Answers(*(part @ turn for part in self))

    def beside(self, others: Answers) -> Answers:
        """With others behind them."""
        both = zip(self, others, strict=True)
        return Answers(*(np.concatenate(parts, axis=1) for parts in both))

    def diagonal(self) -> tuple[Array, Answers]:
        """Mixtures, still M-orthonormal, on which K is diagonal, and its values (l,), ascending."""
        inner = self.vectors.T @ self.forces
        values, turn = np.linalg.eigh((inner + inner.T) / 2.0)
        return values, self.mixed(turn)


def made_of_lowest(
    couplings: Sequence[Coupling], modes: Array, values: Array, cutoff: float, fewest: int
) -> list[Made]:
    """What ``couplings`` make of the lowest modes, of ``fewest`` at least."""
    lowest = slice(max(int(np.searchsorted(values, (UP_TO * cutoff) ** 2)), fewest))
    return [each.made(modes[:, lowest], values[lowest]) for each in couplings]


def completing(
    mass: Matrix,
    known: tuple[Array, Array],
    answered: Callable[[Array], Answers],
    loads: Array,
    made: Sequence[Made],
) -> Answers:
    """What the answers to ``loads`` (n, l), and to forces ``made`` of modes, add to these: as
    ``added``.

    ``known``: the modes and K times them (n, k); ``answered``: the answers to loads (n, l).
    """
    answers = answered(loads)
    found = added(mass, known, answers)
    for forces, least in made:
        if forces.size and least < math.inf:
            more = answered(forces)
            answers = answers.beside(more.mixed(_worth_it(found, more, least)))
            found = added(mass, known, answers)
    return found


def _worth_it(known: Answers, more: Answers, least: float) -> Array:
    """Mixtures (l, k) of ``more`` answers whose forces have an energy of ``least`` or more, without
    what the ``known`` answers hold of it."""
    energy, across = more.vectors.T @ more.forces, known.vectors.T @ more.forces
    energy = energy - across.T @ np.linalg.solve(known.vectors.T @ known.forces, across)
    values, turn = np.linalg.eigh((energy + energy.T) / 2.0)
    return np.asarray(turn[:, values >= least])


def added(mass: Matrix, known: tuple[Array, Array], answers: Answers, new: float = NEW) -> Answers:
    """M-orthonormal span of what ``answers`` add to the vectors ``known``, likewise with K times
    them. What adds less than ``new`` is rounding, and dropped."""
    low, low_forces = known
    vectors, forces, share = answers
    size = _norms(mass, vectors)
    vectors, forces, share = vectors / size, forces / size, share / size
    for _ in range(2):
        within = low.T @ (mass @ vectors)
        vectors = vectors - low @ within
        forces = forces - low_forces @ within
        size = _norms(mass, vectors)
        clear = size > new  # small ones may still differ much
        vectors, forces, share = (a[:, clear] / size[clear] for a in (vectors, forces, share))
        values, turn = np.linalg.eigh(vectors.T @ mass @ vectors)
        keep = values > new**2
        turn = turn[:, keep] / np.sqrt(values[keep])
        vectors, forces, share = vectors @ turn, forces @ turn, share @ turn
    return Answers(vectors, forces, share)


def _norms(mass: Matrix, vectors: Array) -> Array:
    return np.sqrt(np.maximum(np.einsum("ij,ij->j", vectors, mass @ vectors), 0.0))
