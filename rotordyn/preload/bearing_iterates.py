"""Bearings of an arrangement by model and law: solved states, and iterates of a balance.

A motion of the shaft moves all of them at once, balls included (``bearings.ring.iterate``).
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
    """Batch (speeds, places) of states of one model and law, and its ``places`` in the request."""

    places: list[int]
    state: BearingState


Alike = tuple[BallBearing, Law | Laws]  # bearings that can be solved in one call
States = dict[Alike, Solved]


@dataclass(frozen=True, eq=False, slots=True)
class BearingIterates:
    """Iterates by model and law: places of such bearings, batch (speeds, places) of their balls."""

    of: dict[Alike, tuple[list[int], Any]]  # ``Iterate``, or ``Settled``

    @classmethod
    def solved(cls, states: States, ring: Callable[[Geometry], Assembly]) -> BearingIterates:
        """Return iterates of solved bearings; ``ring`` selects the balls that move on."""
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
        """Return iterates at speeds ``rows``; ``bearings``: the solved one at each place."""
        from bearings.ring.iterate import iterate

        of = {}
        for kind, balls in states.items():
            columns = {bearing: k for k, bearing in enumerate(balls.places)}
            places = [k for k, bearing in enumerate(bearings) if bearing in columns]
            at = np.array([columns[bearings[k]] for k in places])
            of[kind] = places, iterate(balls.state.rows(np.ix_(rows, at)), ring)
        return cls(of)

    def __iter__(self) -> Iterator[tuple[list[int], Any]]:
        return iter(self.of.values())

    def moved(self, displacement: Array) -> BearingIterates:
        """Move rings to ``displacement`` (speeds, places, 5), every ball by one Newton step."""
        return BearingIterates(
            {
                k: (places, batch.moved(displacement[:, places]))
                for k, (places, batch) in self.of.items()
            }
        )

    def at(self, displacement: Array, balls: Sequence[Array]) -> BearingIterates:
        """Place rings at ``displacement`` (speeds, places, 5), and the balls of each group."""
        return BearingIterates(
            {
                k: (places, batch.at(displacement[:, places], ball))
                for (k, (places, batch)), ball in zip(self.of.items(), balls, strict=True)
            }
        )

    def follows(self, before: BearingIterates) -> Flags:
        """True at speeds where every ball is on the branch of its place in ``before`` (speeds,)."""
        followed = [batch.follows(before.of[k][1]).all(axis=1) for k, (_, batch) in self.of.items()]
        return np.all(followed, axis=0)

    @property
    def imbalance(self) -> Array:
        """Largest residual force on a ball over the largest ball load of its bearing (speeds,)."""
        return np.max([batch.error.max(axis=1) for _, batch in self], axis=0)

    @property
    def pressure(self) -> Array:
        """Largest contact pressure of all balls (speeds,) [Pa]."""
        return np.max([batch.pressure.max(axis=1) for _, batch in self], axis=0)
