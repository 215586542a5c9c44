"""What every figure of variants shares: who they are, and panels that can be compared."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from rotordyn.figures.style import CYCLE, DASHES, grid_boxes, new_figure
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_PANELS = 6
COLOURS = (*CYCLE, "#882255", "#DDCC77", "#6699CC", "#999933", "#CC6677", "#117733", "#AA4499")
Box = tuple[float, float, float, float]


class Shown(NamedTuple):
    """One variant: its title, its result, and what is known of it."""

    title: str
    result: Any
    known: Sequence[Reference]
    spindle: Spindle | None


def colour(place: int) -> str:
    """Colour of the variant at a place."""
    return COLOURS[place % len(COLOURS)]


def dash(place: int) -> Any:
    """Dashes of the variant at a place: told apart without colour, too."""
    return DASHES[(place + place // len(DASHES)) % len(DASHES)]


def beside(labels: Sequence[str], place: int) -> str:
    """Label of the vertical axis of a panel: that of the panel to its left is not repeated."""
    left = labels[place - 1] if place % 2 else ""
    return "" if labels[place] == left else labels[place]


def panels(
    count: int, *, tall: float, margins: Sequence[float], gaps: Sequence[float]
) -> tuple[Figure, list[Box]]:
    """A figure with a box [mm] per variant, two beside each other."""
    columns = min(count, 2)
    rows = math.ceil(count / columns)
    height = margins[2] + margins[3] + rows * tall + (rows - 1) * gaps[1]
    figure = new_figure(168.0, height)
    return figure, grid_boxes(figure, rows, columns, margins=margins, gaps=gaps)[:count]
