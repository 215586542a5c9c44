"""The folder of a run or of a study as one HTML page."""

from __future__ import annotations

import csv
import math
import os
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from bearings.arguments import typed
from rotordyn.errors import InvalidInput
from rotordyn.page.blocks import Block, Chart, Control, Printed, Table, Text, sections
from rotordyn.page.html import Page, html
from rotordyn.page.looks import COLOURS, axis
from rotordyn.results.kinds import Array
from rotordyn.study.summary import NUMBER

STUDY, TABLE, POINTS, SUMMARY = "study.nc", "points.csv", "points.jsonl", "summary.txt"
MOST_ROWS = 500
ACROSS = 6  # numbers beside the parameters of parallel coordinates
MOST_REASONS = 12
LEAST = 100  # px for each axis of parallel coordinates


class Column(NamedTuple):
    """What was varied or what came of it: its heading, its words, and as numbers the values or, of
    ``words`` that are none, their places among ``kinds``."""

    heading: str
    words: Sequence[str]
    values: Array
    kinds: Sequence[str] = ()


class Held(NamedTuple):
    """What is read of the folder of a study."""

    title: str
    summary: str
    varied: list[Column]
    numbers: list[Column]
    sentences: Sequence[str]
    warnings: Sequence[str]
    origin: list[tuple[str, str]]


@typed(InvalidInput)
def write_report(folder: str | Path, path: str | Path) -> Path:
    """Write the results in ``folder``, of a run or a study, as one self-contained HTML page.

    Returns ``path``. The page opens without network. Takes the package plotly (extra ``report``).

    Raises
    ------
    InvalidInput : no results folder, half of one, one of another version; no file can be written
    """
    folder, path = Path(folder), Path(path)
    if not any(os.path.exists(folder / name) for name in (STUDY, POINTS)):
        from rotordyn.job import open as opened

        return opened(folder).report(path)
    text = html(_page(_read(folder)))
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise InvalidInput(f"{path} cannot be written: {error.strerror}") from error
    return path


def _read(folder: Path) -> Held:
    import xarray as xr

    try:
        with xr.open_dataset(folder / STUDY, engine="h5netcdf") as data:
            about, count = dict(data.attrs), len(data.coords)
        with (folder / TABLE).open(newline="", encoding="utf-8-sig") as file:
            heads, *rows = csv.reader(file)
        summary = (folder / SUMMARY).read_text(encoding="utf-8").rstrip("\n")
        columns = [_column(head, [row[k] for row in rows]) for k, head in enumerate(heads)]
        written = datetime.fromtimestamp((folder / STUDY).stat().st_mtime, UTC)
        title = str(about["title"])
        source = str(about["source"])
    except (OSError, ValueError, KeyError, IndexError) as error:
        raise InvalidInput(
            f"{folder} holds a study that is not complete, or of another version ({error}): the "
            "same rotordyn sweep goes on with it"
        ) from None
    origin = [("made with", source), ("date", f"{written:%Y-%m-%d %H:%M UTC}")]
    origin.append(("SHA-256 of what was read", str(about.get("digest", ""))))
    numbers = columns[1 + count : -2]
    return Held(
        title,
        summary,
        columns[1 : 1 + count],
        numbers,
        columns[-2].words,
        columns[-1].words,
        origin,
    )


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


def _page(held: Held) -> Page:
    count, lost = len(held.sentences), sum(map(bool, held.sentences))
    warned = sum(map(bool, held.warnings))
    said = f"{'✕' if lost == count else '⚠' if lost or warned else '✓'} {count} points"
    said += f", {lost} of them with no solution at some or all speeds" if lost else ", all solved"
    said += f"; {warned} with warnings." if warned else "; no warnings."
    return Page(
        title=held.title,
        about=["Study: one case at many points", held.origin[1][1]],
        verdict=said,
        grave=lost == count,
        sections=sections([*_blocks(held)]),
        footer=f"{held.origin[0][1]}. {held.origin[1][1]}",
    )


def _blocks(held: Held) -> Iterator[tuple[str, Block]]:
    for title, words in (("Not solved", held.sentences), ("Warnings", held.warnings)):
        if said := [*_counted(words)]:
            yield "Verdict", Text(said, listed=True, title=title)
    yield "Verdict", Printed("Summary", held.summary)
    yield "What was varied", Table("What was varied", ("path", "values"), [*_varied(held.varied)])
    shown = [each for each in held.numbers if _moves(each)]
    if shown:
        yield "Trade-off", _trade_off(held.varied, shown)
        yield "Points across", _across(held.varied, shown)
    else:
        yield "Trade-off", Text(["No number changes over what was varied."])
    yield "Points", _table(held)
    yield "Origin", Table("Origin", ("", ""), held.origin)


