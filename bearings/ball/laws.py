"""Hypotheses about the balls of a batch of states with different laws."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from bearings.ball.law import Law, LawNumbers


@dataclass(frozen=True)
class Laws:
    """Law of every state of a batch; friction and dynamics are common to all.

    ``known``: the different laws; ``place`` (s,): index in them of the law of each state.
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
        indices = np.array([law.numbers[:2] for law in self.known])[list(self.place), :, None]
        return LawNumbers(indices[:, 0], indices[:, 1], self.known[0].numbers.friction)

    @cached_property
    def one_branch(self) -> Any:
        """Where a neighbouring state may be a start (s,)."""
        return np.array([law.one_branch for law in self.known])[list(self.place)]

    def take(self, index: Iterable[Any]) -> Law | Laws:
        """Select states by index; returns a single ``Law`` where they share one."""
        place = tuple(self.place[k] for k in index)
        return self.known[place[0]] if len({*place}) == 1 else Laws(self.known, place)


def laws_of(parts: Sequence[Law | Laws], count: Sequence[int]) -> Law | Laws:
    """Concatenate the laws of batches of ``count`` states each, which have the same friction and
    dynamics."""
    first = parts[0]
    if isinstance(first, Law) and all(law == first for law in parts):
        return first
    repeated = [
        [law] * states if isinstance(law, Law) else [law.known[k] for k in law.place]
        for law, states in zip(parts, count, strict=True)
    ]
    laws = [law for batch in repeated for law in batch]
    known = tuple(dict.fromkeys(laws))
    return Laws(known, tuple(known.index(law) for law in laws))
