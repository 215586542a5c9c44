"""Names of curves at the right edge of a panel, spread where curves are close."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from rotordyn.figures.labels import spread
from rotordyn.figures.style import FONT_SIZE

if TYPE_CHECKING:
    from matplotlib.axes import Axes

NAMES = 24.0  # [mm]: width of names at the right of a panel
SIZE = FONT_SIZE - 1.5
LINE = 1.25 * SIZE * 25.4 / 72.0  # [mm]: height of a name


class End(NamedTuple):
    """End of a curve at the right edge, its name and colour; ``whose``: index of its variant."""

    height: float
    name: str
    colour: Any
    whose: int


def name_ends(axes: Axes, ends: Sequence[End], tall: float) -> None:
    """Draw names at the right of a panel ``tall`` [mm], joined to their curves by leaders.

    Curves of one variant that are closer than a line share a name. If not all names fit, only those
    of the first variant that has any are drawn.
    """
    from matplotlib.collections import LineCollection

    low, high = axes.get_ylim()
    unit = (high - low) / tall
    visible = [end for end in ends if low <= end.height <= high]
    shared = _shared(visible, LINE * unit)
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


def _shared(ends: Sequence[End], distance: float) -> list[End]:
    """Merge adjacent ends of one variant whose names begin with the same words, lowest first."""
    groups: list[list[End]] = []
    for end in sorted(ends):
        matching = [
            group
            for group in groups
            if group[0].whose == end.whose
            and end.height - group[0].height < distance
            and _root(end.name) == _root(group[0].name)
        ]
        if matching:
            matching[0].append(end)
        else:
            groups.append([end])
    return [
        group[0]._replace(
            height=float(np.mean([end.height for end in group])),
            name=joined(sorted(end.name for end in group)),
        )
        for group in groups
    ]


def joined(names: Sequence[str]) -> str:
    """Join names that differ in their last word.

    >>> joined(["bending 1 bw", "bending 1 fw"])
    'bending 1 bw/fw'
    """
    begin = _root(names[0])
    return begin + "/".join(name[len(begin) :] for name in names)


def _root(name: str) -> str:
    """Return all but the last word, with the trailing blank."""
    return name[: name.rfind(" ") + 1]
