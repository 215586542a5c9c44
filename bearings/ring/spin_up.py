"""Where a bearing that is spun up from rest first has no state, and where it has one again.

A search is a generator: it yields speeds and is sent which of them have a state, and which balls
touch there, so that the searches of many questions are solved together.
"""

from __future__ import annotations

from collections.abc import Generator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Index = NDArray[np.intp]
PARTS = 64  # of the way from rest to the speed asked for
CHUNK = 32  # of them looked at together, from below, until one has no state
SPLIT = 16
ROUNDS = 2  # of splitting by that: 1/16384 of the way
ABOVE = 24  # speeds between the first gap and the speed asked for


class Gap(NamedTuple):
    """Speeds [rad/s]: there is a state at all speeds looked at up to ``low``.

    ``again``: the lowest and the highest speed met above at which there is one again, or None;
    ``broken``: whether there was none at some speed between these two.
    """

    low: float
    again: tuple[float, float] | None = None
    broken: bool = False


class Seen(NamedTuple):
    """Speeds (k,) in ascending order, whether there is a state, and which balls (k, n) touch."""

    speed: Array
    there: Flags
    touch: Flags


Search = Generator[Array, tuple[Flags, Flags], Gap]


def spin_up(speed: float, *, jumps: bool) -> Search:
    """Search for the first gap below a ``speed`` that has no state.

    ``jumps``: contacts open and close with a jump; a gap may then hide wherever one has changed
    from a speed to the next, and these intervals are split like the one where the states end.
    """
    grid = speed * np.arange(PARTS) / PARTS
    seen: Seen | None = None
    for first in range(0, PARTS, CHUNK):
        chunk = grid[first : first + CHUNK]
        seen = _joined(seen, Seen(chunk, *(yield chunk)))
        if not seen.there.all():
            break
    assert seen is not None
    if not seen.there[0]:
        return Gap(0.0)
    above = np.linspace(_ends(seen, _last(seen), speed)[1], speed, ABOVE + 2)[1:-1]
    for _ in range(ROUNDS):
        doubtful = _between(seen, speed, _doubtful(seen, jumps=jumps))
        asked = np.unique(np.concatenate([doubtful, above[above < speed]]))
        seen = _joined(seen, Seen(asked, *(yield asked)))
        above = _between(seen, speed, _edges(seen))
    last = _last(seen)
    again = _again(seen)
    if not again.size:
        return Gap(float(seen.speed[last]))
    first, final = again[[0, -1]]
    return Gap(
        float(seen.speed[last]),
        (float(seen.speed[first]), float(seen.speed[final])),
        broken=not seen.there[first : final + 1].all(),
    )


def _again(seen: Seen) -> Index:
    """Places above the first speed without a state that have one."""
    there = np.flatnonzero(seen.there)
    return there[there > _last(seen)]


def _edges(seen: Seen) -> Index:
    """Intervals, by their lower ends, in which states begin again and end again."""
    again = _again(seen)
    return np.array([again[0] - 1, again[-1]]) if again.size else again


def _last(seen: Seen) -> int:
    """Place of the last speed before the first one without a state."""
    return (len(seen.there) if seen.there.all() else int(np.argmin(seen.there))) - 1


def _doubtful(seen: Seen, *, jumps: bool) -> Index:
    """Intervals, by their lower ends, in which the first gap may begin."""
    last = _last(seen)
    changed = (seen.touch[1 : last + 1] != seen.touch[:last]).any(axis=1) & jumps
    return np.append(np.flatnonzero(changed), last)


def _ends(seen: Seen, place: int, speed: float) -> tuple[float, float]:
    """Of the interval that begins there; the last one ends at the speed asked for."""
    ends = np.append(seen.speed, speed)
    return float(ends[place]), float(ends[place + 1])


def _between(seen: Seen, speed: float, places: Index) -> Array:
    """Speeds that split intervals."""
    ends = [_ends(seen, int(place), speed) for place in np.unique(places)]
    inner = [np.linspace(*pair, SPLIT + 1)[1:-1] for pair in ends]
    return np.concatenate(inner) if inner else np.empty(0)


def _joined(a: Seen | None, b: Seen) -> Seen:
    """All speeds in order."""
    if a is None:
        return b
    speed, there, touch = (np.concatenate(pair) for pair in zip(a, b, strict=True))
    order = np.argsort(speed, kind="stable")
    return Seen(speed[order], there[order], touch[order])
