"""An optimum in one screen of plain text, and its trials as a table."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from rotordyn import __version__
from rotordyn.case.case import Case
from rotordyn.case.varied import found_at, places
from rotordyn.machine.seat import BearingSeat
from rotordyn.report.tables import Column, write_table
from rotordyn.results.display import sized
from rotordyn.results.text import wrapped
from rotordyn.study.optimum.problem import Problem, Trial
from rotordyn.study.optimum.solve import Optimum
from rotordyn.study.parameter import Parameter
from rotordyn.study.summary import reasons, without

SUMMARY, TABLE, ABOUT, BEST = "summary.txt", "trials.csv", "optimum.json", "best.yaml"


def summary(found: Optimum) -> str:
    """What was sought, what was found, and what holds it back."""
    return "\n".join(_lines(found))


def _lines(found: Optimum) -> Iterator[str]:
    problem, near = found.problem, found.nearest
    good = sum(each.feasible for each in found.trials)
    yield problem.case.title or problem.case.name
    yield f"{len(found.trials)} trials, {good} of them keep all limits"
    yield from without(problem.left_out)
    for sentence in reasons((each.sentence for each in found.trials), "trial", TABLE):
        yield from wrapped(sentence)
    yield ""
    rows = _beside(found)
    widths = [max(len(row[k]) for row in rows) for k in range(3)]
    for row in rows:
        cells = zip(row, widths, strict=True)
        yield "  ".join(cell.ljust(width) for cell, width in cells).rstrip()
    yield ""
    for sentence in found.verdict:
        yield from wrapped(sentence)
    for sentence in near.warnings:
        yield from wrapped(f"warning: {sentence}")
    if len(found.front) > 1:
        yield ""
        yield from wrapped(
            f"trade-off: {len(found.front)} machines, none better in both goals; the best above, "
            f"and best.yaml, is that of the first goal, {problem.goals[0].words}"
        )
        for each in (found.front[0], found.front[len(found.front) // 2], found.front[-1]):
            goals = zip(problem.goals, each.goals, found.units, strict=False)
            ways = (f"{g.words} {value:.4g} {unit}" for g, value, unit in goals)
            chosen = (
                f"{p.path} {_chosen(problem, p, each)} {p.display[0]}" for p in problem.parameters
            )
            yield from wrapped(f"- {', '.join(ways)}: {', '.join(map(str.strip, chosen))}")


def _beside(found: Optimum) -> list[tuple[str, ...]]:
    """What was chosen, goals and limits: of the case as it stands, and of the best."""
    heads = ("the case as it stands", "best" if found.best else "nearest, no best")
    chosen = [
        (p.heading, _present(found.problem, p), _chosen(found.problem, p, found.nearest))
        for p in found.problem.parameters
    ]
    return [("", *heads), *chosen, *_readings(found)]


def write_about(folder: Path, found: Optimum) -> None:
    """``optimum.json``: the summary as data, trials by their rows in the table."""
    case, trials = found.problem.case, list(found.trials)
    words = {
        "title": case.title or case.name,
        "source": f"rotordyn {__version__}",
        "digest": case.digest,
        "parameters": len(found.problem.parameters),
        "goals": len(found.problem.goals),
        "best": None if found.best is None else trials.index(found.best),
        "front": [trials.index(each) for each in found.front] if len(found.front) > 1 else [],
        "rows": _beside(found),
        "verdict": found.verdict,
        "warnings": found.nearest.warnings,
    }
    text = json.dumps(words, ensure_ascii=False, indent=1) + "\n"
    (folder / ABOUT).write_text(text, encoding="utf-8")


def _present(problem: Problem, p: Parameter) -> str:
    """The value that the case has; none where items under ``*`` have several."""
    case = problem.case
    words = {_word(p, value) or _called(case, way, value) for way, value, _ in places(case, p.path)}
    return words.pop() if len(words) == 1 else "–"


def _called(case: Case, path: str, value: Any) -> str:
    """The name of a model that is none of the choices."""
    seats = (holder for holder, _ in found_at(case, path.rpartition(".")[0]))
    names = (each.model for each in seats if isinstance(each, BearingSeat))
    return getattr(value, "name", "") or next(names, "") or "–"


def _word(p: Parameter, value: Any) -> str:
    """A value as its choice is written; empty where it is none of them."""
    if isinstance(value, float | int) and not isinstance(value, bool) and math.isfinite(value):
        return f"{p.displayed(value):.6g}"
    if isinstance(value, str):
        return value[:40]
    return next((str(w) for w, each in zip(p.labels, p.values, strict=False) if each == value), "")


def _chosen(problem: Problem, p: Parameter, trial: Trial) -> str:
    """The value of a parameter at a trial, in its usual unit."""
    value = problem.labels(trial.number)[p.path]
    return f"{p.displayed(value):.6g}" if isinstance(value, float | int) else str(value)


def _readings(found: Optimum) -> Iterator[tuple[str, ...]]:
    """Goals and limits, of the case as it stands and of the best."""
    both = found.start, found.nearest
    for k, (each, unit) in enumerate(_asked(found)):
        cells = (sized(read[k], 3) if (read := _read(t)) else "no solution" for t in both)
        yield (f"{each} [{unit}]", *cells)


def _asked(found: Optimum) -> Iterator[tuple[str, str]]:
    """Words and printed unit of every goal, then every limit."""
    problem = found.problem
    words = [*(g.words for g in problem.goals), *(limit.words for limit in problem.limits)]
    yield from zip(words, found.units, strict=True)


def _read(trial: Trial) -> tuple[float, ...]:
    """What goals, then limits, read of a trial; empty without a solution."""
    return (*trial.goals, *trial.readings)


def write_trials(folder: Path, found: Optimum) -> None:
    """``trials.csv``: what was chosen, goals, limits, whether all limits are kept."""
    problem = found.problem
    labels = [problem.labels(each.number) for each in found.trials]
    columns: list[Column] = [("trial", list(range(len(labels))))]
    for p in problem.parameters:
        columns.append((p.heading, [p.displayed(row[p.path]) for row in labels]))
    for k, (name, unit) in enumerate(_asked(found)):
        head = f"{name} [{unit}]" if unit else name
        columns.append((head, _cells([_read(each) for each in found.trials], k)))
    columns.append(("keeps all limits", ["yes" if t.feasible else "no" for t in found.trials]))
    columns.append(("not solved", [each.sentence for each in found.trials]))
    write_table(folder / TABLE, columns)


def _cells(rows: Sequence[tuple[float, ...]], k: int) -> list[str]:
    return [f"{row[k]:.9g}" if row and not math.isnan(row[k]) else "" for row in rows]
