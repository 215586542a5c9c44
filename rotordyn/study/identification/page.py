"""HTML page of the folder of an identification."""

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

FILES = (DATASET, JOURNAL)  # the folder of an identification has one of them
CELL, ROOM = 34, 190  # px: height of a row of correlations, and of title, ticks and margins
DOUBTS = (UNIDENTIFIABLE, BY_ITS_PRIOR, UNDECIDED, UNFINISHED)
RED_TO_BLUE = [[0.0, COLOURS[0]], [0.5, "#F2F2F2"], [1.0, COLOURS[1]]]


class Held(NamedTuple):
    """Content of the folder: attributes ``about`` it, tables by name, ``correlation`` of the
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
        """Sentences of the verdict."""
        return str(self.about["verdict"]).split("\n")

    @property
    def unknowns(self) -> list[str]:
        """Names of the unknowns."""
        return list(self.tables["values"]["name"].words)


def identification_page(folder: Path) -> Page:
    """Build the page of an identification.

    Raises
    ------
    InvalidInput : the search did not end, or another version wrote the folder
    """
    content = _read(folder)
    first, *others = content.verdict
    grave = first.startswith(INSUFFICIENT)
    doubts = any(line.startswith(DOUBTS) for line in others)
    stopped = " Stopped before the end: the best so far." if content.about["stopped"] else ""
    return Page(
        title=str(content.about["title"]),
        about=["Identification: a case compared with measurements", content.date],
        verdict=f"{'✕' if grave else '⚠' if doubts or stopped else '✓'} {first}.{stopped}",
        grave=grave,
        sections=sections([*_blocks(content)]),
        footer=f"{content.about['source']}. {content.date}",
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
        content = Held(about, summary, case, tables, beside, correlation, threshold, date)
        tables["differences"]["along"], about["verdict"], about["stopped"]
    except (OSError, ValueError, KeyError, IndexError) as error:
        raise InvalidInput(
            f"{folder} holds an identification that is not complete, or of another version "
            f"({error}): the same rotordyn identify goes on with it"
        ) from None
    return content


def _table(path: Path) -> dict[str, Column]:
    return {column.heading: column for column in read_columns(path)}


def _blocks(content: Held) -> Iterator[tuple[str, Block]]:
    yield "Verdict", Text(content.verdict[1:], listed=True)
    yield "Verdict", _values(content)
    yield "Verdict", Printed("Summary", content.summary)
    if len(content.tables["models"]["model"].words) > 1:
        yield "Models by evidence", _models(content)
    if len(content.unknowns) > 1:
        yield "Correlation", _correlation(content)
    for block in curve_blocks(Curves.of(content.tables["differences"])):
        yield "Measured and computed", block
    for name in content.beside:
        title = name.replace("_", " ")
        columns = list(content.tables[name].values())
        yield "Measured and computed", table_of(title, columns, f"{name}.csv")
    if "profiles" in content.tables:
        yield "Profiles", _profiles(content)
    if "predictions" in content.tables:
        yield "Predictions", _predictions(content)
    if content.best:
        yield "The identified machine as a case", Printed(BEST, content.best)
    origin = [("made with", str(content.about["source"])), ("date", content.date)]
    origin.append(("SHA-256 of what was read", str(content.about.get("digest", ""))))
    yield "Origin", Table("Origin", ("", ""), origin)


def _values(content: Held) -> Table:
    """Table of the unknowns with interval and verdict."""
    table = content.tables["values"]
    profiled = "lower end by profile" in table
    rows = []
    for k, name in enumerate(content.unknowns):
        ends = [float(table[f"{end} end of 95 %"].values[k]) for end in ("lower", "upper")]
        value, unit = float(table["value"].values[k]), table["unit"].words[k]
        digits, word = decimals(ends[0], ends[1], value), table["verdict"].words[k]
        bounds = [float(table[f"{end} bound"].values[k]) for end in ("lower", "upper")]
        between = "–" if word == ON_A_BOUND else _between(ends, digits, bounds)
        cells = [f"{name} [{unit}]" if unit else name]
        cells += [sized(value, digits, *ends), between]
        if profiled:
            other = [float(table[f"{end} end by profile"].values[k]) for end in ("lower", "upper")]
            cells.append(_between(other, digits, bounds))
        rows.append([*cells, word, table["path"].words[k]])
    head = ["", "value", "95 %", *["by profile"] * profiled, "", "path"]
    return Table("What was found", head, rows)


def _between(ends: Sequence[float], digits: int, bounds: Sequence[float] = (np.nan, np.nan)) -> str:
    """Text of both ends of an interval; an end that is a bound is marked."""
    if np.isnan(ends).any():
        return "–"
    pairs = zip(ends, bounds, strict=True)
    return " to ".join(
        AT_BOUND * (e == b) + " " * (e == b) + sized(e, digits, *ends) for e, b in pairs
    )


def _models(content: Held) -> Table:
    """Table of the models with evidence and values."""
    model, above, squares, *values = content.tables["models"].values()
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


def _correlation(content: Held) -> Chart:
    """Heat map of the correlations of the unknowns; blank for those on a bound."""
    names, count = content.unknowns, len(content.unknowns)
    known = [
        [value if np.isfinite(value) else None for value in row] for row in content.correlation
    ]
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
    note = "±1: the data determine only the difference, or the sum, of two."
    return Chart("Correlation", [trace], layout, note=note, wide=True, tall=ROOM + CELL * count)


def _profiles(content: Held) -> Chart:
    """Chart of χ² above the best over a selected unknown, with the parabola of linear intervals."""
    table, values = content.tables["profiles"], content.tables["values"]
    paths = list(dict.fromkeys(table["path"].words))
    lines: list[dict[str, list[list[float]]]] = [{"x": [], "y": []} for _ in range(3)]
    heads = []
    for path in paths:
        k = list(values["path"].words).index(path)
        rows = np.array([word == path for word in table["path"].words])
        at, excess = table["value"].values[rows], table["chi squared above the best"].values[rows]
        along = np.linspace(at.min(), at.max(), 61)
        best, size = (float(values[h].values[k]) for h in ("value", "standard deviation"))
        parabola = ((along - best) / size) ** 2 if size > 0.0 else np.full(len(along), np.nan)
        ends = [float(at.min()), float(at.max())]
        drawn = ((at, excess), (along, parabola), (ends, [content.threshold] * 2))
        for line, (x, y) in zip(lines, drawn, strict=True):
            line["x"].append(list(x))
            line["y"].append(list(y))
        heads.append(f"{values['name'].words[k]} [{values['unit'].words[k] or '–'}]")
    styles = (
        {"name": "profile", "mode": "lines+markers", "line": {"color": COLOURS[0]}},
        {"name": "linear", "mode": "lines", "line": {"color": FAINT, "dash": "dash"}},
        {"name": "95 %", "mode": "lines", "line": {"color": COLOURS[1]}},
    )
    traces = [{**style, "moving": line} for style, line in zip(styles, lines, strict=True)]
    layout = {
        "xaxis": axis(""),
        "yaxis": axis("χ² above the best"),
        "moving": {"xaxis.title.text": heads},
    }
    note = "All others are identified again at each value; the interval ends at the line."
    controls = [Control("unknown", heads)]
    return Chart("Profiles", traces, layout, controls, note=note, wide=True)


def _predictions(content: Held) -> Table:
    """Table of the predicted numbers."""
    table = content.tables["predictions"]
    several = "least over surviving models" in table
    pairs = [("low", "high")]
    pairs += [("least over surviving models", "most over surviving models")] * several
    rows = []
    for k, name in enumerate(table["name"].words):
        unit = table["unit"].words[k]
        low, high, value = (float(table[end].values[k]) for end in ("low", "high", "value"))
        digits = decimals(low, high, value)
        cells = [f"{name} [{unit}]" if unit else name, sized(value, digits, low, high)]
        bound = table[ON_A_BOUND].words[k] if ON_A_BOUND in table else ""
        parts = [_between([float(table[end].values[k]) for end in pair], digits) for pair in pairs]
        cells += [f"–, {bound} {ON_A_BOUND}" if bound else parts[0], *parts[1:]]
        known = table["measured"].values[k]
        rows.append([*cells, f"{known:.4g}" if np.isfinite(known) else "–"])
    head = ["", "value", "95 %", *["over surviving models"] * several, "measured"]
    note = "The interval does not include errors of the model."
    return Table("Predictions", head, rows, note)
