"""Solve one point of a study: its headline numbers, or a sentence on why it has none."""

from __future__ import annotations

import pickle
import time
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Any

from bearings.errors import BearingError
from rotordyn.analyses.headline import headline_numbers
from rotordyn.analyses.registry import analysis
from rotordyn.case.case import Case
from rotordyn.case.vary import changed
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.job.solving import unsolved
from rotordyn.report.warnings import result_warnings
from rotordyn.study.design import Design
from rotordyn.study.neighbours import Neighbours


@dataclass(frozen=True, eq=False, slots=True)
class Study:
    """A case, the points at which it is solved, and analyses whose ``results`` are kept whole.

    ``left_out``: names of the variants of the case, which a study ignores.
    """

    case: Case
    design: Design
    results: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Outcome:
    """Outcome of a point.

    ``numbers``: value and unit, as printed, by name; ``sentence``: why there are none, or which
    speeds lack them; empty if the point is solved. ``seconds``: time to solve it. ``error``:
    largest estimated error over the allowed one, None if not estimated. ``solved``: whether any
    speed has a solution, also where the analyses have no headline numbers. ``results``: results
    kept whole, by analysis.
    """

    number: int
    numbers: dict[str, tuple[float, str]] = field(default_factory=dict)
    sentence: str = ""
    warnings: tuple[str, ...] = ()
    seconds: float = 0.0
    error: float | None = None
    solved: bool = True
    results: dict[str, Any] = field(default_factory=dict)


def solve_points(packed: bytes, numbers: Sequence[int], points: int = 1) -> list[Outcome]:
    """Solve points ``numbers`` of a pickled study in this process; ``points``: how many it will
    solve in all.

    Stages in common with the previous points of the process are not solved again, preload states of
    several points are solved together, and for many points the compiled bearing solver is loaded.
    """
    study, neighbours = _unpacked(packed)
    begin = time.perf_counter()
    cases = [_case(study, number) for number in numbers]
    neighbours.solve_ahead([case for case in cases if isinstance(case, Case)])
    seconds = (time.perf_counter() - begin) / len(numbers)
    return [
        _solved(study, number, case, neighbours, points, seconds)
        for number, case in zip(numbers, cases, strict=True)
    ]


def _case(study: Study, number: int) -> Case | Exception:
    """The case of a point, or the error if its values contradict one another."""
    try:
        case = changed(study.case, study.design.point(number))
        return _numbers_alone(case, study.results) if _varies_analyses(study) else case
    except (InvalidInput, BearingError) as error:
        return error


def _solved(
    study: Study,
    number: int,
    case: Case | Exception,
    neighbours: Neighbours,
    points: int,
    spent: float,
) -> Outcome:
    """Outcome of a case solved after its ``neighbours``; ``spent``: seconds spent on it before."""
    begin = time.perf_counter()
    try:
        if isinstance(case, Exception):
            raise case
        outcome = _outcome(study, number, case, neighbours, points)
    except (InvalidInput, BearingError, NoSolution) as error:
        outcome = Outcome(number, sentence=str(error), solved=False)
    return replace(outcome, seconds=spent + time.perf_counter() - begin)


def _outcome(study: Study, number: int, case: Case, neighbours: Neighbours, points: int) -> Outcome:
    machine, error = neighbours.solve(case, checked=bool(study.results), further=points)
    return Outcome(
        number,
        numbers={
            f"{name}: {each.words}": (each.reading, each.unit)
            for name, each in headline_numbers(case, machine.results)
        },
        sentence="; ".join(unsolved(machine.results)),
        warnings=(*machine.warnings, *result_warnings(machine.results)),
        error=error,
        results={name: machine.results[name] for name in study.results},
    )


def _numbers_alone(case: Case, whole: Sequence[str]) -> Case:
    """Reduce a case to headline numbers, but for analyses whose results are kept ``whole``."""
    specs = {
        name: spec if name in whole else analysis(name).lean(spec)
        for name, spec in case.analyses.items()
    }
    return replace(case, analyses=specs)


def _varies_analyses(study: Study) -> bool:
    """Whether a parameter belongs to an analysis, so that its spec differs between points."""
    return any(each.path.split(".")[0] == "analyses" for each in study.design.parameters)


@lru_cache(maxsize=1)
def _unpacked(packed: bytes) -> tuple[Study, Neighbours]:
    study, _ = pickle.loads(packed)
    if not _varies_analyses(study):
        study = replace(study, case=_numbers_alone(study.case, study.results))
    return study, Neighbours()
