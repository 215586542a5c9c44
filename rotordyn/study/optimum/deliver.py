"""Search an optimum and write its folder: trials as they come, best case, table, figures."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import is_dataclass
from pathlib import Path
from typing import Any

import rotordyn.study.optimum.solve as optimum
from rotordyn.case.library import is_path
from rotordyn.case.read import load
from rotordyn.case.varied import unlike
from rotordyn.case.vary import changed
from rotordyn.case.written import write_changed
from rotordyn.errors import InvalidInput
from rotordyn.figures.style import USUAL_FORMATS
from rotordyn.quantity import Quantity
from rotordyn.study.optimum.problem import Problem, Trial
from rotordyn.study.optimum.solve import Optimum
from rotordyn.study.optimum.summary import BEST, SUMMARY, summary, write_about, write_trials
from rotordyn.study.solve import Progress
from rotordyn.whole import whole_files


def deliver(
    problem: Problem,
    folder: Path,
    *,
    trials: int,
    seed: int,
    workers: int | None = None,
    progress: Progress = lambda done, of: None,
    draw: bool = True,
    formats: Sequence[str] = USUAL_FORMATS,
) -> tuple[Optimum, str]:
    """Search, write the folder, and return the optimum and its summary.

    Raises
    ------
    InvalidInput, NoSolution : see ``optimise``; trials that were made stay in the folder
    """
    result = optimum.solved(problem, trials, seed, workers, folder, progress)
    text = summary(result)
    try:
        with whole_files(folder) as place:
            if result.best is not None:
                text += _write_best(problem, result.best, place / BEST, folder)
            (place / SUMMARY).write_text(text + "\n", encoding="utf-8")
            write_trials(place, result)
            write_about(place, result)
            if draw:
                from rotordyn.figures.draw import draw_one
                from rotordyn.study.optimum.figures import figures

                for name, drawing in figures(result):
                    draw_one(name, drawing, place, formats)
    except OSError as error:
        raise InvalidInput(f"{folder}: cannot be written: {error.strerror}") from None
    return result, text


def _write_best(problem: Problem, best: Trial, path: Path, home: Path) -> str:
    """Write the best machine as a case file; return a sentence if that is not possible, else "".

    Settings of the case that refer to replaced models may have to be repeated: the written file is
    read, and fields that differ from the wanted case are added to the changes. ``home``: the folder
    in which the file will finally stand.
    """
    wanted = changed(problem.case, problem.values(best.number))
    title = f"{problem.case.title or problem.case.name}: the best"
    changes = _as_written(problem, best)
    try:
        for _ in range(2):
            write_changed(problem.case, changes, path, title=title)
            differing = unlike(load(path), wanted)
            if not differing:
                write_changed(problem.case, changes, path, title=title, home=home)
                return ""
            changes |= {way: _in_file(value, of) for way, (value, of) in differing.items()}
        reason = f"it would differ in {', '.join(list(differing)[:3])}"
    except InvalidInput as refusal:
        reason = str(refusal).replace(f"{path}:", "line ").replace("\n", "; ")
    path.unlink(missing_ok=True)
    return f"\n\nThere is no {BEST}, which cannot be written: {reason}."


def _as_written(problem: Problem, trial: Trial) -> dict[str, Any]:
    """Values by path as a file writes them, outer paths before paths inside them."""
    values, labels = problem.values(trial.number), problem.labels(trial.number)
    parameters = sorted(problem.parameters, key=lambda p: p.path.count("."))
    return {
        p.path: _in_file(
            labels[p.path] if is_dataclass(values[p.path]) else values[p.path], p.quantity
        )
        for p in parameters
    }


def _in_file(value: Any, quantity: Quantity | None) -> Any:
    """Value as a file writes it: numbers with all digits and unit, file names as absolute paths."""
    if isinstance(value, float | int) and not isinstance(value, bool):
        if quantity is None:
            return value
        return (
            f"{value!r} {quantity.coherent_unit}".strip()
            if math.isfinite(value)
            else quantity.written(value)
        )
    return str(Path(value).resolve()) if isinstance(value, str) and is_path(value) else value
