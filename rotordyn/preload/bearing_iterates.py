"""The bearings of an arrangement, by model and law: solved by themselves, or on the way to balance.

Whoever moves the shaft moves all of them at once, balls included (``bearings.ring.iterate``).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from bearings.ball.law import Law
from bearings.ball.laws import Laws
from bearings.bearing import BallBearing
from bearings.ring.state import BearingState
from rotordyn.arrays import Array, Flags, Indices

if TYPE_CHECKING:
    from bearings.geometry import Geometry
    from bearings.ring.assembly import Assembly


@dataclass(frozen=True, eq=False, slots=True)
class Solved:
    """States of one model and law: which of the places asked for, the batch (speeds, places)."""

    places: list[int]
    state: BearingState


Alike = tuple[BallBearing, Law | Laws]  # bearings that can be solved in one call
States = dict[Alike, Solved]


@dataclass(frozen=True, eq=False, slots=True)
class BearingIterates:
    """By model and law: the places of such bearings, their balls, a batch (speeds, places)."""

    of: dict[Alike, tuple[list[int], Any]]  # ``Iterate``, or ``Settled``

    @classmethod
    def solved(cls, states: States, ring: Callable[[Geometry], Assembly]) -> BearingIterates:
        """Bearings that were solved by themselves; ``ring`` says which of their balls move on."""
        from bearings.ring.iterate import iterate

        return cls({k: (balls.places, iterate(balls.state, ring)) for k, balls in states.items()})

    @classmethod
    def chosen(
        cls,
        states: States,
        bearings: Sequence[int],
        rows: Indices,
        ring: Callable[[Geometry], Assembly],
    ) -> BearingIterates:
        """The same at some of their speeds; which of ``bearings`` solved stands at every place."""
        from bearings.ring.iterate import iterate

        of = {}
        for alike, balls in states.items():
            columns = {bearing: k for k, bearing in enumerate(balls.places)}
            places = [k for k, bearing in enumerate(bearings) if bearing in columns]
            at = np.array([columns[bearings[k]] for k in places])
            of[alike] = places, iterate(balls.state.rows(np.ix_(rows, at)), ring)
        return cls(of)

    def __iter__(self) -> Iterator[tuple[list[int], Any]]:
        return iter(self.of.values())

    def moved(self, displacement: Array) -> BearingIterates:
        """Rings at ``displacement`` (speeds, places, 5), every ball one Newton step on."""
        return BearingIterates(
            {
                k: (places, one.moved(displacement[:, places]))
                for k, (places, one) in self.of.items()
            }
        )

    def at(self, displacement: Array, balls: Sequence[Array]) -> BearingIterates:
        """Rings at ``displacement`` (speeds, places, 5), the balls of each group placed too."""
        return BearingIterates(
            {
                k: (places, one.at(displacement[:, places], ball))
                for (k, (places, one)), ball in zip(self.of.items(), balls, strict=True)
            }
        )

    def follows(self, before: BearingIterates) -> Flags:
        """Speeds at which every ball is still where it can come to from ``before`` (speeds,)."""
        near = [one.follows(before.of[k][1]).all(axis=1) for k, (_, one) in self.of.items()]
        return np.all(near, axis=0)

    @property
    def imbalance(self) -> Array:
        """Largest force a ball lacks over the largest ball load of its bearing (speeds,)."""
        return np.max([one.error.max(axis=1) for _, one in self], axis=0)

    @property
    def pressure(self) -> Array:
        """Largest contact pressure of all balls (speeds,) [Pa]."""
        return np.max([one.pressure.max(axis=1) for _, one in self], axis=0)
