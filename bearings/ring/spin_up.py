"""Speeds at which a bearing spun up from rest first has no state, and at which it has one again.

A search is a generator: it yields speeds and is sent which of them have a state, and which balls
touch there, so that the searches of many operating points are solved together.
"""

from __future__ import annotations

from collections.abc import Generator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearings.arrays import Array, Flags, Index

PARTS = 64  # intervals from rest to the given speed
CHUNK = 32  # speeds solved together, from below, until one has no state
SPLIT = 16
ROUNDS = 2  # of splitting by SPLIT: a resolution of 1/16384 of the speed
ABOVE = 24  # speeds between the first gap and the given speed


class Gap(NamedTuple):
    """Speeds [rad/s]: there is a state at all sampled speeds up to ``low``.

    ``again``: the lowest and the highest sampled speed above at which there is one again, or None;
    ``broken``: whether there is none at some speed between these two.
    """

    low: float
    again: tuple[float, float] | None = None
    broken: bool = False


Search = Generator[Array, tuple[Flags, Flags], Gap]


class Samples(NamedTuple):
    """Speeds (k,) in ascending order, whether there is a state, and which balls (k, n) touch."""

    speed: Array
    there: Flags
    touch: Flags

    @property
    def last(self) -> int:
        """Index of the last speed before the first one without a state."""
        return (len(self.there) if self.there.all() else int(np.argmin(self.there))) - 1

    @property
    def again(self) -> Index:
        """Indices of speeds with a state above the first one without."""
        exists = np.flatnonzero(self.there)
        return exists[exists > self.last]

    def joined(self, *more: NDArray[Any]) -> Samples:
        """Add ``more`` speeds, whether there is a state at each, and which balls touch."""
        parts = [np.concatenate(pair) for pair in zip(self, more, strict=True)]
        order = np.argsort(parts[0], kind="stable")
        return Samples(*(part[order] for part in parts))

    def between(self, places: Index, speed: float) -> Array:
        """Speeds that split the intervals from ``places`` up; the last one ends at ``speed``."""
        ends = np.append(self.speed, speed)
        split = [np.linspace(ends[k], ends[k + 1], SPLIT + 1)[1:-1] for k in np.unique(places)]
        return np.concatenate(split) if split else np.empty(0)


def spin_up(speed: float, *, jumps: bool) -> Search:
    """Search for the first gap below a ``speed`` that has no state.

    ``jumps``: contacts open and close with a jump; a gap may then hide wherever one has changed
    from a speed to the next, and these intervals are split like the one where the states end.
    """
    grid = speed * np.arange(PARTS) / PARTS
    samples = Samples(grid[:CHUNK], *(yield grid[:CHUNK]))
    if samples.there.all():
        samples = samples.joined(grid[CHUNK:], *(yield grid[CHUNK:]))
    if not samples.there[0]:
        return Gap(0.0)
    first = np.append(samples.speed, speed)[samples.last + 1]
    above = np.linspace(first, speed, ABOVE + 2)[1:-1]
    for _ in range(ROUNDS):
        last = samples.last
        changed = (samples.touch[1 : last + 1] != samples.touch[:last]).any(axis=1) & jumps
        doubtful = samples.between(np.append(np.flatnonzero(changed), last), speed)
        requested = np.unique(np.concatenate([doubtful, above[above < speed]]))
        samples = samples.joined(requested, *(yield requested))
        again = samples.again  # where states begin again and end again
        edges = np.array([again[0] - 1, again[-1]]) if again.size else again
        above = samples.between(edges, speed)
    low, again = float(samples.speed[samples.last]), samples.again
    if not again.size:
        return Gap(low)
    begin, end = again[[0, -1]]
    broken = not samples.there[begin : end + 1].all()
    return Gap(low, (float(samples.speed[begin]), float(samples.speed[end])), broken=broken)
