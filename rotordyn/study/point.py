"""One point of a study solved: its headline numbers, or why it has none."""

from __future__ import annotations

import math
import pickle
import time
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Any

from bearings.errors import BearingError
from bearings.geometry import geometry
from bearings.ring.compiled.states import expect
from rotordyn.analyses.registry import analysis, place
from rotordyn.case.case import Case
from rotordyn.case.vary import vary
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.job.solving import solve, unsolved
from rotordyn.report.warnings import result_warnings
from rotordyn.scene.stage import Memo
from rotordyn.study.design import Design

SAVED = 0.25  # of the time of a point, by the compiled solver of bearings
LATEST = 2  # values of a stage kept beside the first: of the points solved last


@dataclass(frozen=True, eq=False, slots=True)
class Study:
    """A case, the points at which it is solved, and analyses whose ``results`` are kept whole."""

    case: Case
    design: Design
    results: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a point came to.

    ``numbers``: value and unit, as printed, by the name of the number; ``sentence``: why there are
    none, or which speeds lack them; empty of a point that is solved. ``seconds``: to solve it.
    ``results``: those that are kept whole, by the name of the analysis.
    """

    number: int
    numbers: dict[str, tuple[float, str]] = field(default_factory=dict)
    sentence: str = ""
    warnings: tuple[str, ...] = ()
    seconds: float = 0.0
    results: dict[str, Any] = field(default_factory=dict)


@dataclass
class _Known:
    """What a process has of the points it solved: stages, and seconds of the ``quickest``."""

    study: Study
    memo: Memo = field(default_factory=Memo)
    quickest: float = math.inf


def solve_point(packed: bytes, number: int, points: int = 1) -> Outcome:
    """Solve a point of a pickled study in whatever process this is, of so many that it will solve.

    What the last points of the process have in common with this one is not solved again; where they
    are many, the compiled solver of bearings is loaded for them.
    """
    known = _unpacked(packed)
    study, memo, first = known.study, known.memo, not known.memo.values
    begin = time.perf_counter()
    try:
        found = outcome(study, number, memo)
    except (InvalidInput, BearingError, NoSolution) as error:
        found = Outcome(number, sentence=str(error))
    for values in memo.values.values():
        del values[1:-LATEST]
    seconds = time.perf_counter() - begin
    if not first:  # which is spent on imports
        known.quickest = min(known.quickest, seconds)
        _expect(study.case, SAVED * known.quickest * points)
    return replace(found, seconds=seconds)


def _expect(case: Case, seconds: float) -> None:
    for grooves in {seat.bearing.grooves for seat in case.spindle.seats} if case.spindle else ():
        expect(seconds, geometry(grooves))


def outcome(study: Study, number: int, memo: Memo | None = None) -> Outcome:
    """A point solved.

    Raises
    ------
    InvalidInput : its values contradict one another
    NoSolution : no speed has a solution
    """
    case = vary(study.case, study.design.point(number))
    answers = solve(case, memo=memo)
    return Outcome(
        number,
        numbers=dict(_numbers(case, answers.results)),
        sentence="; ".join(unsolved(answers.results)),
        warnings=(*answers.warnings, *result_warnings(answers.results)),
        results={name: answers.results[name] for name in study.results},
    )


def _numbers(case: Case, results: Any) -> Iterator[tuple[str, tuple[float, str]]]:
    """Every headline number as variants show it."""
    for name in sorted(results, key=place):
        for each in analysis(name).numbers(results[name], case):
            words = each.heading.removesuffix(f" [{each.unit}]")
            yield f"{name}: {words}", (float(each.value), each.unit)


@lru_cache(maxsize=1)
def _unpacked(packed: bytes) -> _Known:
    return _Known(pickle.loads(packed))
