"""What is assumed of the balls of a batch of states, of each another law."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from bearings.ball.law import Law, LawNumbers


@dataclass(frozen=True)
class Laws:
    """The law of every state of a batch, alike in friction and dynamics.

    ``known``: those there are; ``place`` (s,): which of them holds.
    """

    known: tuple[Law, ...]
    place: tuple[int, ...]

    @property
    def friction(self) -> float | None:
        """Coefficient that limits the moment a race can hold."""
        return self.known[0].friction

    @property
    def dynamics(self) -> str:
        """Which of Fc and Mg act."""
        return self.known[0].dynamics

    @cached_property
    def numbers(self) -> LawNumbers:
        """Plain numbers for the balance of balls, (s, 1)."""
        each = np.array([law.numbers[:2] for law in self.known])[list(self.place), :, None]
        return LawNumbers(each[:, 0], each[:, 1], self.known[0].numbers.friction)

    @cached_property
    def one_branch(self) -> Any:
        """Where a neighbour may be a start (s,)."""
        return np.array([law.one_branch for law in self.known])[list(self.place)]

    def take(self, index: Iterable[Any]) -> Law | Laws:
        """The laws of some states; a single one where they have one."""
        place = tuple(self.place[k] for k in index)
        return self.known[place[0]] if len({*place}) == 1 else Laws(self.known, place)


def laws_of(parts: Sequence[Law | Laws], count: Sequence[int]) -> Law | Laws:
    """The law of every state of batches one after the other, so many states in each; alike in
    friction and dynamics."""
    first = parts[0]
    if isinstance(first, Law) and all(law == first for law in parts):
        return first
    each = [
        [law] * states if isinstance(law, Law) else [law.known[k] for k in law.place]
        for law, states in zip(parts, count, strict=True)
    ]
    every = [law for one in each for law in one]
    known = tuple(dict.fromkeys(every))
    return Laws(known, tuple(known.index(law) for law in every))
