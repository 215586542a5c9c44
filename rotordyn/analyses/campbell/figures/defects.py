"""Lines of bearing defects in a Campbell diagram, named along them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.arrays import Array
from rotordyn.figures.style import FONT_SIZE, GREY
from rotordyn.results.display import RPM
from rotordyn.results.frames import turning

if TYPE_CHECKING:
    from matplotlib.axes import Axes

NEAR = 0.05  # of the axis, between lines that share a name at their end
SHARES = (0.8, 0.58, 0.69, 0.47)  # of the visible length: positions of successive names


def draw_passing(axes: Axes, result: CampbellResult, top: float) -> None:
    """Draw defect frequencies of bearings up to ``top`` [Hz] as dotted curves with names.

    In the rotating frame nothing is drawn: the frequency there depends on where they act.
    """
    rpm = result.speed * RPM.factor
    if turning(result) or not result.passing or rpm[-1] <= 0.0:
        return
    axes.plot(rpm, result.passing_frequency, color=GREY, lw=0.8, ls=":", zorder=2)
    paper: dict[str, Any] = {"boxstyle": "square,pad=0.1", "fc": "white", "ec": "none"}
    look: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": FONT_SIZE - 2.0}
    look |= {"color": GREY, "zorder": 5, "rotation_mode": "anchor", "bbox": paper}
    for k, (name, order) in enumerate(_named(result, top)):
        end = min(rpm[-1], top * 60.0 / order)
        x = SHARES[k % len(SHARES)] * end
        slope = axes.bbox.height / top * order / 60.0 / (axes.bbox.width / rpm[-1])
        angle = float(np.degrees(np.arctan(slope)))
        axes.text(x, order * x / 60.0, name, rotation=angle, **look)


def _named(result: CampbellResult, top: float) -> list[tuple[str, float]]:
    """Return names and orders at the last speed; adjacent lines of one defect share a name."""
    orders: Array = result.passing_frequency[-1] * 60.0 / (result.speed[-1] * RPM.factor)
    gap = NEAR * top * 60.0 / (result.speed[-1] * RPM.factor)
    groups: list[list[tuple[float, str]]] = []
    moving = [(k, name) for k, name in zip(orders.tolist(), result.passing, strict=True) if k > 0.0]
    for order, name in sorted(moving):
        adjacent = [
            group
            for group in groups
            if _defect(group[0][1]) == _defect(name)
            and order - group[0][0] < max(gap, 0.05 * order)
        ]
        if adjacent:
            adjacent[0].append((order, name))
        else:
            groups.append([(order, name)])
    named = []
    for group in groups:
        defect = _defect(group[0][1])
        seats = ", ".join(sorted(name[len(defect) :].strip() for _, name in group))
        named.append((f"{defect} {seats}".strip(), float(np.mean([order for order, _ in group]))))
    return named


def _defect(name: str) -> str:
    return name.partition(" ")[0]
