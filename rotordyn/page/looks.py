"""Styles of charts: lines differ by dashes, markers and colours visible on light and dark.

Colours are those of Okabe and Ito without black; ``INK`` and ``FAINT`` stand for text colours.
"""

from __future__ import annotations

from typing import Any

INK, FAINT = "@ink", "@faint"
COLOURS = ("#0082CC", "#D55E00", "#009E73", "#B0689F", "#C98A00", "#4FA8DC", "#8A8A8A")
DASHES = ("solid", "dash", "dot", "dashdot", "longdash", "longdashdot")
MARKS = ("circle", "square", "triangle-up", "diamond", "triangle-down", "cross", "x")
FEW_POINTS = 4  # points from which a line is drawn; fewer are markers
MANY = 14  # largest number of variants named in a legend


def colour(place: int) -> str:
    """Colour of line number ``place``."""
    return COLOURS[place % len(COLOURS)]


def line(place: int, dash: int = 0, width: float = 1.8) -> dict[str, Any]:
    """Line style by the numbers of colour and dash pattern."""
    return {"color": colour(place), "dash": DASHES[dash % len(DASHES)], "width": width}


def mark(place: int) -> str:
    """Symbol of marker number ``place``."""
    return MARKS[place % len(MARKS)]


def marks_only(place: int) -> dict[str, Any]:
    """Style of points that are too few for a line."""
    return {"mode": "markers", "marker": {"symbol": mark(place), "color": colour(place), "size": 8}}


def axis(title: str, unit: str = "", **more: Any) -> dict[str, Any]:
    """An axis with its label and unit."""
    return {"title": {"text": f"{title} [{unit}]" if unit else title}, **more}


def logarithmic(title: str, unit: str) -> dict[str, Any]:
    """A logarithmic axis with plain numbers at its ticks."""
    return axis(title, unit, type="log", dtick=1, exponentformat="power")
