"""Chips of the teeth of a cutter in a rigid machine, with run-out.

A tooth at the angle φ takes off what the deepest of those before it left there: with F the feed
since that one and D by how much it stands out farther, h = F sin φ + D. Where that is below 0 the
tooth is not in cut, and the next one takes off more.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import groupby, pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.cutting import Cut

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Chip:
    """What a ``tooth`` takes off from ``entry`` to ``exit`` [rad]: ``feed`` sin φ + ``height`` [m],
    left by the tooth that passed there ``gap`` [rad] before."""

    tooth: int
    entry: float
    exit: float
    feed: float
    height: float
    gap: float


class Passed(NamedTuple):
    """Since each of the teeth before one, itself last (teeth,): ``gap`` [rad], ``feed`` [m], and by
    how much it stands out farther than that, ``height`` [m]."""

    gap: Array
    feed: Array
    height: Array


@lru_cache
def passed(cut: Cut, feed: float) -> tuple[Passed, ...]:
    """Of all teeth of the pattern of a ``cut``, with ``feed`` by tooth [m] on average."""
    gaps = np.array(cut.gaps)
    count = len(gaps)
    out, found = np.array(cut.runout[:count] or [0.0] * count), []
    for tooth in range(count):
        before = (tooth - np.arange(count + 1)) % count  # itself, those before it, itself again
        gap, height = np.cumsum(gaps[before[:-1]]), out[tooth] - out[before[1:]]
        found.append(Passed(gap, feed * cut.teeth * gap / (2.0 * math.pi), height))
    return tuple(found)


@lru_cache
def chips(cut: Cut, feed: float) -> tuple[Chip, ...]:
    """Chips of all teeth of the pattern of a ``cut``, with ``feed`` by tooth [m] on average."""
    found = []
    for tooth, since in enumerate(passed(cut, feed)):
        whole = [((cut.entry, cut.exit), 0)]
        spans = _left_by(cut, since.feed, since.height) if cut.runout else whole
        for (entry, exit), left in spans:
            values = since.feed[left], since.height[left], since.gap[left]
            found.append(Chip(tooth, entry, exit, *map(float, values)))
    return tuple(found)


def _left_by(cut: Cut, feed: Array, height: Array) -> Iterator[tuple[tuple[float, float], int]]:
    """Spans of angle in which a tooth is in cut, and the place among those before it of the one
    that left the chip there: the least ``feed`` sin φ + ``height``, where that is above 0."""
    steeper, higher = np.subtract.outer(feed, feed), np.subtract.outer(height, height)
    with np.errstate(divide="ignore", invalid="ignore"):
        sine = np.append((-higher / steeper)[np.triu_indices(len(feed), 1)], -height / feed)
    turned = np.arcsin(sine[(sine > 0.0) & (sine <= 1.0)])
    ends = np.concatenate([turned, math.pi - turned, [cut.entry, cut.exit]])
    ends = np.unique(ends[(ends >= cut.entry) & (ends <= cut.exit)])
    inside = np.sin(0.3 * ends[1:] + 0.7 * ends[:-1])  # off the middle, where two may be alike
    thickness = feed[:, None] * inside + height[:, None]
    left = np.where(thickness.min(axis=0) > 0.0, thickness.argmin(axis=0), -1)
    for which, spans in groupby(
        zip(left.tolist(), pairwise(ends.tolist()), strict=True), lambda each: each[0]
    ):
        known = [span for _, span in spans]
        if which >= 0:
            yield (known[0][0], known[-1][1]), which
