"""The table of a study or an optimum read back, and what its page shows of it: any column over any
other, points as lines across columns, the table itself."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.page.blocks import Chart, Control, Table
from rotordyn.page.looks import COLOURS, axis
from rotordyn.results.kinds import Array

MOST_ROWS = 500
FEW = 12  # values that are listed
ACROSS = 6  # numbers beside the parameters of parallel coordinates
LEAST, SIDES = 120, 115  # px from axis to axis of parallel coordinates, and for labels beside them
LONGEST = 28  # letters of its label
BLUE_TO_ORANGE = [[0.0, COLOURS[0]], [1.0, COLOURS[1]]]  # seen on light and on dark


class Column(NamedTuple):
    """What was varied or what came of it: its heading, its words, and as numbers the values or, of
    ``words`` that are none, their places among ``kinds``."""

    heading: str
    words: Sequence[str]
    values: Array
    kinds: Sequence[str] = ()

    @property
    def moves(self) -> bool:
        """It is a number that is not the same at all points."""
        known = self.values[np.isfinite(self.values)]
        return not self.kinds and known.size > 0 and float(np.ptp(known)) > 0.0


class Group(NamedTuple):
    """Points of a kind, and how they are marked: ``chosen`` (points,)."""

    name: str
    chosen: NDArray[Any]
    marker: dict[str, Any]


def read_columns(path: Path) -> list[Column]:
    """The columns of a table with a heading each.

    Raises
    ------
    OSError, ValueError : no such file, or no table
    """
    with path.open(newline="", encoding="utf-8-sig") as file:
        heads, *rows = csv.reader(file)
    return [_column(head, [row[k] for row in rows]) for k, head in enumerate(heads)]


def _column(heading: str, words: Sequence[str]) -> Column:
    values = [_value(word) for word in words]
    if any(word and value is None for word, value in zip(words, values, strict=True)):
        kinds = list(dict.fromkeys(words))
        return Column(heading, words, np.array([float(kinds.index(w)) for w in words]), kinds)
    return Column(heading, words, np.array([math.nan if v is None else v for v in values]))


def _value(word: str) -> float | None:
    try:
        return float(word)
    except ValueError:
        return None


def varied_table(title: str, columns: Sequence[Column]) -> Table:
    """What was varied, and over which values."""
    return Table(title, ("path", "values"), [*_varied(columns)])


def _varied(columns: Sequence[Column]) -> Iterator[tuple[str, str]]:
    for each in columns:
        if each.kinds:
            yield each.heading, ", ".join(each.kinds)
        else:
            values = np.unique(each.values)
            few = ", ".join(f"{v:.6g}" for v in values)
            many = f"{values[0]:.6g} to {values[-1]:.6g}, {len(values)} values"
            yield each.heading, few if len(values) <= FEW else many


def plain_group(count: int) -> Group:
    """All points alike."""
    marker = {"color": COLOURS[0], "size": 7, "opacity": 0.75}
    return Group("points", np.ones(count, dtype=bool), marker)


def trade_off(
    varied: Sequence[Column],
    shown: Sequence[Column],
    groups: Sequence[Group],
    start: tuple[int, int],
    note: str = "",
) -> Chart:
    """Any of them over any other, a mark for every point; those at ``start``, of all, at first."""
    columns = [*varied, *shown]
    names = [each.heading for each in columns]
    points = [
        ", ".join(f"{each.heading} {each.words[k]}" for each in varied)
        for k in range(len(columns[0].words))
    ]
    values = np.array([each.values for each in columns])
    traces = [
        {
            "mode": "markers",
            "name": group.name,
            "moving": {
                along: {"by": (number,), "values": values[:, group.chosen]}
                for number, along in enumerate("xy")
            },
            "text": [points[k] for k in np.flatnonzero(group.chosen)],
            "hovertemplate": "%{x:.5g}, %{y:.5g}<br>%{text}<extra></extra>",
            "marker": group.marker,
        }
        for group in groups
        if group.chosen.any()
    ]
    moving: dict[str, Any] = {}
    ticks = [_ticks(each) for each in columns]
    for number, which in enumerate(("xaxis", "yaxis")):
        moving[f"{which}.title.text"] = {"by": (number,), "values": names}
        for key in ("tickmode", "tickvals", "ticktext"):
            moving[f"{which}.{key}"] = {
                "by": (number,),
                "values": [each.get(key) for each in ticks],
            }
    layout = {
        "xaxis": axis(""),
        "yaxis": axis(""),
        "showlegend": len(traces) > 1,
        "moving": moving,
    }
    controls = [
        Control(word, names, start=at) for word, at in zip(("across", "up"), start, strict=True)
    ]
    words = f"Choose two numbers to see what one costs in the other; point at a mark. {note}"
    return Chart("Trade-off", traces, layout, controls, note=words.strip(), wide=True, tall=480)


def _ticks(column: Column) -> dict[str, Any]:
    if not column.kinds:
        return {"tickmode": "auto"}
    places = list(range(len(column.kinds)))
    return {"tickmode": "array", "tickvals": places, "ticktext": list(column.kinds)}


def across(
    title: str, varied: Sequence[Column], shown: Sequence[Column], colour: Column | None = None
) -> Chart:
    """Parallel coordinates: every point a line over parameters and numbers, in the ``colour`` of
    one of them, the last by default."""
    chosen = [*varied, *_different(shown)[:ACROSS]]
    colour = colour or chosen[-1]
    known = np.isfinite([each.values for each in chosen]).all(axis=0)
    dimensions = []
    for each in chosen:
        long = len(each.heading) > LONGEST
        label = f"…{each.heading[1 - LONGEST :]}" if long else each.heading
        dimension: dict[str, Any] = {"label": label, "values": each.values[known]}
        if each.kinds:
            dimension |= {"tickvals": list(range(len(each.kinds))), "ticktext": list(each.kinds)}
        dimensions.append(dimension)
    trace = {
        "type": "parcoords",
        "dimensions": dimensions,
        "line": {"color": colour.values[known], "colorscale": BLUE_TO_ORANGE},
        "labelangle": -12,
    }
    layout = {"margin": {"l": SIDES, "r": SIDES, "t": 120, "b": 30}}
    least = LEAST * (len(chosen) - 1) + 2 * SIDES
    note = f"Drag along an axis to keep the points within; colour follows {colour.heading}."
    return Chart(title, [trace], layout, note=note, wide=True, tall=480, least=least)


def _different(columns: Sequence[Column]) -> list[Column]:
    """Those that are not, but for rounding, a column before them."""
    kept: list[Column] = []
    for each in columns:
        alike = (np.allclose(each.values, k.values, rtol=1e-4, equal_nan=True) for k in kept)
        if not any(alike):
            kept.append(each)
    return kept


def table_of(title: str, columns: Sequence[Column], file: str) -> Table:
    """The first rows of columns whose whole is in a ``file``; the first heads its rows."""
    count = len(columns[0].words)
    rows = [[each.words[k] or "–" for each in columns] for k in range(min(count, MOST_ROWS))]
    note = f"The first {MOST_ROWS} of {count}; all are in {file}." if count > MOST_ROWS else ""
    return Table(title, [each.heading for each in columns], rows, note, folded=True)
