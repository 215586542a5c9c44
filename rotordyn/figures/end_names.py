"""Names of curves at the right edge of a panel, moved apart where these are close."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from rotordyn.figures.labels import spread
from rotordyn.figures.style import FONT_SIZE

if TYPE_CHECKING:
    from matplotlib.axes import Axes

NAMES = 24.0  # [mm] of room beside a panel
SIZE = FONT_SIZE - 1.5
LINE = 1.25 * SIZE * 25.4 / 72.0  # [mm] of a name


class End(NamedTuple):
    """Where a curve meets the right edge, its name and colour; ``whose``: the variant's place."""

    height: float
    name: str
    colour: Any
    whose: int


def name_ends(axes: Axes, ends: Sequence[End], tall: float) -> None:
    """Names beside a panel ``tall`` [mm], joined to their curves by leaders.

    Curves of one variant that are closer than a line share a name. Where not all names fit, those
    of the first variant that has any stand alone.
    """
    from matplotlib.collections import LineCollection

    low, high = axes.get_ylim()
    unit = (high - low) / tall
    seen = [end for end in ends if low <= end.height <= high]
    shared = _shared(seen, LINE * unit)
    if len(shared) * LINE > tall:
        first = min(end.whose for end in shared)
        shared = [end for end in shared if end.whose == first]
    heights = [end.height for end in shared]
    placed = spread(heights, [LINE * unit] * len(shared), low, high)
    left, right = axes.get_xlim()
    frame = right - left
    leaders = [
        [(right, end.height), (right + 0.02 * frame, at)]
        for end, at in zip(shared, placed, strict=True)
    ]
    colours = [end.colour for end in shared]
    lines = LineCollection(leaders, colors=colours, linewidths=0.5, clip_on=False)
    axes.add_collection(lines, autolim=False)
    look: dict[str, Any] = {"ha": "left", "va": "center", "fontsize": SIZE}
    for end, at in zip(shared, placed, strict=True):
        axes.text(right + 0.024 * frame, at, end.name, color=end.colour, **look)


def _shared(ends: Sequence[End], near: float) -> list[End]:
    """Neighbours of one variant with names that begin alike as one, from the lowest up."""
    kept: list[list[End]] = []
    for end in sorted(ends):
        twins = [
            group
            for group in kept
            if group[0].whose == end.whose
            and end.height - group[0].height < near
            and _root(end.name) == _root(group[0].name)
        ]
        if twins:
            twins[0].append(end)
        else:
            kept.append([end])
    return [
        group[0]._replace(
            height=float(np.mean([end.height for end in group])),
            name=joined(sorted(end.name for end in group)),
        )
        for group in kept
    ]


def joined(names: Sequence[str]) -> str:
    """Names that differ in their last word as one.

    >>> joined(["bending 1 bw", "bending 1 fw"])
    'bending 1 bw/fw'
    """
    begin = _root(names[0])
    return begin + "/".join(name[len(begin) :] for name in names)


def _root(name: str) -> str:
    """All but the last word, with the blank."""
    return name[: name.rfind(" ") + 1]
