"""The folder of a run, a study, an optimum or an identification as one HTML page."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import NamedTuple

from bearings.arguments import typed
from rotordyn.analyses.registry import names
from rotordyn.errors import InvalidInput
from rotordyn.page.blocks import Block, Printed, Table, Text, sections
from rotordyn.page.html import Page, write
from rotordyn.study.columns import (
    Column,
    parallel_coordinates,
    plain_group,
    read_columns,
    scatter,
    table_of,
    varied_table,
)
from rotordyn.study.dataset import DATASET, OF_RESULTS
from rotordyn.study.journal import JOURNAL
from rotordyn.study.optimum.page import optimum_page
from rotordyn.study.optimum.trials import JOURNAL as TRIALS
from rotordyn.study.summary import SUMMARY, TABLE, alike

MOST_REASONS = 12


class StudyFolder(NamedTuple):
    """What is read of the folder of a study; ``origin``: rows of a table, name and value."""

    title: str
    summary: str
    point: Column
    varied: list[Column]
    numbers: list[Column]
    sentences: Column
    warnings: Column
    origin: list[tuple[str, str]]


@typed(InvalidInput)
def write_report(folder: str | Path, path: str | Path) -> Path:
    """Write the results in ``folder`` as one HTML page.

    They are those of a run, a study, an optimum or an identification.

    Returns ``path``. The page opens without network. Takes the package plotly (extra ``report``).

    Raises
    ------
    InvalidInput : no results folder, half of one, one of another version; no file can be written
    """
    from rotordyn.study.identification.page import FILES, identification_page

    folder, path = Path(folder), Path(path)
    _require_files(folder)
    if os.path.exists(folder / TRIALS):
        write(path, optimum_page(folder))
    elif any(os.path.exists(folder / name) for name in FILES):
        write(path, identification_page(folder))
    elif any(os.path.exists(folder / name) for name in (DATASET, JOURNAL)):
        write(path, _study_page(_read(folder)))
    else:
        from rotordyn.job import open as opened

        return opened(folder).report(path)
    return path


def _require_files(folder: Path) -> None:
    """Raise InvalidInput where a pipe or a device stands in ``folder``: reading it may not end."""
    for path in folder.iterdir() if os.path.isdir(folder) else ():
        if path.exists() and not (path.is_file() or path.is_dir()):
            raise InvalidInput(f"{path} is no regular file, which no results folder holds")


def _read(folder: Path) -> StudyFolder:
    import xarray as xr

    try:
        with xr.open_dataset(folder / DATASET, engine="h5netcdf") as data:
            about = dict(data.attrs)
        point, *columns = read_columns(folder / TABLE)
        summary = (folder / SUMMARY).read_text(encoding="utf-8").rstrip("\n")
        written = datetime.fromtimestamp((folder / DATASET).stat().st_mtime, UTC)
        title, source = str(about["title"]), str(about["source"])
        *columns, sentences, warnings = columns
    except (OSError, ValueError, LookupError, RuntimeError, TypeError) as error:
        raise InvalidInput(
            f"{folder} holds a study that is not complete, or of another version ({error}): the "
            "same rotordyn sweep goes on with it"
        ) from None
    origin = [
        ("made with", source),
        ("date", f"{written:%Y-%m-%d %H:%M UTC}"),
        ("SHA-256 of what was read", str(about.get("digest", ""))),
    ]
    varied = [each for each in columns if not _is_number(each)]
    numbers = [each for each in columns if _is_number(each)]
    return StudyFolder(title, summary, point, varied, numbers, sentences, warnings, origin)


def _is_number(column: Column) -> bool:
    """Whether it is a headline number, led by its analysis, and not what was varied."""
    return column.heading.partition(OF_RESULTS)[0] in names()


def _study_page(held: StudyFolder) -> Page:
    count, lost = len(held.sentences.words), sum(map(bool, held.sentences.words))
    warned = sum(map(bool, held.warnings.words))
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


def _blocks(held: StudyFolder) -> Iterator[tuple[str, Block]]:
    for title, column in (("Not solved", held.sentences), ("Warnings", held.warnings)):
        if said := [*_counted(column.words)]:
            yield "Verdict", Text(said, listed=True, title=title)
    yield "Verdict", Printed("Summary", held.summary)
    yield "What was varied", varied_table("What was varied", held.varied)
    shown = [each for each in held.numbers if each.moves]
    if shown:
        first = next((k for k, each in enumerate(held.varied) if not each.kinds), 0)
        groups, start = [plain_group(len(held.point.words))], (first, len(held.varied))
        yield "Trade-off", scatter(held.varied, shown, groups, start)
        yield "Points across", parallel_coordinates("Points across", held.varied, shown)
    else:
        yield "Trade-off", Text(["No number changes over what was varied."])
    columns = [held.point, *held.varied, *held.numbers, held.sentences]
    yield "Points", table_of("Points", columns, TABLE)
    yield "Origin", Table("Origin", ("", ""), held.origin)


def _counted(cells: Sequence[str]) -> Iterator[str]:
    """Each kind of sentence once, with how many points have it."""
    found = alike(cell.split(" | ") if cell else () for cell in cells)
    yield from (f"{points}: {sentence}" for points, sentence in found[:MOST_REASONS])
    if len(found) > MOST_REASONS:
        yield f"{len(found) - MOST_REASONS} more kinds, listed in {TABLE}"
