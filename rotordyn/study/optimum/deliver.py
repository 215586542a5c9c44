"""An optimum sought into its folder: trials as they come, the best as a case, table, figures."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import rotordyn.study.optimum.solve as optimum
from rotordyn.case.written import write_changed
from rotordyn.figures.style import USUAL_FORMATS
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
    """Search and write what it came to; returns it and its summary.

    Raises
    ------
    InvalidInput, NoSolution : see ``optimise``; trials that were made stay in the folder
    """
    found = optimum.solved(problem, trials, seed, workers, folder, progress)
    text = summary(found)
    with whole_files(folder) as place:
        (place / SUMMARY).write_text(text + "\n", encoding="utf-8")
        write_trials(place, found)
        write_about(place, found)
        if found.best is not None:
            title = f"{problem.case.title or problem.case.name}: the best"
            write_changed(problem.case, _as_written(problem, found.best), place / BEST, title=title)
        if draw:
            from rotordyn.figures.draw import draw_one
            from rotordyn.study.optimum.figures import figures

            for name, drawing in figures(found):
                draw_one(name, drawing, place, formats)
    return found, text


def _as_written(problem: Problem, trial: Trial) -> dict[str, Any]:
    """Values by path as a file says them."""
    labels = problem.labels(trial.number)
    return {
        p.path: f"{labels[p.path]!r} {p.unit}".strip()
        if p.unit and isinstance(labels[p.path], float | int)
        else labels[p.path]
        for p in problem.parameters
    }
