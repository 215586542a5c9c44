"""Chips of the teeth of a cutter in a rigid machine, with run-out.

A tooth at the angle φ cuts down to the surface that the deepest of the previous teeth left there:
with F the feed since that one and D the run-out of the tooth minus its, h = F sin φ + D. Where h
is below 0 the tooth is not in cut, and the next one has a thicker chip.

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

from rotordyn.analyses.stability_lobes.cutting import Cut
from rotordyn.arrays import Array


@dataclass(frozen=True, slots=True)
class Chip:
    """Chip of a ``tooth`` from ``entry`` to ``exit`` [rad], ``feed`` sin φ + ``height`` [m] thick,
    on a surface left by the tooth that passed there ``gap`` [rad] before."""

    tooth: int
    entry: float
    exit: float
    feed: float
    height: float
    gap: float


class Passed(NamedTuple):
    """Tooth minus each of the previous teeth, itself last (teeth,): ``gap`` [rad],
    ``feed`` [m], and run-out (``height``) [m]."""

    gap: Array
    feed: Array
    height: Array


@lru_cache
def passed(cut: Cut, feed: float) -> tuple[Passed, ...]:
    """Return the differences of all teeth of the pattern, with mean ``feed`` by tooth [m]."""
    gaps = np.array(cut.gaps)
    count = len(gaps)
    out, differences = np.array(cut.runout[:count] or [0.0] * count), []
    for tooth in range(count):
        before = (tooth - np.arange(count + 1)) % count  # itself, those before it, itself again
        gap, height = np.cumsum(gaps[before[:-1]]), out[tooth] - out[before[1:]]
        differences.append(Passed(gap, feed * cut.teeth * gap / (2.0 * math.pi), height))
    return tuple(differences)


@lru_cache
def chips(cut: Cut, feed: float) -> tuple[Chip, ...]:
    """Return the chips of all teeth of the pattern, with mean ``feed`` by tooth [m]."""
    result = []
    for tooth, since in enumerate(passed(cut, feed)):
        all_in_cut = [((cut.entry, cut.exit), 0)]
        spans = _spans(cut, since.feed, since.height) if cut.runout else all_in_cut
        for (entry, exit), earlier in spans:
            values = since.feed[earlier], since.height[earlier], since.gap[earlier]
            result.append(Chip(tooth, entry, exit, *map(float, values)))
    return tuple(result)


def _spans(cut: Cut, feed: Array, height: Array) -> Iterator[tuple[tuple[float, float], int]]:
    """Yield spans of angle in which a tooth is in cut, and the index of the previous tooth that
    left the surface: of the least ``feed`` sin φ + ``height``, where that is above 0."""
    steeper, higher = np.subtract.outer(feed, feed), np.subtract.outer(height, height)
    with np.errstate(divide="ignore", invalid="ignore"):
        sine = np.append((-higher / steeper)[np.triu_indices(len(feed), 1)], -height / feed)
    crossing = np.arcsin(sine[(sine > 0.0) & (sine <= 1.0)])
    ends = np.concatenate([crossing, math.pi - crossing, [cut.entry, cut.exit]])
    ends = np.unique(ends[(ends >= cut.entry) & (ends <= cut.exit)])
    inside = np.sin(0.3 * ends[1:] + 0.7 * ends[:-1])  # not at the middle, where two may be equal
    thickness = feed[:, None] * inside + height[:, None]
    earlier = np.where(thickness.min(axis=0) > 0.0, thickness.argmin(axis=0), -1)
    for which, spans in groupby(
        zip(earlier.tolist(), pairwise(ends.tolist()), strict=True), lambda each: each[0]
    ):
        run = [span for _, span in spans]
        if which >= 0:
            yield (run[0][0], run[-1][1]), which
