"""Write a results folder: numbers, tables, figures, record; completely or not at all."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import Any

from rotordyn.allowance import Stop, require_figures
from rotordyn.analyses.registry import analysis, names
from rotordyn.analyses.solving import Progress
from rotordyn.case.case import Case
from rotordyn.errors import LeftOut, TooCostly, not_installed
from rotordyn.figures.draw import Omitted, Pictures
from rotordyn.figures.style import USUAL_FORMATS
from rotordyn.job.pages import REPORT
from rotordyn.job.results import inputs_of
from rotordyn.job.solved import Solution, SolvedResults, run

ENDED = "figures omitted: the run was ended before; rotordyn.open and plot draw them"


@dataclass(frozen=True, slots=True)
class Delivery:
    """Outcome of a run: folder, summary, ``plan`` (how it was solved), speeds without a solution.
    ``moved``: the folder is another one than requested, which is in use, or ``kept`` since it holds
    complete results; ``stop``: reason why the run ended early."""

    folder: Path
    summary: str
    plan: str
    unsolved: tuple[str, ...]
    moved: bool = False
    kept: bool = False
    stop: Stop | None = None


def deliver(
    case: Case,
    target: Path,
    progress: Progress = lambda name: None,
    *,
    figures: bool = True,
    formats: Sequence[str] = USUAL_FORMATS,
    report: bool = False,
    solve: Callable[[Case, Progress], SolvedResults] = run,
) -> Delivery:
    """Solve ``case`` and write everything into ``target``, all or nothing.

    Without ``figures`` nothing is drawn, and matplotlib is not loaded; ``formats``: of the figures,
    among ``figures.style.FORMATS``; ``report``: also write the page ``report.html``; ``solve``:
    function that solves the case.

    Raises
    ------
    OutputRefused : ``target`` holds something that is not ours; nothing is solved
    ModuleNotFoundError : plotly, which a report takes, is not installed; nothing is solved
    NoSolution : no speed (of any variant) has a solution; nothing is written
    """
    from rotordyn.page.html import library
    from rotordyn.report.folder import check_target

    check_target(target)
    if report:
        library()
    results = solve(case, progress)
    return write(results, target, progress, figures=figures, formats=formats, report=report)


def write(
    results: SolvedResults,
    target: Path,
    progress: Progress = lambda name: None,
    *,
    figures: bool = True,
    formats: Sequence[str] = USUAL_FORMATS,
    report: bool = False,
) -> Delivery:
    """Write ``results`` into ``target``, all or nothing; see ``deliver``."""
    from rotordyn.case.archive import archived
    from rotordyn.report.folder import CASE, results_folder

    seconds, stop = dict(results.solution.seconds), results.solution.stop
    with results_folder(target, ended=stop is not None) as place:
        progress("figures" if figures else "files")
        undrawn = _undrawn(results.solution, figures)
        if undrawn.figures:
            drawn: dict[str, float] = {}
            omitted = _write_numbers(results, place.folder, seconds) | undrawn
        else:
            drawn, omitted = _drawn(results, place.folder, seconds, formats)
        notes = (*results.notes, *omitted.sentences)
        text = results.summary_with(notes)
        (place.folder / "summary.txt").write_text(text + "\n", encoding="utf-8")
        case = json.dumps(archived(results.case), allow_nan=False)  # to open and draw it anew
        (place.folder / CASE).write_text(case + "\n", encoding="utf-8")
        if report:
            with _timed(seconds, "report"):
                results.report(place.folder / REPORT)
        _write_record(results, place.folder, seconds, drawn, omitted)
    plan = _plan(results.solution, seconds, omitted)
    return Delivery(place.target, text, plan, results.unsolved, place.moved, place.kept, stop)


def _undrawn(solution: Solution, figures: bool) -> Omitted:
    """Omission of all figures, if none are requested or the run was ended."""
    if not figures:
        return Omitted({"figures": "none are requested"})
    if solution.stop is not None:
        return Omitted({"figures": "the run was ended"}, (ENDED,))
    return Omitted()


def _drawn(
    results: SolvedResults, folder: Path, seconds: dict[str, float], formats: Sequence[str]
) -> tuple[dict[str, float], Omitted]:
    """Write numbers and figures in parallel; return seconds by figure, and what is missing."""
    from rotordyn.figures.draw import Drawing, load

    lacking = _attempted("figures", partial(load, formats))
    pictures = [] if lacking.figures else results.pictures(folder.parent)
    jobs = [] if lacking.figures else list(results.drawings().items())
    lacking |= _too_long(len(jobs), pictures)
    if lacking.figures:
        return {}, _write_numbers(results, folder, seconds) | lacking
    with ExitStack() as stack:
        for each in pictures:
            stack.enter_context(each)
        drawing = stack.enter_context(Drawing(jobs, folder, formats=formats))
        omitted = _write_numbers(results, folder, seconds)
        with _timed(seconds, "draw"):
            drawn = drawing.finish()
            for each in pictures:
                drawn |= each.draw(folder, formats)
                omitted |= each.omitted
        return drawn, omitted


def _too_long(figures: int, pictures: Sequence[Pictures]) -> Omitted:
    """Omission of all figures if drawing would exceed the allowance of the run."""
    count = figures + sum(len(each.names) for each in pictures)
    try:
        require_figures(count, sum(each.count for each in pictures))
    except TooCostly as error:
        return Omitted({"figures": f"{error}"}, (f"figures omitted: {error}",))
    return Omitted()


def _attempted(name: str, write: Callable[[], object]) -> Omitted:
    """Write ``name``; return its omission if it has no content or a package is missing."""
    why: str | None
    try:
        write()
        return Omitted()
    except ModuleNotFoundError as error:
        why = not_installed(error.name)
        if why is None:
            raise
    except LeftOut as reason:
        why = str(reason)
    return Omitted({name: why}, (f"{name} omitted: {why}",))


def _plan(solution: Solution, seconds: Mapping[str, float], omitted: Omitted) -> str:
    """Text on how every part was solved, and the time of writing and drawing."""
    from rotordyn.report.plan import plan

    around = {name: spent for name, spent in seconds.items() if name in ("write", "draw", "report")}
    texts = []
    for name, (_, machine) in solution.parts.items():
        last = not solution.case.variants
        skipped = machine.skipped | (omitted.figures if last else {})
        job = around if last else {}
        text = plan(machine.seconds, machine.asked, machine.spared, skipped, job)
        texts.append(f"{name}: {text}" if name else text)
    return "\n".join(texts)


@contextmanager
def _timed(seconds: dict[str, float], name: str) -> Iterator[None]:
    begin = time.perf_counter()
    yield
    seconds[name] = time.perf_counter() - begin


def _write_numbers(results: SolvedResults, folder: Path, seconds: dict[str, float]) -> Omitted:
    """Write numbers, tables and further files of the analyses; return omissions."""
    from rotordyn.job.side_by_side import write_comparison
    from rotordyn.report.cf import about
    from rotordyn.report.interval import keep, write_interval
    from rotordyn.report.netcdf import write_results
    from rotordyn.report.tables import write_tables

    case = results.case
    attributes = about(case.name, case.title, case.digest)
    store = partial(write_results, folder / "results.nc", results.solution.results, attributes)
    with _timed(seconds, "write"):
        omitted = _attempted("results.nc", store)
        for name, part in results.parts.items():
            (folder / name).mkdir(exist_ok=True)
            write_tables(folder / name, part.results)
            for name_of, result in part.results.items():
                for file, write in analysis(name_of).files(folder / name, part.case, result):
                    omitted |= _attempted(file, write)
        if case.variants:
            write_comparison(folder, results.parts)
        if results.solution.intervals:
            omitted |= _attempted("interval.nc", partial(keep, folder, results.solution.intervals))
        for name, interval in results.solution.intervals.items():
            write_interval(folder / name, interval)
    return omitted


def _write_record(
    results: SolvedResults,
    folder: Path,
    seconds: Mapping[str, float],
    drawn: Mapping[str, float],
    omitted: Omitted,
) -> None:
    from rotordyn.report.manifest import RunRecord, outcomes, write_record

    case, solution = results.case, results.solution
    machine = "spindle" if case.bearing is None else "bearing"
    others = [n for n in names() if analysis(n).machine == machine and n not in case.analyses]
    unasked = dict.fromkeys(others, "the case does not include it")
    record = RunRecord(
        case=case.name,
        title=case.title,
        digest=case.digest,
        inputs=inputs_of(case),
        settings=_settings(solution),
        outcomes=outcomes(solution.results),
        tolerances=solution.by_part(lambda machine: machine.tolerances),
        stages={**seconds, **solution.by_part(lambda machine: machine.seconds)},
        figures=drawn,
        skipped={**unasked, **solution.by_part(lambda machine: machine.skipped), **omitted.figures},
        warnings=results.warnings,
        notes=(*results.notes, *omitted.sentences),
        unsolved=results.unsolved,
        ended=solution.stop is not None,
    )
    write_record(folder, record)


def _settings(solution: Solution) -> dict[str, Any]:
    settings = {part: asdict(case.conditions) for part, (case, _) in solution.parts.items()}
    return settings.get("", settings)
