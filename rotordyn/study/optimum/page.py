"""HTML page of the folder of an optimum."""

from __future__ import annotations

import json
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from rotordyn.errors import InvalidInput
from rotordyn.page.blocks import Block, Chart, Printed, Table, Text, sections
from rotordyn.page.html import Page
from rotordyn.page.looks import COLOURS, FAINT, INK
from rotordyn.study.columns import (
    Column,
    Group,
    parallel_coordinates,
    read_columns,
    scatter,
    table_of,
    varied_table,
)
from rotordyn.study.optimum.summary import ABOUT, BEST, SUMMARY, TABLE

ENDS = 2  # last columns of the table: whether all limits are kept, why not solved


class OptimumFolder(NamedTuple):
    """Content of the folder: data ``about`` the search, and its table in parts."""

    about: dict[str, Any]
    summary: str
    best: str
    trial: Column
    varied: list[Column]
    values: list[Column]
    ends: list[Column]
    date: str


def optimum_page(folder: Path) -> Page:
    """Build the page of an optimum.

    Raises
    ------
    InvalidInput : the search did not end, or another version wrote the folder
    """
    optimum = _read(folder)
    has_best = optimum.about["best"] is not None
    feasible = sum(word == "yes" for word in optimum.ends[0].words)
    count, sign = len(optimum.trial.words), "✓" if has_best else "✕"
    verdict = f"{sign} {count} trials, {feasible} of them keep all limits"
    return Page(
        title=optimum.about["title"],
        about=["Optimum: the best of the allowed designs", optimum.date],
        verdict=f"{verdict}. {optimum.about['verdict'][0]}",
        grave=not has_best,
        sections=sections([*_blocks(optimum)]),
        footer=f"{optimum.about['source']}. {optimum.date}",
    )


def _read(folder: Path) -> OptimumFolder:
    try:
        about = json.loads((folder / ABOUT).read_text(encoding="utf-8"))
        trial, *columns = read_columns(folder / TABLE)
        summary = (folder / SUMMARY).read_text(encoding="utf-8").rstrip("\n")
        file = folder / BEST
        best = file.read_text(encoding="utf-8") if file.exists() else ""
        written = datetime.fromtimestamp((folder / ABOUT).stat().st_mtime, UTC)
        count = about["parameters"]
        parts = columns[:count], columns[count:-ENDS], columns[-ENDS:]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InvalidInput(
            f"{folder} holds an optimum that is not complete, or of another version ({error}): the "
            "same rotordyn optimise goes on with it"
        ) from None
    return OptimumFolder(about, summary, best, trial, *parts, f"{written:%Y-%m-%d %H:%M UTC}")


def _blocks(optimum: OptimumFolder) -> Iterator[tuple[str, Block]]:
    about = optimum.about
    heading, *rows = about["rows"]
    yield "Verdict", Table("The case and what was found", heading, rows)
    yield "Verdict", Text(about["verdict"])
    if about["warnings"]:
        yield "Verdict", Text(about["warnings"], listed=True, title="Warnings")
    yield "Verdict", Printed("Summary", optimum.summary)
    yield "What may be chosen", varied_table("What was tried", optimum.varied)
    goals, limits = optimum.values[: about["goals"]], optimum.values[about["goals"] :]
    shown = [*goals, *(each for each in limits if each.moves)]
    yield "Trade-off", _scatter(optimum, shown)
    yield "Trials across", parallel_coordinates("Trials across", optimum.varied, shown, goals[0])
    columns = [optimum.trial, *optimum.varied, *optimum.values, *optimum.ends]
    yield "Trials", table_of("Trials", columns, TABLE)
    if optimum.best:
        yield "The best as a case", Printed(BEST, optimum.best)
    origin = [("made with", about["source"]), ("date", optimum.date)]
    yield (
        "Origin",
        Table("Origin", ("", ""), [*origin, ("SHA-256 of what was read", about["digest"])]),
    )


def _scatter(optimum: OptimumFolder, shown: list[Column]) -> Chart:
    """Scatter chart, at first of the two goals, or of the goal over the first numeric parameter."""
    about, count = optimum.about, len(optimum.trial.words)
    feasible = np.array([word == "yes" for word in optimum.ends[0].words])
    front, best = (np.isin(np.arange(count), each) for each in (about["front"], [about["best"]]))
    ring = {"line": {"width": 1, "color": INK}}
    groups = [
        Group("breaks a limit", ~feasible, {"color": FAINT, "size": 7, "symbol": "x-thin-open"}),
        Group("keeps all limits", feasible, {"color": COLOURS[0], "size": 7, "opacity": 0.75}),
        Group("trade-off", front, {"color": COLOURS[1], "size": 9, "symbol": "diamond", **ring}),
        Group("best", best, {"color": COLOURS[4], "size": 14, "symbol": "star", **ring}),
    ]
    first = next((k for k, each in enumerate(optimum.varied) if not each.kinds), 0)
    goal = len(optimum.varied)
    start = (goal, goal + 1) if about["goals"] > 1 else (first, goal)
    return scatter(optimum.varied, shown, groups, start)
