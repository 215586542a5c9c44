"""From a case to its results: solve what it asks, then write numbers, tables, figures, record."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rotordyn.analysis.registry import (
    BEARING_ANALYSES,
    SPINDLE_ANALYSES,
    Answers,
    answer_bearing,
    answer_spindle,
)
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput

if TYPE_CHECKING:
    import xarray as xr

Progress = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class Delivery:
    """What a run left behind: the folder, its one-screen summary, speeds without a solution."""

    folder: Path
    summary: str
    unsolved: tuple[str, ...]


def run(case: Case) -> Mapping[str, xr.Dataset]:
    """Answer every question of ``case``: an xarray Dataset by analysis name, complex in memory.

    Raises
    ------
    NoSolution : no speed of the case has a physical solution
    """
    from rotordyn.report.datasets import dataset

    if not isinstance(case, Case):
        raise InvalidInput(f"run takes a case, as rotordyn.load gives it; got {case!r}")
    return {name: dataset(result) for name, result in solve(case).results.items()}


def solve(case: Case, progress: Progress = lambda name: None) -> Answers:
    """Answer every question of ``case`` with frozen results."""
    if case.spindle is not None:
        return answer_spindle(case.spindle, case.conditions, case.speeds, case.analyses, progress)
    if case.bearing is None:
        raise InvalidInput(f"case {case.name} has neither a spindle nor a bearing")
    return answer_bearing(case.bearing, case.conditions, case.speeds, case.analyses, progress)


def restricted(case: Case, only: tuple[str, ...]) -> Case:
    """``case`` with only some of its analyses.

    Raises
    ------
    InvalidInput : a name is not among the analyses of the case
    """
    unknown = [name for name in only if name not in case.analyses]
    if unknown:
        known = ", ".join(case.analyses)
        raise InvalidInput(f"--only {','.join(unknown)}: this case has the analyses {known}")
    return replace(case, analyses={n: s for n, s in case.analyses.items() if n in only})


def deliver(case: Case, target: Path, progress: Progress = lambda name: None) -> Delivery:
    """Solve ``case`` and write everything into ``target``, all or nothing.

    Raises
    ------
    OutputRefused : ``target`` holds something that is not ours
    NoSolution : no speed has a solution; nothing is written
    """
    from rotordyn.plots.catalogue import figures
    from rotordyn.plots.draw import Drawing
    from rotordyn.report.folder import check_target, results_folder
    from rotordyn.report.summary import summary

    check_target(target)
    seconds: dict[str, float] = {}
    with _timed(seconds, "solve, all stages"):
        answers = solve(case, progress)
    results = answers.results
    with results_folder(target) as folder:
        progress("figures")
        drawing = Drawing(figures(case, results), folder)
        with _timed(seconds, "write"):
            _write_numbers(case, results, folder)
            text = summary(case, results, answers.warnings)
            (folder / "summary.txt").write_text(text + "\n", encoding="utf-8")
        with _timed(seconds, "draw"):
            drawn = drawing.finish()
        _write_record(case, answers, seconds, drawn, folder)
    return Delivery(target, text, unsolved(results))


def unsolved(results: Mapping[str, Any]) -> tuple[str, ...]:
    """Why speeds have no solution, each reason once, in order of speed."""
    words = [str(w) for r in results.values() for w in _flat(r.outcome) if str(w)]
    return tuple(dict.fromkeys(words))


def _flat(outcome: Any) -> Iterator[Any]:
    return iter(outcome) if isinstance(outcome, tuple) else iter(outcome.flat)


@contextmanager
def _timed(seconds: dict[str, float], name: str) -> Iterator[None]:
    begin = time.perf_counter()
    yield
    seconds[name] = time.perf_counter() - begin


def _write_numbers(case: Case, results: Mapping[str, Any], folder: Path) -> None:
    from rotordyn.report.netcdf import write_results
    from rotordyn.report.tables import write_tables
    from rotordyn.report.uff import write_uff

    attributes = {"case": case.name, "title": case.title, "digest": case.digest}
    write_results(folder / "results.nc", results, attributes)
    write_tables(folder, results)
    if "frf" in results and case.spindle is not None:
        nodes = {name: k for k, name in enumerate(case.spindle.points, start=1)}
        write_uff(folder / "frf.uff", results["frf"], case=case.name, nodes=nodes)


def _write_record(
    case: Case,
    answers: Answers,
    seconds: Mapping[str, float],
    drawn: Mapping[str, float],
    folder: Path,
) -> None:
    from rotordyn.report.manifest import RunRecord, outcomes, write_record
    from rotordyn.report.warnings import result_warnings

    known = SPINDLE_ANALYSES if case.spindle is not None else BEARING_ANALYSES
    unasked = {name: "the case does not ask for it" for name in known if name not in case.analyses}
    record = RunRecord(
        case=case.name,
        title=case.title,
        digest=case.digest,
        inputs=tuple(f"{path.parent.name}/{path.name}" for path in case.files),
        settings=asdict(case.conditions),
        outcomes=outcomes(answers.results),
        tolerances=answers.tolerances,
        stages={**seconds, **answers.seconds},
        figures=drawn,
        skipped={**unasked, **answers.skipped},
        warnings=(*answers.warnings, *result_warnings(answers.results)),
    )
    write_record(folder, record)
