"""One point of a study solved: its headline numbers, or why it has none."""

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

    ``left_out``: variants of the case, which take no part.
    """

    case: Case
    design: Design
    results: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a point came to.

    ``numbers``: value and unit, as printed, by the name of the number; ``sentence``: why there are
    none, or which speeds lack them; empty of a point that is solved. ``seconds``: to solve it.
    ``error``: the largest one over what the accuracy allows, None where it was not looked for.
    ``solved``: whether any speed has a solution, also where the analyses have no headline numbers.
    ``results``: those that are kept whole, by the name of the analysis.
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
    """Solve some points of a pickled study in whatever process this is, of so many that it will
    solve.

    What the last points of the process have in common with these is not solved again, and what can
    be solved of several together is; where there are many, the compiled solver of bearings is
    loaded for them.
    """
    study, neighbours = _unpacked(packed)
    begin = time.perf_counter()
    cases = [_case(study, number) for number in numbers]
    neighbours.solve_ahead([case for case in cases if isinstance(case, Case)])
    each = (time.perf_counter() - begin) / len(numbers)
    return [
        _solved(study, number, case, neighbours, points, each)
        for number, case in zip(numbers, cases, strict=True)
    ]


def _case(study: Study, number: int) -> Case | Exception:
    """The case of a point, or why its values contradict one another."""
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
    """What a case comes to after its neighbours, of so many; ``spent``: seconds before."""
    begin = time.perf_counter()
    try:
        if isinstance(case, Exception):
            raise case
        found = _outcome(study, number, case, neighbours, points)
    except (InvalidInput, BearingError, NoSolution) as error:
        found = Outcome(number, sentence=str(error), solved=False)
    return replace(found, seconds=spent + time.perf_counter() - begin)


def _outcome(study: Study, number: int, case: Case, neighbours: Neighbours, points: int) -> Outcome:
    answers, error = neighbours.solve(case, checked=bool(study.results), further=points)
    return Outcome(
        number,
        numbers={
            f"{name}: {each.words}": (float(each.value), each.unit)
            for name, each in headline_numbers(case, answers.results)
        },
        sentence="; ".join(unsolved(answers.results)),
        warnings=(*answers.warnings, *result_warnings(answers.results)),
        error=error,
        results={name: answers.results[name] for name in study.results},
    )


def _numbers_alone(case: Case, whole: Sequence[str]) -> Case:
    """The case asked for numbers alone, but for analyses whose results are kept ``whole``."""
    specs = {
        name: spec if name in whole else analysis(name).lean(spec)
        for name, spec in case.analyses.items()
    }
    return replace(case, analyses=specs)


def _varies_analyses(study: Study) -> bool:
    """Whether what is asked differs from point to point."""
    return any(each.path.split(".")[0] == "analyses" for each in study.design.parameters)


@lru_cache(maxsize=1)
def _unpacked(packed: bytes) -> tuple[Study, Neighbours]:
    study, _ = pickle.loads(packed)
    if not _varies_analyses(study):
        study = replace(study, case=_numbers_alone(study.case, study.results))
    return study, Neighbours()
