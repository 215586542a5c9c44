"""The folder of an optimum as one HTML page."""

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

ENDS = 2  # columns of the table behind goals and limits: whether all are kept, why not solved


class OptimumFolder(NamedTuple):
    """What is read of the folder: what is known ``about`` the search, and its table in parts."""

    about: dict[str, Any]
    summary: str
    best: str
    trial: Column
    varied: list[Column]
    values: list[Column]
    ends: list[Column]
    date: str


def optimum_page(folder: Path) -> Page:
    """What the page of an optimum shows.

    Raises
    ------
    InvalidInput : the search did not end, or another version wrote it
    """
    held = _read(folder)
    found = held.about["best"] is not None
    kept = sum(word == "yes" for word in held.ends[0].words)
    said = f"{'✓' if found else '✕'} {len(held.trial.words)} trials, {kept} of them keep all limits"
    return Page(
        title=held.about["title"],
        about=["Optimum: the best of what may be chosen", held.date],
        verdict=f"{said}. {held.about['verdict'][0]}",
        grave=not found,
        sections=sections([*_blocks(held)]),
        footer=f"{held.about['source']}. {held.date}",
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


def _blocks(held: OptimumFolder) -> Iterator[tuple[str, Block]]:
    about = held.about
    head, *rows = about["rows"]
    yield "Verdict", Table("The case and what was found", head, rows)
    yield "Verdict", Text(about["verdict"])
    if about["warnings"]:
        yield "Verdict", Text(about["warnings"], listed=True, title="Warnings")
    yield "Verdict", Printed("Summary", held.summary)
    yield "What may be chosen", varied_table("What was tried", held.varied)
    goals, limits = held.values[: about["goals"]], held.values[about["goals"] :]
    shown = [*goals, *(each for each in limits if each.moves)]
    yield "Trade-off", _scatter(held, shown)
    yield "Trials across", parallel_coordinates("Trials across", held.varied, shown, goals[0])
    columns = [held.trial, *held.varied, *held.values, *held.ends]
    yield "Trials", table_of("Trials", columns, TABLE)
    if held.best:
        yield "The best as a case", Printed(BEST, held.best)
    origin = [("made with", about["source"]), ("date", held.date)]
    yield (
        "Origin",
        Table("Origin", ("", ""), [*origin, ("SHA-256 of what was read", about["digest"])]),
    )


def _scatter(held: OptimumFolder, shown: list[Column]) -> Chart:
    """Two goals over one another at first, or the goal over the first number that is chosen."""
    about, count = held.about, len(held.trial.words)
    kept = np.array([word == "yes" for word in held.ends[0].words])
    front, best = (np.isin(np.arange(count), each) for each in (about["front"], [about["best"]]))
    ring = {"line": {"width": 1, "color": INK}}
    groups = [
        Group("breaks a limit", ~kept, {"color": FAINT, "size": 7, "symbol": "x-thin-open"}),
        Group("keeps all limits", kept, {"color": COLOURS[0], "size": 7, "opacity": 0.75}),
        Group("trade-off", front, {"color": COLOURS[1], "size": 9, "symbol": "diamond", **ring}),
        Group("best", best, {"color": COLOURS[4], "size": 14, "symbol": "star", **ring}),
    ]
    first = next((k for k, each in enumerate(held.varied) if not each.kinds), 0)
    goal = len(held.varied)
    start = (goal, goal + 1) if about["goals"] > 1 else (first, goal)
    return scatter(held.varied, shown, groups, start)
