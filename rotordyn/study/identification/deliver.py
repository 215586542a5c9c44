"""Identify and write the folder: searches as they end, then the result."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rotordyn.case.written import write_changed
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.figures.style import USUAL_FORMATS
from rotordyn.study import record
from rotordyn.study.identification.searches import JOURNAL, Progress
from rotordyn.study.identification.summary import summary
from rotordyn.study.identification.tables import write_tables
from rotordyn.whole import whole_files

if TYPE_CHECKING:
    from rotordyn.study.identification.identification import Identification
    from rotordyn.study.identification.solve import Asked

BEST, SUMMARY, DATASET = "best.yaml", "summary.txt", "identification.nc"


def deliver(
    request: Asked,
    folder: Path,
    *,
    workers: int | None = None,
    progress: Progress = lambda done, of: None,
    draw: bool = True,
) -> tuple[Identification, str]:
    """Identify, write the folder, and return the result and its summary.

    Raises
    ------
    InvalidInput, NoSolution : see ``identify``; searches that ended stay in the folder, unless none
        has a machine with a solution
    """
    from rotordyn.study.identification.solve import identified

    try:
        result = identified(request, workers, folder, progress)
    except NoSolution:
        record.withdraw(folder / JOURNAL)
        raise
    write(result, folder, draw=draw)
    return result, summary(result)


def write(
    result: Identification,
    folder: Path,
    *,
    draw: bool = True,
    formats: Sequence[str] = USUAL_FORMATS,
) -> None:
    """Write summary, dataset, tables, the identified machine as a case, figures.

    Raises
    ------
    InvalidInput : the folder cannot be written
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with whole_files(folder) as place:
            _write(result, place, formats if draw else (), folder)
    except OSError as error:
        raise InvalidInput(f"{folder}: cannot be written: {error.strerror}") from None


def _write(result: Identification, folder: Path, formats: Sequence[str], home: Path) -> None:
    (folder / SUMMARY).write_text(summary(result) + "\n", encoding="utf-8")
    result.dataset().to_netcdf(folder / DATASET, engine="h5netcdf")
    write_tables(folder, result)
    best = result.explained
    if best.problem.case.files:
        values = zip(best.problem.unknowns, best.fit.values.tolist(), strict=True)
        changes = {
            path: f"{value!r} {unknown.coherent_unit}".strip() if unknown.coherent_unit else value
            for unknown, value in values
            for path in (unknown.path, *unknown.also)
        }
        title = f"{result.title or result.name}: as identified"
        changes |= best.held
        write_changed(best.problem.case, changes, folder / BEST, title=title, home=home)
    if formats:
        from rotordyn.figures.draw import draw_one
        from rotordyn.study.identification.figures import figures

        for name, drawing in figures(result):
            draw_one(name, drawing, folder, formats)
