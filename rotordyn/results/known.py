"""Computed values at the speeds of published or measured ones."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rotordyn.arrays import Array
from rotordyn.machine.reference import Reference

SAME_SPEED = 5e-3  # of the highest speed: nothing is interpolated between speeds


@dataclass(frozen=True, slots=True)
class Match:
    """A reference, reduced to the speeds that can be compared, and computed ``values`` (SI)."""

    reference: Reference
    values: tuple[float, ...]


def at_speeds(speeds: Array, known: Array, values: Array) -> Array:
    """Values at the computed (``known``) speeds next to ``speeds``, NaN where none is close."""
    nearest = np.abs(known - speeds[:, None]).argmin(axis=1)
    close = np.abs(known[nearest] - speeds) <= SAME_SPEED * known[-1]
    return np.where(close, values[nearest], np.nan)


def column(speeds: Array, result: Any, name: str, dim: str, word: str) -> Array | None:
    """Values of a field for the entry ``word`` of ``dim``, at some speeds; None without it."""
    words = getattr(result, dim)
    if word not in words:
        return None
    return at_speeds(speeds, result.speed, getattr(result, name)[:, words.index(word)])
