"""Lines and marks of charts: told apart by dashes and marks, and by colours seen on light and dark.

Colours are those of Okabe and Ito but black, the words ``INK`` and ``FAINT`` those of the text.
"""

from __future__ import annotations

from typing import Any

INK, FAINT = "@ink", "@faint"
COLOURS = ("#0082CC", "#D55E00", "#009E73", "#B0689F", "#C98A00", "#4FA8DC", "#8A8A8A")
DASHES = ("solid", "dash", "dot", "dashdot", "longdash", "longdashdot")
MARKS = ("circle", "square", "triangle-up", "diamond", "triangle-down", "cross", "x")
FEW_POINTS = 4  # for a line; fewer are marks
MANY = 14  # variants that have a name each in a legend


def colour(place: int) -> str:
    """Colour of the line at a place among others."""
    return COLOURS[place % len(COLOURS)]


def line(place: int, dash: int = 0, width: float = 1.8) -> dict[str, Any]:
    """A line by its places among colours and dashes."""
    return {"color": colour(place), "dash": DASHES[dash % len(DASHES)], "width": width}


def mark(place: int) -> str:
    """Mark at a place among others."""
    return MARKS[place % len(MARKS)]


def marks_only(place: int) -> dict[str, Any]:
    """Points too few for a line."""
    return {"mode": "markers", "marker": {"symbol": mark(place), "color": colour(place), "size": 8}}


def axis(title: str, unit: str = "", **more: Any) -> dict[str, Any]:
    """An axis with its label and unit."""
    return {"title": {"text": f"{title} [{unit}]" if unit else title}, **more}


def logarithmic(title: str, unit: str) -> dict[str, Any]:
    """A logarithmic axis with plain numbers at its ticks."""
    return axis(title, unit, type="log", dtick=1, exponentformat="power")
