"""Strokes of a drawing, collected and passed to matplotlib as few artists."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Points = Sequence[Sequence[float]]


class Sketch:
    """Polygons and lines by look; coordinates in the units of the axes they are drawn on."""

    def __init__(self) -> None:
        self.polygons: dict[tuple[str, str, float, int], list[Points]] = defaultdict(list)
        self.lines: dict[tuple[str, float, str, int], list[Points]] = defaultdict(list)

    def polygon(
        self, points: Points, face: str, edge: str = "#333333", width: float = 0.7, z: int = 2
    ) -> None:
        """Add a filled polygon."""
        self.polygons[face, edge, width, z].append(points)

    def box(self, left: float, right: float, low: float, high: float, face: str, **k: Any) -> None:
        """Add a filled rectangle."""
        self.polygon([(left, low), (right, low), (right, high), (left, high)], face, **k)

    def circle(self, x: float, y: float, radius: float, face: str, **k: Any) -> None:
        """Add a filled circle."""
        angle = np.linspace(0.0, 2.0 * np.pi, 37)
        ring = np.column_stack([x + radius * np.cos(angle), y + radius * np.sin(angle)])
        self.polygon(ring.tolist(), face, **k)

    def line(
        self,
        points: Points,
        colour: str = "#333333",
        width: float = 0.7,
        style: str = "solid",
        z: int = 3,
    ) -> None:
        """Add a polyline."""
        self.lines[colour, width, style, z].append(points)

    def cross(self, left: float, right: float, low: float, high: float, **look: Any) -> None:
        """Add both diagonals of a rectangle, with the ``look`` of a ``line``."""
        self.line([(left, low), (right, high)], **look)
        self.line([(left, high), (right, low)], **look)

    def draw(self, axes: Axes) -> None:
        """Put everything on ``axes``, one collection per look."""
        from matplotlib.collections import LineCollection, PolyCollection

        for (face, edge, width, z), shapes in self.polygons.items():
            look: dict[str, Any] = dict(facecolors=face, edgecolors=edge)
            filled = PolyCollection(shapes, linewidths=width, zorder=z, **look)
            axes.add_collection(filled, autolim=False)
        for (colour, width, style, z), strokes in self.lines.items():
            look = dict(colors=colour, linestyles=style)
            lines = LineCollection(strokes, linewidths=width, zorder=z, **look)
            axes.add_collection(lines, autolim=False)
