"""The table of a study or an optimum, read from its file, and the charts that the page makes of it:
a scatter chart, parallel coordinates, the table itself."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from rotordyn.arrays import Array, Flags
from rotordyn.page.blocks import Chart, Control, Markup, Table
from rotordyn.page.looks import COLOURS, axis

MOST_ROWS = 500  # of the table on the page
MOST_LISTED = 12  # values of a parameter; of more, only the lowest and highest are listed
ALONG = 6  # results shown after the parameters in parallel coordinates
LEAST, SIDES = 120, 115  # px between axes of parallel coordinates, and for labels at both sides
LONGEST = 28  # characters of an axis label
BLUE_TO_ORANGE = [[0.0, COLOURS[0]], [1.0, COLOURS[1]]]  # visible on light and dark backgrounds


class Column(NamedTuple):
    """A column: its heading, its cells as text ``words`` and as numbers ``values`` (points,), NaN
    where a cell is empty. If the cells are not numbers, ``kinds`` are the distinct texts and
    ``values`` indices into them.
    """

    heading: str
    words: Sequence[str]
    values: Array
    kinds: Sequence[str] = ()

    @property
    def moves(self) -> bool:
        """Whether the column is numeric and its values differ."""
        finite = self.values[np.isfinite(self.values)]
        return not self.kinds and finite.size > 0 and float(np.ptp(finite)) > 0.0


class Group(NamedTuple):
    """A group of points drawn with one ``marker``; ``chosen`` (points,) flags its members."""

    name: str
    chosen: Flags
    marker: dict[str, Any]


def read_columns(path: Path) -> list[Column]:
    """Read a CSV table whose first row holds the headings.

    Raises
    ------
    OSError, ValueError : the file does not exist, or is not a table
    """
    with path.open(newline="", encoding="utf-8-sig") as file:
        headings, *rows = csv.reader(file)
    return [_column(heading, [row[k] for row in rows]) for k, heading in enumerate(headings)]


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
    """Table of the parameters and their values."""
    return Table(title, ("path", "values"), [*_varied(columns)])


def _varied(columns: Sequence[Column]) -> Iterator[tuple[str, str]]:
    for each in columns:
        if each.kinds:
            yield each.heading, ", ".join(each.kinds)
        else:
            values = np.unique(each.values)
            few = ", ".join(f"{v:.6g}" for v in values)
            many = f"{values[0]:.6g} to {values[-1]:.6g}, {len(values)} values"
            yield each.heading, few if len(values) <= MOST_LISTED else many


def plain_group(count: int) -> Group:
    """Group of all points, with one marker."""
    marker = {"color": COLOURS[0], "size": 7, "opacity": 0.75}
    return Group("points", np.ones(count, dtype=bool), marker)


def scatter(
    varied: Sequence[Column],
    shown: Sequence[Column],
    groups: Sequence[Group],
    start: tuple[int, int],
) -> Chart:
    """Scatter chart of any column over any other, with a marker for every point.

    ``start``: indices of the columns that are shown at first, horizontally and vertically.
    """
    columns = [*varied, *shown]
    values = np.array([each.values for each in columns])
    words = [
        ", ".join(f"{each.heading} {each.words[k]}" for each in varied)
        for k in range(values.shape[1])
    ]
    traces = [
        {
            "mode": "markers",
            "name": group.name,
            "moving": {
                along: {"by": (number,), "values": values[:, group.chosen]}
                for number, along in enumerate("xy")
            },
            "text": [words[k] for k in np.flatnonzero(group.chosen)],
            "hovertemplate": Markup("%{x:.5g}, %{y:.5g}<br>%{text}<extra></extra>"),
            "marker": group.marker,
        }
        for group in groups
        if group.chosen.any()
    ]
    layout = {
        "xaxis": axis(""),
        "yaxis": axis(""),
        "showlegend": len(traces) > 1,
        "moving": _moving("xaxis", 0, columns) | _moving("yaxis", 1, columns),
    }
    names = [each.heading for each in columns]
    controls = [
        Control(word, names, start=at) for word, at in zip(("across", "up"), start, strict=True)
    ]
    note = "Choose two numbers to see their trade-off; move the pointer over a mark for its values."
    return Chart("Trade-off", traces, layout, controls, note=note, wide=True, tall=480)


def _moving(axis_name: str, control: int, columns: Sequence[Column]) -> dict[str, Any]:
    """Axis title and ticks of each column, by the state of the ``control`` that selects it."""
    properties = {
        "title.text": [each.heading for each in columns],
        "tickmode": ["array" if each.kinds else "auto" for each in columns],
        "tickvals": [[*range(len(each.kinds))] or None for each in columns],
        "ticktext": [[*each.kinds] or None for each in columns],
    }
    return {f"{axis_name}.{key}": {"by": (control,), "values": v} for key, v in properties.items()}


def parallel_coordinates(
    title: str, varied: Sequence[Column], shown: Sequence[Column], colour: Column | None = None
) -> Chart:
    """Parallel coordinates: every point is a line across parameters and results; ``colour`` is the
    column that colours the lines, the last one by default.

    Results that are missing at a solved point, such as the speed at which a stop closes, get no
    axis, since a line must cross all axes.
    """
    solved = np.isfinite([each.values for each in shown]).any(axis=0)
    complete = [each for each in shown if np.isfinite(each.values[solved]).all()] or shown
    chosen = [*varied, *_different(complete)[:ALONG]]
    colour = colour or chosen[-1]
    drawn = np.asarray(np.isfinite([each.values for each in (*chosen, colour)]).all(axis=0))
    trace = {
        "type": "parcoords",
        "dimensions": [_dimension(each, drawn) for each in chosen],
        "line": {"color": colour.values[drawn], "colorscale": BLUE_TO_ORANGE},
        "labelangle": -12,
    }
    layout = {"margin": {"l": SIDES, "r": SIDES, "t": 120, "b": 30}}
    least_width = LEAST * (len(chosen) - 1) + 2 * SIDES
    note = f"Drag along an axis to select points; colour follows {colour.heading}."
    if lacking := [each.heading for each in shown if not any(each is kept for kept in complete)]:
        note += f" Without an axis, since not every point has it: {', '.join(lacking)}."
    if missing := int((solved & ~drawn).sum()):
        note += f" {missing} of {int(solved.sum())} points lack one of these numbers: no line."
    return Chart(title, [trace], layout, note=note, wide=True, tall=480, least=least_width)


def _dimension(column: Column, known: Flags) -> dict[str, Any]:
    """Axis of parallel coordinates; a long heading keeps its end, which is the specific part."""
    heading = column.heading
    label = f"…{heading[1 - LONGEST :]}" if len(heading) > LONGEST else heading
    ticks = {"tickvals": [*range(len(column.kinds))], "ticktext": [*column.kinds]}
    return {"label": label, "values": column.values[known]} | (ticks if column.kinds else {})


def _different(columns: Sequence[Column]) -> list[Column]:
    """Drop columns that equal an earlier one to within rounding."""
    kept: list[Column] = []
    for each in columns:
        duplicates = (np.allclose(each.values, k.values, rtol=1e-4, equal_nan=True) for k in kept)
        if not any(duplicates):
            kept.append(each)
    return kept


def table_of(title: str, columns: Sequence[Column], file: str) -> Table:
    """Table of the first rows; all rows are in ``file``. The first column labels the rows."""
    count = len(columns[0].words)
    rows = [[each.words[k] or "–" for each in columns] for k in range(min(count, MOST_ROWS))]
    note = f"The first {MOST_ROWS} of {count}; all are in {file}." if count > MOST_ROWS else ""
    return Table(title, [each.heading for each in columns], rows, note, folded=True)
