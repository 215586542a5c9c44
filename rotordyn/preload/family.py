"""States of one machine under several hypotheses of its balls, solved together.

To solve bearings under many laws takes hardly longer than under one: each state is one more place
of a batch. What is asked of one state is so solved for all of them and kept.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from bearings.ball.law import Law
from bearings.ball.laws import Laws
from rotordyn.preload.bearing_iterates import Solved
from rotordyn.preload.state import PreloadState

Array = NDArray[np.float64]
Index = NDArray[np.intp]
T = TypeVar("T")


@dataclass(frozen=True, eq=False, slots=True)
class Family:
    """``joined``: a state whose speeds are repeated, once for each of ``laws``."""

    laws: tuple[Law, ...]
    joined: PreloadState
    _kept: dict[Any, Any] = field(default_factory=dict)

    @classmethod
    def solved(
        cls, laws: Sequence[Law], speed: Array, solve: Callable[[Array, Laws], PreloadState]
    ) -> Family:
        """States at every ``speed``, as ``solve`` gives them at any speeds, a law for each."""
        place = np.repeat(np.arange(len(laws)), len(speed))
        law = Laws(tuple(laws), tuple(place.tolist()))
        return cls(tuple(laws), solve(np.tile(speed, len(laws)), law))

    def state(self, law: Law) -> PreloadState:
        """The state under one of the laws, which knows its family."""
        return replace(self.joined.rows(self._rows(law)), family=self)

    def stop_speeds(self, law: Law) -> Array:
        """As of its ``PreloadState``."""
        each: Array = self._once("stops", lambda: self.joined.each_stop_speeds(len(self.laws)))
        return each[self.laws.index(law)]

    def with_travels(self, law: Law, travel: Mapping[str, float], index: Index) -> PreloadState:
        """As of its ``PreloadState``."""
        every = np.arange(len(self.joined.speed))
        key = "travels", *sorted(travel.items())
        found: PreloadState = self._once(key, lambda: self.joined.with_travels(travel, every))
        return found.rows(self._rows(law)[index])

    def under_axial(self, law: Law, bearings: Sequence[int], load: Array) -> list[Solved]:
        """As of its ``PreloadState``."""
        key = "axial", *bearings, load.tobytes()
        found: list[Solved] = self._once(key, lambda: self.joined.under_axial(bearings, load))
        rows = self._rows(law)
        return [Solved(each.places, each.state.rows(rows)) for each in found]

    def _rows(self, law: Law) -> Index:
        count = len(self.joined.speed) // len(self.laws)
        return np.arange(count) + count * self.laws.index(law)

    def _once(self, key: Any, work: Callable[[], T]) -> T:
        if key not in self._kept:
            self._kept[key] = work()
        found: T = self._kept[key]
        return found
