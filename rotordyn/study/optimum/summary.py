"""Summary of an optimum in plain text, and tables of its trials."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from rotordyn import __version__
from rotordyn.case.case import Case
from rotordyn.case.paths import found_at, places
from rotordyn.machine.seat import BearingSeat
from rotordyn.report.tables import Column, write_table
from rotordyn.results.display import sized
from rotordyn.results.text import wrapped
from rotordyn.study.optimum.problem import Problem, Trial
from rotordyn.study.optimum.solve import Optimum
from rotordyn.study.parameter import Parameter
from rotordyn.study.summary import reasons, without

SUMMARY, TABLE, ABOUT, BEST = "summary.txt", "trials.csv", "optimum.json", "best.yaml"


def summary(optimum: Optimum) -> str:
    """Summary text: trials, the best machine beside the case, binding limits, trade-off."""
    return "\n".join(_lines(optimum))


def _lines(optimum: Optimum) -> Iterator[str]:
    problem, nearest = optimum.problem, optimum.nearest
    feasible = sum(each.feasible for each in optimum.trials)
    yield problem.case.title or problem.case.name
    yield f"{len(optimum.trials)} trials, {feasible} of them keep all limits"
    yield from without(problem.left_out)
    for sentence in reasons((each.sentence for each in optimum.trials), "trial", TABLE):
        yield from wrapped(sentence)
    yield ""
    rows = _beside(optimum)
    widths = [max(len(row[k]) for row in rows) for k in range(3)]
    for row in rows:
        cells = zip(row, widths, strict=True)
        yield "  ".join(cell.ljust(width) for cell, width in cells).rstrip()
    yield ""
    for sentence in optimum.verdict:
        yield from wrapped(sentence)
    for sentence in nearest.warnings:
        yield from wrapped(f"warning: {sentence}")
    if len(optimum.front) > 1:
        yield ""
        yield from wrapped(
            f"trade-off: {len(optimum.front)} machines, none better in both goals; the best above, "
            f"and best.yaml, is that of the first goal, {problem.goals[0].words}"
        )
        for each in (optimum.front[0], optimum.front[len(optimum.front) // 2], optimum.front[-1]):
            goals = zip(problem.goals, each.goals, optimum.units, strict=False)
            values = (f"{g.words} {value:.4g} {unit}" for g, value, unit in goals)
            chosen = (
                f"{p.path} {_chosen(problem, p, each)} {p.display[0]}" for p in problem.parameters
            )
            yield from wrapped(f"- {', '.join(values)}: {', '.join(map(str.strip, chosen))}")


def _beside(optimum: Optimum) -> list[tuple[str, ...]]:
    """Rows of parameters, goals and limits: of the case itself, and of the best trial."""
    heads = ("the unchanged case", "best" if optimum.best else "nearest, no best")
    chosen = [
        (p.heading, _present(optimum.problem, p), _chosen(optimum.problem, p, optimum.nearest))
        for p in optimum.problem.parameters
    ]
    return [("", *heads), *chosen, *_readings(optimum)]


def write_about(folder: Path, optimum: Optimum) -> None:
    """Write ``optimum.json``: the summary as data; trials are row numbers of the table."""
    case, trials = optimum.problem.case, list(optimum.trials)
    content = {
        "title": case.title or case.name,
        "source": f"rotordyn {__version__}",
        "digest": case.digest,
        "parameters": len(optimum.problem.parameters),
        "goals": len(optimum.problem.goals),
        "best": None if optimum.best is None else trials.index(optimum.best),
        "front": [trials.index(each) for each in optimum.front] if len(optimum.front) > 1 else [],
        "rows": _beside(optimum),
        "verdict": optimum.verdict,
        "warnings": optimum.nearest.warnings,
    }
    text = json.dumps(content, ensure_ascii=False, indent=1) + "\n"
    (folder / ABOUT).write_text(text, encoding="utf-8")


def _present(problem: Problem, p: Parameter) -> str:
    """Text of the value of the case; a dash if items under ``*`` have several values."""
    case = problem.case
    words = {_word(p, value) or _called(case, way, value) for way, value, _ in places(case, p.path)}
    return words.pop() if len(words) == 1 else "–"


def _called(case: Case, path: str, value: Any) -> str:
    """Name of a model that is not among the choices."""
    seats = (holder for holder, _ in found_at(case, path.rpartition(".")[0]))
    names = (each.model for each in seats if isinstance(each, BearingSeat))
    return getattr(value, "name", "") or next(names, "") or "–"


def _word(p: Parameter, value: Any) -> str:
    """Text of a value as the choice is written; empty if it is not among them."""
    if isinstance(value, float | int) and not isinstance(value, bool) and math.isfinite(value):
        return f"{p.displayed(value):.6g}"
    if isinstance(value, str):
        return value[:40]
    return next((str(w) for w, each in zip(p.labels, p.values, strict=False) if each == value), "")


def _chosen(problem: Problem, p: Parameter, trial: Trial) -> str:
    """Text of the value of a parameter at a trial, in its usual unit."""
    value = problem.labels(trial.number)[p.path]
    return f"{p.displayed(value):.6g}" if isinstance(value, float | int) else str(value)


def _readings(optimum: Optimum) -> Iterator[tuple[str, ...]]:
    """Rows of goals and limits: of the case itself, and of the best trial."""
    both = optimum.start, optimum.nearest
    for k, (each, unit) in enumerate(_asked(optimum)):
        cells = (sized(read[k], 3) if (read := _read(t)) else "no solution" for t in both)
        yield (f"{each} [{unit}]", *cells)


def _asked(optimum: Optimum) -> Iterator[tuple[str, str]]:
    """Yield heading and printed unit of every goal, then of every limit."""
    problem = optimum.problem
    words = [*(g.words for g in problem.goals), *(limit.words for limit in problem.limits)]
    yield from zip(words, optimum.units, strict=True)


def _read(trial: Trial) -> tuple[float, ...]:
    """Values of goals, then of limits, of a trial; empty without a solution."""
    return (*trial.goals, *trial.readings)


def write_trials(folder: Path, optimum: Optimum) -> None:
    """Write ``trials.csv``: parameters, goals, limits, whether all limits are kept."""
    problem = optimum.problem
    labels = [problem.labels(each.number) for each in optimum.trials]
    columns: list[Column] = [("trial", list(range(len(labels))))]
    for p in problem.parameters:
        columns.append((p.heading, [p.displayed(row[p.path]) for row in labels]))
    for k, (name, unit) in enumerate(_asked(optimum)):
        head = f"{name} [{unit}]" if unit else name
        columns.append((head, _cells([_read(each) for each in optimum.trials], k)))
    columns.append(("keeps all limits", ["yes" if t.feasible else "no" for t in optimum.trials]))
    columns.append(("not solved", [each.sentence for each in optimum.trials]))
    write_table(folder / TABLE, columns)


def _cells(rows: Sequence[tuple[float, ...]], k: int) -> list[str]:
    return [f"{row[k]:.9g}" if row and not math.isnan(row[k]) else "" for row in rows]
