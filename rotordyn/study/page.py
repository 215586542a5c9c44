"""One HTML page of the folder of a run, a study, an optimum or an identification."""

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
    """Content of the folder of a study; ``origin``: rows of a table, name and value."""

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
    InvalidInput : not a results folder, an incomplete one, or one of another version; the file
        cannot be written
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
            raise InvalidInput(
                f"{path} is not a regular file, as all files of a results folder are"
            )


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
    """Whether a column is a headline number, whose heading begins with an analysis."""
    return column.heading.partition(OF_RESULTS)[0] in names()


def _study_page(study: StudyFolder) -> Page:
    count, lost = len(study.sentences.words), sum(map(bool, study.sentences.words))
    warned = sum(map(bool, study.warnings.words))
    verdict = f"{'✕' if lost == count else '⚠' if lost or warned else '✓'} {count} points"
    verdict += (
        f", {lost} of them with no solution at some or all speeds" if lost else ", all solved"
    )
    verdict += f"; {warned} with warnings." if warned else "; no warnings."
    return Page(
        title=study.title,
        about=["Study: one case at many points", study.origin[1][1]],
        verdict=verdict,
        grave=lost == count,
        sections=sections([*_blocks(study)]),
        footer=f"{study.origin[0][1]}. {study.origin[1][1]}",
    )


def _blocks(study: StudyFolder) -> Iterator[tuple[str, Block]]:
    for title, column in (("Not solved", study.sentences), ("Warnings", study.warnings)):
        if reasons := [*_counted(column.words)]:
            yield "Verdict", Text(reasons, listed=True, title=title)
    yield "Verdict", Printed("Summary", study.summary)
    yield "What was varied", varied_table("What was varied", study.varied)
    shown = [each for each in study.numbers if each.moves]
    if shown:
        first = next((k for k, each in enumerate(study.varied) if not each.kinds), 0)
        groups, start = [plain_group(len(study.point.words))], (first, len(study.varied))
        yield "Trade-off", scatter(study.varied, shown, groups, start)
        yield "Points across", parallel_coordinates("Points across", study.varied, shown)
    else:
        yield "Trade-off", Text(["No number changes over what was varied."])
    columns = [study.point, *study.varied, *study.numbers, study.sentences]
    yield "Points", table_of("Points", columns, TABLE)
    yield "Origin", Table("Origin", ("", ""), study.origin)


def _counted(cells: Sequence[str]) -> Iterator[str]:
    """Yield each kind of sentence once, with the number of points that have it."""
    kinds = alike(cell.split(" | ") if cell else () for cell in cells)
    yield from (f"{points}: {sentence}" for points, sentence in kinds[:MOST_REASONS])
    if len(kinds) > MOST_REASONS:
        yield f"{len(kinds) - MOST_REASONS} more kinds, listed in {TABLE}"
