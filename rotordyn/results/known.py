"""What was computed, at the speeds of what was published or measured."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rotordyn.machine.reference import Reference
from rotordyn.results.kinds import Array

SAME_SPEED = 5e-3  # of the highest speed: nothing is interpolated between speeds


@dataclass(frozen=True, slots=True)
class Match:
    """A reference, cut down to what can be compared, and our ``values`` (SI) for it."""

    reference: Reference
    values: tuple[float, ...]


def at_speeds(speeds: Array, known: Array, values: Array) -> Array:
    """Values at the computed speeds that are as good as those asked for, NaN for the others."""
    nearest = np.abs(known - speeds[:, None]).argmin(axis=1)
    close = np.abs(known[nearest] - speeds) <= SAME_SPEED * known[-1]
    return np.where(close, values[nearest], np.nan)


def column(speeds: Array, result: Any, name: str, dim: str, word: str) -> Array | None:
    """A column of a result, that of ``word`` in ``dim``, at some speeds; None without it."""
    words = getattr(result, dim)
    if word not in words:
        return None
    return at_speeds(speeds, result.speed, getattr(result, name)[:, words.index(word)])
