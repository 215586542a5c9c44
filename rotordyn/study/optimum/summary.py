"""An optimum in one screen of plain text, and its trials as a table."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from rotordyn import __version__
from rotordyn.report.tables import Column, write_table
from rotordyn.results.display import number
from rotordyn.results.text import wrapped
from rotordyn.study.optimum.problem import Problem, Trial
from rotordyn.study.optimum.solve import Optimum

TABLE, ABOUT = "trials.csv", "optimum.json"


def summary(found: Optimum) -> str:
    """What was sought, what was found, and what holds it back."""
    return "\n".join(_lines(found))


def _lines(found: Optimum) -> Iterator[str]:
    problem, near = found.problem, found.nearest
    good = sum(each.feasible for each in found.trials)
    yield problem.case.title or problem.case.name
    yield f"{len(found.trials)} trials, {good} of them keep all limits"
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
        yield f"trade-off: {len(found.front)} machines, none better in both goals"
        for each in (found.front[0], found.front[len(found.front) // 2], found.front[-1]):
            goals = zip(problem.goals, each.goals, each.units, strict=False)
            ways = (f"{g.words} {value:.4g} {unit}" for g, value, unit in goals)
            chosen = (f"{p.path} {written(problem, p, each)}" for p in problem.parameters)
            yield from wrapped(f"- {', '.join(ways)}: {', '.join(chosen)}")


def _beside(found: Optimum) -> list[tuple[str, ...]]:
    """What was chosen, goals and limits: of the case as it stands, and of the best."""
    heads = ("the case as it stands", "best" if found.best else "nearest, no best")
    chosen = [
        (p.heading, _as_it_stands(found, p), written(found.problem, p, found.nearest))
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


def _as_it_stands(found: Optimum, p: Any) -> str:
    from rotordyn.case.varied import found_at

    values = [value for value, _ in found_at(found.problem.case, p.path)]
    kept = {_word(p, value) for value in values}
    return kept.pop() if len(kept) == 1 else "–"


def _word(p: Any, value: Any) -> str:
    if isinstance(value, float | int) and not isinstance(value, bool) and math.isfinite(value):
        return f"{p.displayed(value):.6g}"
    if isinstance(value, str):
        return value[:40]
    return next((str(w) for w, each in zip(p.labels, p.values, strict=False) if each == value), "–")


def written(problem: Problem, p: Any, trial: Trial) -> str:
    """The value of a parameter, in its usual unit."""
    value = problem.labels(trial.number)[p.path]
    return f"{p.displayed(value):.6g}" if isinstance(value, float | int) else str(value)


def _readings(found: Optimum) -> Iterator[tuple[str, ...]]:
    """Goals and limits, of the case as it stands and of the best."""
    problem, both = found.problem, (found.start, found.nearest)
    for k, goal in enumerate(problem.goals):
        yield (f"{goal.words} [{_unit(both, k)}]", *(_value(t.goals, k) for t in both))
    for k, limit in enumerate(problem.limits):
        unit = _unit(both, len(problem.goals) + k)
        yield (f"{limit.words} [{unit}]", *(_value(t.readings, k) for t in both))


def _unit(trials: tuple[Trial, ...], place: int) -> str:
    return next((each.units[place] for each in trials if each.units), "")


def _value(values: tuple[float, ...], place: int) -> str:
    return number(values[place], 3) if values else "no solution"


def write_trials(folder: Path, found: Optimum) -> None:
    """``trials.csv``: what was chosen, goals, limits, whether all limits are kept."""
    problem = found.problem
    labels = [problem.labels(each.number) for each in found.trials]
    columns: list[Column] = [("trial", list(range(len(labels))))]
    for p in problem.parameters:
        columns.append((p.heading, [p.displayed(row[p.path]) for row in labels]))
    units = next((each.units for each in found.trials if each.units), ())
    names = [goal.words for goal in problem.goals] + [limit.words for limit in problem.limits]
    for k, name in enumerate(names):
        values = [_row(each, k) for each in found.trials]
        head = f"{name} [{units[k]}]" if units and units[k] else name
        columns.append((head, values))
    columns.append(("keeps all limits", ["yes" if t.feasible else "no" for t in found.trials]))
    columns.append(("not solved", [each.sentence for each in found.trials]))
    write_table(folder / TABLE, columns)


def _row(trial: Trial, place: int) -> str:
    values = (*trial.goals, *trial.readings)
    return f"{values[place]:.9g}" if values and not math.isnan(values[place]) else ""