def _counted(cells: Sequence[str]) -> Iterator[str]:
    """Each sentence of the points once, those that differ by numbers alone together."""
    alike: dict[str, list[str]] = {}
    for sentence in (each for cell in cells for each in cell.split(" | ") if each):
        alike.setdefault(NUMBER.sub("", sentence), []).append(sentence)
    found = sorted(alike.values(), key=len, reverse=True)
    for each in found[:MOST_REASONS]:
        points = f"{len(each)} point{'s' if len(each) > 1 else ''}"
        yield f"{points}{', such as' if len(set(each)) > 1 else ''}: {each[0]}"
    if len(found) > MOST_REASONS:
        yield f"{len(found) - MOST_REASONS} more kinds, listed in {TABLE}"


def _varied(columns: Sequence[Column]) -> Iterator[tuple[str, str]]:
    for each in columns:
        if each.kinds:
            yield each.heading, ", ".join(each.kinds)
        else:
            values = np.unique(each.values)
            few = ", ".join(f"{v:.6g}" for v in values)
            many = f"{values[0]:.6g} to {values[-1]:.6g}, {len(values)} values"
            yield each.heading, few if len(values) <= 12 else many


def _moves(each: Column) -> bool:
    known = each.values[np.isfinite(each.values)]
    return not each.kinds and known.size > 0 and float(np.ptp(known)) > 0.0


def _trade_off(varied: Sequence[Column], shown: Sequence[Column]) -> Chart:
    """Any of them over any other, a mark for every point."""
    columns = [*varied, *shown]
    names = [each.heading for each in columns]
    points = [
        ", ".join(f"{each.heading} {each.words[k]}" for each in varied)
        for k in range(len(columns[0].words))
    ]
    values = np.array([each.values for each in columns])
    trace = {
        "mode": "markers",
        "moving": {"x": {"by": (0,), "values": values}, "y": {"by": (1,), "values": values}},
        "text": points,
        "hovertemplate": "%{x:.5g}, %{y:.5g}<br>%{text}<extra></extra>",
        "marker": {"color": COLOURS[0], "size": 7, "opacity": 0.75},
    }
    ticks = [
        {"tickmode": "array", "tickvals": list(range(len(e.kinds))), "ticktext": list(e.kinds)}
        if e.kinds
        else {"tickmode": "auto"}
        for e in columns
    ]
    moving: dict[str, Any] = {}
    for number, which in enumerate(("xaxis", "yaxis")):
        moving[f"{which}.title.text"] = {"by": (number,), "values": names}
        for key in ("tickmode", "tickvals", "ticktext"):
            found = [each.get(key) for each in ticks]
            moving[f"{which}.{key}"] = {"by": (number,), "values": found}
    layout = {"xaxis": axis(""), "yaxis": axis(""), "showlegend": False, "moving": moving}
    first = next((k for k, each in enumerate(varied) if not each.kinds), 0)
    second = len(varied)
    controls = [Control("across", names, start=first), Control("up", names, start=second)]
    note = "Choose two numbers to see what one costs in the other; point at a mark for its values."
    return Chart("Trade-off", [trace], layout, controls, note=note, wide=True, tall=480)


def _across(varied: Sequence[Column], shown: Sequence[Column]) -> Chart:
    """Parallel coordinates: every point a line over parameters and numbers."""
    chosen = [*varied, *_different(shown)[:ACROSS]]
    known = np.isfinite([each.values for each in chosen]).all(axis=0)
    dimensions = []
    for each in chosen:
        label = each.heading if len(each.heading) <= 34 else f"…{each.heading[-33:]}"
        dimension: dict[str, Any] = {"label": label, "values": each.values[known]}
        if each.kinds:
            dimension |= {"tickvals": list(range(len(each.kinds))), "ticktext": list(each.kinds)}
        dimensions.append(dimension)
    trace = {
        "type": "parcoords",
        "dimensions": dimensions,
        "line": {"color": chosen[-1].values[known], "colorscale": "Viridis"},
        "labelangle": -12,
    }
    layout = {"margin": {"l": 90, "r": 90, "t": 120, "b": 30}}
    note = f"Drag along an axis to keep the points within; colour follows {chosen[-1].heading}."
    return Chart(
        "Points across", [trace], layout, note=note, wide=True, tall=480, least=LEAST * len(chosen)
    )


def _different(columns: Sequence[Column]) -> list[Column]:
    """Those that are not, but for rounding, a column before them."""
    kept: list[Column] = []
    for each in columns:
        alike = (np.allclose(each.values, k.values, rtol=1e-4, equal_nan=True) for k in kept)
        if not any(alike):
            kept.append(each)
    return kept


def _table(held: Held) -> Table:
    columns = [*held.varied, *held.numbers]
    count = len(held.sentences)
    rows = [
        [str(k), *(each.words[k] or "–" for each in columns), held.sentences[k]]
        for k in range(min(count, MOST_ROWS))
    ]
    note = f"The first {MOST_ROWS} of {count}; all are in {TABLE}." if count > MOST_ROWS else ""
    heads = ["point", *(each.heading for each in columns), "not solved"]
    return Table("Points", heads, rows, note, folded=True)
