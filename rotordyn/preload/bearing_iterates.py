"""The bearings of an arrangement, model by model: solved by themselves, or on the way to balance.

Whoever moves the shaft moves all of them at once, balls included (``bearings.ring.iterate``).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bearings.kinds.angular_contact import AngularContactBallBearing
from bearings.ring.state import BearingState

if TYPE_CHECKING:
    from bearings.geometry import Geometry
    from bearings.ring.iterate import Iterate
    from bearings.ring.sums import Ring

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, eq=False, slots=True)
class Solved:
    """States of one bearing model: which of the places asked for, the batch (speeds, places)."""

    places: list[int]
    state: BearingState


States = dict[AngularContactBallBearing, Solved]


@dataclass(frozen=True, eq=False, slots=True)
class BearingIterates:
    """By model: the places at which it stands, and its balls there, a batch (speeds, places)."""

    of: dict[AngularContactBallBearing, tuple[list[int], Iterate]]

    @classmethod
    def solved(cls, states: States, ring: Callable[[Geometry], Ring]) -> BearingIterates:
        """Bearings that were solved by themselves; ``ring`` says which of their balls move on."""
        from bearings.ring.iterate import iterate

        return cls({m: (found.places, iterate(found.state, ring)) for m, found in states.items()})

    def __iter__(self) -> Iterator[tuple[list[int], Iterate]]:
        return iter(self.of.values())

    def moved(self, displacement: Array) -> BearingIterates:
        """Rings at ``displacement`` (speeds, places, 5), every ball one Newton step on."""
        return BearingIterates(
            {
                m: (places, one.moved(displacement[:, places]))
                for m, (places, one) in self.of.items()
            }
        )

    def at(self, displacement: Array, balls: Sequence[Array]) -> BearingIterates:
        """Rings at ``displacement`` (speeds, places, 5), the balls of each model placed too."""
        return BearingIterates(
            {
                m: (places, one.at(displacement[:, places], ball))
                for (m, (places, one)), ball in zip(self.of.items(), balls, strict=True)
            }
        )

    def follows(self, before: BearingIterates) -> Flags:
        """Speeds at which every ball is still where it can come to from ``before`` (speeds,)."""
        near = [one.follows(before.of[m][1]).all(axis=1) for m, (_, one) in self.of.items()]
        return np.all(near, axis=0)

    @property
    def imbalance(self) -> Array:
        """Largest force a ball lacks over the largest ball load of its bearing (speeds,)."""
        return np.max([one.error.max(axis=1) for _, one in self], axis=0)

    @property
    def pressure(self) -> Array:
        """Largest contact pressure of all balls (speeds,) [Pa]."""
        return np.max([one.pressure.max(axis=1) for _, one in self], axis=0)
