"""The table of a study or an optimum read back, and what its page shows of it: a scatter chart,
parallel coordinates, the table itself."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from rotordyn.page.blocks import Chart, Control, Markup, Table
from rotordyn.page.looks import COLOURS, axis
from rotordyn.results.kinds import Array, Flags

MOST_ROWS = 500  # of the table on the page
MOST_LISTED = 12  # values of what was varied; of more, lowest and highest
ALONG = 6  # numbers beside the parameters of parallel coordinates
LEAST, SIDES = 120, 115  # px from axis to axis of parallel coordinates, and for labels beside them
LONGEST = 28  # letters of its label
BLUE_TO_ORANGE = [[0.0, COLOURS[0]], [1.0, COLOURS[1]]]  # seen on light and on dark


class Column(NamedTuple):
    """A column: its heading, its cells as ``words``, and as numbers ``values`` (points,), NaN of
    empty cells. Of words that are no numbers these are places among ``kinds``, the different ones.
    """

    heading: str
    words: Sequence[str]
    values: Array
    kinds: Sequence[str] = ()

    @property
    def moves(self) -> bool:
        """Whether it is a number that is not the same at all points."""
        known = self.values[np.isfinite(self.values)]
        return not self.kinds and known.size > 0 and float(np.ptp(known)) > 0.0


class Group(NamedTuple):
    """Points of a kind, and how they are marked: ``chosen`` (points,)."""

    name: str
    chosen: Flags
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
            yield each.heading, few if len(values) <= MOST_LISTED else many


def plain_group(count: int) -> Group:
    """All points alike."""
    marker = {"color": COLOURS[0], "size": 7, "opacity": 0.75}
    return Group("points", np.ones(count, dtype=bool), marker)


def scatter(
    varied: Sequence[Column],
    shown: Sequence[Column],
    groups: Sequence[Group],
    start: tuple[int, int],
) -> Chart:
    """Any column over any other, a mark for every point.

    ``start``: places among all of the columns that are across and up at first.
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
    note = "Choose two numbers to see what one costs in the other; point at a mark."
    return Chart("Trade-off", traces, layout, controls, note=note, wide=True, tall=480)


def _moving(which: str, control: int, columns: Sequence[Column]) -> dict[str, Any]:
    """What an axis takes from the column that its control has chosen: title and ticks."""
    looks = {
        "title.text": [each.heading for each in columns],
        "tickmode": ["array" if each.kinds else "auto" for each in columns],
        "tickvals": [[*range(len(each.kinds))] or None for each in columns],
        "ticktext": [[*each.kinds] or None for each in columns],
    }
    return {f"{which}.{key}": {"by": (control,), "values": v} for key, v in looks.items()}


def parallel_coordinates(
    title: str, varied: Sequence[Column], shown: Sequence[Column], colour: Column | None = None
) -> Chart:
    """Every point as a line over what was varied and some numbers, in the ``colour`` of one of
    these, the last by default.

    Numbers that some solved point lacks, such as the speed of a stop that is not met, have no axis:
    a line goes through all of them.
    """
    solved = np.isfinite([each.values for each in shown]).any(axis=0)
    whole = [each for each in shown if np.isfinite(each.values[solved]).all()] or shown
    chosen = [*varied, *_different(whole)[:ALONG]]
    colour = colour or chosen[-1]
    known = np.asarray(np.isfinite([each.values for each in (*chosen, colour)]).all(axis=0))
    trace = {
        "type": "parcoords",
        "dimensions": [_dimension(each, known) for each in chosen],
        "line": {"color": colour.values[known], "colorscale": BLUE_TO_ORANGE},
        "labelangle": -12,
    }
    layout = {"margin": {"l": SIDES, "r": SIDES, "t": 120, "b": 30}}
    least = LEAST * (len(chosen) - 1) + 2 * SIDES
    note = f"Drag along an axis to keep the points within; colour follows {colour.heading}."
    if lacking := [each.heading for each in shown if not any(each is kept for kept in whole)]:
        note += f" Without an axis, since not every point has it: {', '.join(lacking)}."
    if missing := int((solved & ~known).sum()):
        note += f" {missing} of {int(solved.sum())} points lack one of these numbers: no line."
    return Chart(title, [trace], layout, note=note, wide=True, tall=480, least=least)


def _dimension(column: Column, known: Flags) -> dict[str, Any]:
    """An axis of parallel coordinates; the end of a long heading tells most."""
    heading = column.heading
    label = f"…{heading[1 - LONGEST :]}" if len(heading) > LONGEST else heading
    ticks = {"tickvals": [*range(len(column.kinds))], "ticktext": [*column.kinds]}
    return {"label": label, "values": column.values[known]} | (ticks if column.kinds else {})


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
