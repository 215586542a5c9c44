"""The folder of an identification as one HTML page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from rotordyn.errors import InvalidInput
from rotordyn.page.blocks import (
    Block,
    Chart,
    Control,
    Markup,
    Printed,
    Table,
    Text,
    sections,
)
from rotordyn.page.html import Page
from rotordyn.page.looks import COLOURS, FAINT, axis
from rotordyn.results.display import sized
from rotordyn.study.columns import Column, read_columns, table_of
from rotordyn.study.identification.certainty import (
    BY_ITS_PRIOR,
    ON_A_BOUND,
    UNFINISHED,
    UNIDENTIFIABLE,
)
from rotordyn.study.identification.curve_charts import Curves, curve_blocks
from rotordyn.study.identification.deliver import BEST, DATASET, SUMMARY
from rotordyn.study.identification.identification import INSUFFICIENT, SURVIVES, UNDECIDED
from rotordyn.study.identification.profile import AT_BOUND
from rotordyn.study.identification.searches import JOURNAL
from rotordyn.study.identification.summary import MOST_WRITTEN, decimals

FILES = (DATASET, JOURNAL)  # one of which a folder of an identification has
CELL, ROOM = 34, 190  # px of a row of correlations, and of what surrounds them
DOUBTS = (UNIDENTIFIABLE, BY_ITS_PRIOR, UNDECIDED, UNFINISHED)
RED_TO_BLUE = [[0.0, COLOURS[0]], [0.5, "#F2F2F2"], [1.0, COLOURS[1]]]


class Held(NamedTuple):
    """What is read of the folder: ``about`` it, its tables by name, ``correlation`` of the
    unknowns, ``threshold`` of profiles."""

    about: dict[str, Any]
    summary: str
    best: str
    tables: dict[str, dict[str, Column]]
    beside: list[str]
    correlation: list[list[float]]
    threshold: float
    date: str

    @property
    def verdict(self) -> list[str]:
        """In sentences."""
        return str(self.about["verdict"]).split("\n")

    @property
    def unknowns(self) -> list[str]:
        """Names of the unknowns."""
        return list(self.tables["values"]["name"].words)


def identification_page(folder: Path) -> Page:
    """What the page of an identification shows.

    Raises
    ------
    InvalidInput : the search did not end, or another version wrote it
    """
    held = _read(folder)
    first, *others = held.verdict
    grave = first.startswith(INSUFFICIENT)
    doubts = any(line.startswith(DOUBTS) for line in others)
    stopped = " Stopped before the end: the best so far." if held.about["stopped"] else ""
    return Page(
        title=str(held.about["title"]),
        about=["Identification: a case held against what was measured", held.date],
        verdict=f"{'✕' if grave else '⚠' if doubts or stopped else '✓'} {first}.{stopped}",
        grave=grave,
        sections=sections([*_blocks(held)]),
        footer=f"{held.about['source']}. {held.date}",
    )


def _read(folder: Path) -> Held:
    import xarray as xr

    try:
        with xr.open_dataset(folder / DATASET, engine="h5netcdf") as data:
            about, correlation = dict(data.attrs), data["correlation"].values.tolist()
            profiled, predicted = "profile_excess" in data, "prediction" in data.coords
            threshold = float(data["profile_excess"].attrs["threshold"]) if profiled else 0.0
        beside = [name for name in str(about["beside"]).split("\n") if name]
        names = ["values", "differences", "models", *beside]
        names += ["profiles"] * profiled + ["predictions"] * predicted
        tables = {name: _table(folder / f"{name}.csv") for name in names}
        summary = (folder / SUMMARY).read_text(encoding="utf-8").rstrip("\n")
        best = folder / BEST
        case = best.read_text(encoding="utf-8") if best.exists() else ""
        written = datetime.fromtimestamp((folder / DATASET).stat().st_mtime, UTC)
        date = f"{written:%Y-%m-%d %H:%M UTC}"
        held = Held(about, summary, case, tables, beside, correlation, threshold, date)
        tables["differences"]["along"], about["verdict"], about["stopped"]
    except (OSError, ValueError, KeyError, IndexError) as error:
        raise InvalidInput(
            f"{folder} holds an identification that is not complete, or of another version "
            f"({error}): the same rotordyn identify goes on with it"
        ) from None
    return held


def _table(path: Path) -> dict[str, Column]:
    return {column.heading: column for column in read_columns(path)}


def _blocks(held: Held) -> Iterator[tuple[str, Block]]:
    yield "Verdict", Text(held.verdict[1:], listed=True)
    yield "Verdict", _values(held)
    yield "Verdict", Printed("Summary", held.summary)
    if len(held.tables["models"]["model"].words) > 1:
        yield "Models by evidence", _models(held)
    if len(held.unknowns) > 1:
        yield "Correlation", _correlation(held)
    for block in curve_blocks(Curves.of(held.tables["differences"])):
        yield "Measured and computed", block
    for name in held.beside:
        title = name.replace("_", " ")
        columns = list(held.tables[name].values())
        yield "Measured and computed", table_of(title, columns, f"{name}.csv")
    if "profiles" in held.tables:
        yield "Profiles", _profiles(held)
    if "predictions" in held.tables:
        yield "Predictions", _predictions(held)
    if held.best:
        yield "The identified machine as a case", Printed(BEST, held.best)
    origin = [("made with", str(held.about["source"])), ("date", held.date)]
    origin.append(("SHA-256 of what was read", str(held.about.get("digest", ""))))
    yield "Origin", Table("Origin", ("", ""), origin)


def _values(held: Held) -> Table:
    """Every unknown with its interval, and the word about it."""
    of = held.tables["values"]
    profiled = "lower end by profile" in of
    rows = []
    for k, name in enumerate(held.unknowns):
        ends = [float(of[f"{end} end of 95 %"].values[k]) for end in ("lower", "upper")]
        value, unit = float(of["value"].values[k]), of["unit"].words[k]
        digits, word = decimals(ends[0], ends[1], value), of["verdict"].words[k]
        bounds = [float(of[f"{end} bound"].values[k]) for end in ("lower", "upper")]
        between = "–" if word == ON_A_BOUND else _between(ends, digits, bounds)
        cells = [f"{name} [{unit}]" if unit else name]
        cells += [sized(value, digits, *ends), between]
        if profiled:
            other = [float(of[f"{end} end by profile"].values[k]) for end in ("lower", "upper")]
            cells.append(_between(other, digits, bounds))
        rows.append([*cells, word, of["path"].words[k]])
    head = ["", "value", "95 %", *["by profile"] * profiled, "", "path"]
    return Table("What was found", head, rows)


def _between(ends: Sequence[float], digits: int, bounds: Sequence[float] = (np.nan, np.nan)) -> str:
    """Both ends, a word before one that is a bound."""
    if np.isnan(ends).any():
        return "–"
    pairs = zip(ends, bounds, strict=True)
    return " to ".join(
        AT_BOUND * (e == b) + " " * (e == b) + sized(e, digits, *ends) for e, b in pairs
    )


def _models(held: Held) -> Table:
    """Every model, its evidence and its values."""
    model, above, squares, *values = held.tables["models"].values()
    rows = []
    for k, name in enumerate(model.words):
        numbers = [each.values[k] for each in (above, squares, *values)]
        cells = [f"{value:.4g}" if np.isfinite(value) else "–" for value in numbers]
        kept = "yes" if above.values[k] <= SURVIVES else "no"
        rows.append([name, cells[0], kept, *cells[1:]])
    heads = [each.heading for each in (squares, *values)]
    note = f"A model whose BIC lies up to {SURVIVES:g} above the best is not ruled out."
    head = [model.heading, above.heading, "survives", *heads]
    return Table("Models by evidence", head, rows, note)


def _correlation(held: Held) -> Chart:
    """Correlations of the unknowns; empty of those on a bound."""
    names, count = held.unknowns, len(held.unknowns)
    known = [[value if np.isfinite(value) else None for value in row] for row in held.correlation]
    words = [["" if v is None else f"{v:.2f}".replace("-", "−") for v in row] for row in known]
    trace = {
        "type": "heatmap",
        "x": names,
        "y": names,
        "z": known,
        "zmin": -1.0,
        "zmax": 1.0,
        "colorscale": RED_TO_BLUE,
        "text": words,
        "hovertemplate": Markup("%{x}, %{y}: %{z:.3f}<extra></extra>"),
    }
    if count <= MOST_WRITTEN:
        trace |= {"texttemplate": "%{text}", "textfont": {"color": "#000000"}}
    layout = {
        "xaxis": axis("", type="category"),
        "yaxis": axis("", type="category", autorange="reversed"),
        "showlegend": False,
    }
    note = "±1: the data know only the difference, or the sum, of two."
    return Chart("Correlation", [trace], layout, note=note, wide=True, tall=ROOM + CELL * count)


def _profiles(held: Held) -> Chart:
    """χ² above the best over an unknown that is chosen, the parabola of its linear interval."""
    of, values = held.tables["profiles"], held.tables["values"]
    paths = list(dict.fromkeys(of["path"].words))
    lines: list[dict[str, list[list[float]]]] = [{"x": [], "y": []} for _ in range(3)]
    heads = []
    for path in paths:
        k = list(values["path"].words).index(path)
        rows = np.array([word == path for word in of["path"].words])
        at, excess = of["value"].values[rows], of["chi squared above the best"].values[rows]
        along = np.linspace(at.min(), at.max(), 61)
        best, size = (float(values[h].values[k]) for h in ("value", "standard deviation"))
        parabola = ((along - best) / size) ** 2 if size > 0.0 else np.full(len(along), np.nan)
        ends = [float(at.min()), float(at.max())]
        drawn = ((at, excess), (along, parabola), (ends, [held.threshold] * 2))
        for line, (x, y) in zip(lines, drawn, strict=True):
            line["x"].append(list(x))
            line["y"].append(list(y))
        heads.append(f"{values['name'].words[k]} [{values['unit'].words[k] or '–'}]")
    looks = (
        {"name": "profile", "mode": "lines+markers", "line": {"color": COLOURS[0]}},
        {"name": "linear", "mode": "lines", "line": {"color": FAINT, "dash": "dash"}},
        {"name": "95 %", "mode": "lines", "line": {"color": COLOURS[1]}},
    )
    traces = [{**look, "moving": line} for look, line in zip(looks, lines, strict=True)]
    layout = {
        "xaxis": axis(""),
        "yaxis": axis("χ² above the best"),
        "moving": {"xaxis.title.text": heads},
    }
    note = "All others are sought anew at each value; the interval ends where the line is met."
    controls = [Control("unknown", heads)]
    return Chart("Profiles", traces, layout, controls, note=note, wide=True)


def _predictions(held: Held) -> Table:
    """Numbers of the identified machine."""
    of = held.tables["predictions"]
    several = "least over surviving models" in of
    pairs = [("low", "high")]
    pairs += [("least over surviving models", "most over surviving models")] * several
    rows = []
    for k, name in enumerate(of["name"].words):
        unit = of["unit"].words[k]
        low, high, value = (float(of[end].values[k]) for end in ("low", "high", "value"))
        digits = decimals(low, high, value)
        cells = [f"{name} [{unit}]" if unit else name, sized(value, digits, low, high)]
        bound = of[ON_A_BOUND].words[k] if ON_A_BOUND in of else ""
        parts = [_between([float(of[end].values[k]) for end in pair], digits) for pair in pairs]
        cells += [f"–, {bound} {ON_A_BOUND}" if bound else parts[0], *parts[1:]]
        known = of["measured"].values[k]
        rows.append([*cells, f"{known:.4g}" if np.isfinite(known) else "–"])
    head = ["", "value", "95 %", *["over surviving models"] * several, "measured"]
    note = "The interval does not know what the model lacks."
    return Table("Predictions", head, rows, note)
