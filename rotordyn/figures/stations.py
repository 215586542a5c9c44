"""Named places along the shaft: thin lines through panels, names above them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.figures.labels import spread
from rotordyn.figures.style import FONT_SIZE, GREY

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Mark = tuple[float, str]
_LETTER = 0.55 * (FONT_SIZE - 1.5) * 25.4 / 72.0  # [mm] of a name above the panels, on average


def mark(axes: Axes, marks: Sequence[Mark]) -> None:
    """A thin line at every station."""
    for x, _ in marks:
        axes.axvline(x, color=GREY, lw=0.6, ls=":", zorder=1)


def upright(marks: Sequence[Mark], wide: float, left: float, right: float) -> bool:
    """Names that would leave their stations over a panel of ``wide`` [mm] stand upright."""
    length = right - left
    sizes = [(len(name) * _LETTER + 1.5) * length / wide for _, name in marks]
    moved = spread([x for x, _ in marks], sizes, left, right) - [x for x, _ in marks]
    return sum(sizes) > length or bool(np.abs(moved).max(initial=0.0) > 0.1 * length)


def room(marks: Sequence[Mark], upright: bool) -> float:
    """Height that the names need above a panel [mm]."""
    longest = max((len(name) for _, name in marks), default=0)
    return 3.0 + (_LETTER * longest + 1.0 if upright else 3.0)


def name(axes: Axes, marks: Sequence[Mark], wide: float, upright: bool) -> None:
    """The name of every station above a panel of ``wide`` [mm]."""
    left, right = axes.get_xlim()
    per_mm = (right - left) / wide
    sizes = [((2.0 if upright else len(n)) * _LETTER + 1.5) * per_mm for _, n in marks]
    places = spread([x for x, _ in marks], sizes, left, right)
    for place, (_, name) in zip(places, marks, strict=True):
        axes.annotate(
            name,
            (float(place), 1.0),
            (0.0, 2.0),
            xycoords=("data", "axes fraction"),
            textcoords="offset points",
            ha="center",
            va="bottom",
            rotation=90.0 if upright else 0.0,
            fontsize=FONT_SIZE - 1.5,
            color=GREY,
        )
