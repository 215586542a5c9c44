"""Named places along the shaft: thin lines through panels, names above them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.figures.labels import spread
from rotordyn.figures.style import FONT_SIZE, GREY

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Mark = tuple[float, str]
LETTER = 0.55 * (FONT_SIZE - 1.5) * 25.4 / 72.0  # [mm]: mean width of a letter above the panels


def mark(axes: Axes, marks: Sequence[Mark]) -> None:
    """Draw a thin line at every station."""
    for x, _ in marks:
        axes.axvline(x, color=GREY, lw=0.6, ls=":", zorder=1)


def upright(marks: Sequence[Mark], wide: float, left: float, right: float) -> bool:
    """Return whether names need to be vertical to stay near their stations, on ``wide`` [mm]."""
    length = right - left
    sizes = [(len(name) * LETTER + 1.5) * length / wide for _, name in marks]
    shift = spread([x for x, _ in marks], sizes, left, right) - [x for x, _ in marks]
    return sum(sizes) > length or bool(np.abs(shift).max(initial=0.0) > 0.1 * length)


def room(marks: Sequence[Mark], upright: bool) -> float:
    """Return the height of the names above a panel [mm]."""
    longest = max((len(name) for _, name in marks), default=0)
    return 3.0 + (LETTER * longest + 1.0 if upright else 3.0)


def name(
    axes: Axes, marks: Sequence[Mark], wide: float, upright: bool, foot: str = "bottom"
) -> None:
    """Draw the name of every station above a panel of ``wide`` [mm]; ``foot``: its vertical
    alignment, ``"bottom"`` or ``"baseline"``."""
    sizes = [(2.0 if upright else len(n)) * LETTER + 1.5 for _, n in marks]
    look = {"rotation": 90.0 if upright else 0.0, "va": foot}
    words_above(axes, [x for x, _ in marks], [n for _, n in marks], sizes, wide, **look)


def words_above(
    axes: Axes,
    at: Sequence[float],
    words: Sequence[str],
    sizes: Sequence[float],
    wide: float,
    **look: Any,
) -> None:
    """Draw ``words`` above a panel of ``wide`` [mm] near their positions ``at``, each with a width
    of ``sizes`` [mm] along the axis."""
    left, right = axes.get_xlim()
    places = spread(at, [size * (right - left) / wide for size in sizes], left, right)
    for place, word in zip(places, words, strict=True):
        axes.annotate(
            word,
            (float(place), 1.0),
            (0.0, 2.0),
            xycoords=("data", "axes fraction"),
            textcoords="offset points",
            ha="center",
            fontsize=FONT_SIZE - 1.5,
            color=GREY,
            **{"va": "bottom", **look},
        )
