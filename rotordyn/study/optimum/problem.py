"""The choices of a design problem, and the evaluation of one of them."""

from __future__ import annotations

import math
import pickle
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from bearings.errors import BearingError
from rotordyn.arrays import Array, Flags
from rotordyn.case.case import Case
from rotordyn.case.paths import found_at
from rotordyn.case.vary import changed
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.job.solving import unsolved
from rotordyn.report.warnings import result_warnings
from rotordyn.study.neighbours import Neighbours
from rotordyn.study.optimum.goals import LARGEST, Goal, Limit
from rotordyn.study.parameter import Parameter

DIGITS = 10  # digits of a share: closer trials are the same
KEPT = -1e-9  # least margin of a limit that counts as kept

Place = tuple[float, ...]


@dataclass(frozen=True)
class Problem:
    """A case, its parameters, goals and limits; ``left_out``: variants of the case, ignored.

    A ``place`` (point of the design space) has a number for each parameter: its share in [0, 1] of
    the range between the ends, or the index of a value.
    """

    case: Case
    parameters: tuple[Parameter, ...]
    goals: tuple[Goal, ...]
    limits: tuple[Limit, ...] = ()
    left_out: tuple[str, ...] = ()

    @cached_property
    def whole(self) -> Flags:
        """Flags of the parameters with listed or integer values."""
        return np.array([p.ends is None or p.whole for p in self.parameters])

    @cached_property
    def last(self) -> Array:
        """Highest index of each parameter; 1 for shares."""
        return np.array([float(self._count(p) - 1) if w else 1.0 for p, w in self._each])

    @property
    def _each(self) -> Any:
        return zip(self.parameters, self.whole, strict=True)

    @staticmethod
    def _count(p: Parameter) -> int:
        return len(p.values) if p.ends is None else int(p.ends[1] - p.ends[0]) + 1

    @property
    def choices(self) -> float:
        """Number of choices; infinite with a continuous parameter."""
        return math.prod(n + 1.0 for n in self.last) if self.whole.all() else math.inf

    def place(self, x: Sequence[float] | Array) -> Place:
        """Round x (n,) to the nearest place."""
        pairs = zip(np.clip(x, 0.0, self.last), self.whole, strict=True)
        return tuple(float(round(v)) if w else round(float(v), DIGITS) for v, w in pairs)

    @cached_property
    def present(self) -> Place | None:
        """Place of the case itself; None if it is not one of the choices."""
        shares = [_share(p, [v for v, _ in found_at(self.case, p.path)]) for p in self.parameters]
        defined = [share for share in shares if share is not None]
        return self.place(defined) if len(defined) == len(shares) else None

    def values(self, place: Place) -> dict[str, Any]:
        """Values at a place by path, as ``vary`` takes them."""
        return {p.path: self._value(p, w, s) for (p, w), s in zip(self._each, place, strict=True)}

    def labels(self, place: Place) -> dict[str, Any]:
        """Coordinates of a place by path: numbers in SI units, or words."""
        return {
            p.path: p.labels[int(s)] if p.ends is None else self._value(p, w, s)
            for (p, w), s in zip(self._each, place, strict=True)
        }

    @staticmethod
    def _value(p: Parameter, whole: bool, share: float) -> Any:
        if p.ends is None:
            return p.values[int(share)]
        return int(p.ends[0]) + int(share) if whole else p.at(share)


def _share(p: Parameter, values: list[Any]) -> float | None:
    """Share or index of the value common to all items of a path; None if they differ, or the value
    is not a choice."""
    if p.ends is None:
        pairs = [*zip(p.values, p.labels, strict=True)]
        numbers = {next((k for k, pair in enumerate(pairs) if v in pair), None) for v in values}
        index = numbers.pop() if len(numbers) == 1 else None
        return None if index is None else float(index)
    low, high = p.ends
    if len(set(values)) != 1 or not isinstance(value := values[0], float | int):
        return None
    if isinstance(value, bool) or not low <= value <= high:
        return None
    if p.whole:
        return float(value - low)
    return math.log(value / low) / math.log(high / low) if p.log else (value - low) / (high - low)


@dataclass(frozen=True)
class Trial:
    """Evaluation of a place, its ``number``.

    ``goals``: worst values, as printed; ``margins`` of the limits, over their bounds, and
    ``readings``, the values with these margins; ``units`` of goals, then limits, and how many of
    their numbers are ``absent``. ``sentence``: why there is no result, or why some speeds have none
    or end early. ``seconds``: time to solve it.
    """

    number: Place
    goals: tuple[float, ...] = ()
    margins: tuple[float, ...] = ()
    readings: tuple[float, ...] = ()
    units: tuple[str, ...] = ()
    absent: tuple[int, ...] = ()
    sentence: str = ""
    warnings: tuple[str, ...] = ()
    seconds: float = 0.0

    @property
    def violation(self) -> float:
        """Sum of the violations of limits, over their bounds; 0 if all are kept."""
        if not self.goals or self.sentence or any(math.isnan(v) for v in self.goals):
            return LARGEST * (1.0 + len(self.margins))
        return sum(-m for m in self.margins if m < KEPT)

    @property
    def feasible(self) -> bool:
        """Whether all goals have values and all limits are kept."""
        return self.violation == 0.0


def solve_trial(packed: bytes, place: Place, places: int = 1) -> Trial:
    """Evaluate a place of a pickled problem in this process, which has ``places`` to evaluate."""
    problem, neighbours = _unpacked(packed)
    begin = time.perf_counter()
    try:
        result = trial(problem, place, neighbours)
    except (InvalidInput, BearingError, NoSolution) as error:
        result = Trial(place, sentence=str(error))
    return replace(result, seconds=time.perf_counter() - begin)


def trial(problem: Problem, place: Place, neighbours: Neighbours | None = None) -> Trial:
    """Evaluate a place; ``neighbours``: solver that reuses stages of previous machines.

    Raises
    ------
    InvalidInput : its values contradict one another, or a goal or limit selects nothing
    NoSolution : no speed has a solution
    """
    return _read(problem, place, changed(problem.case, problem.values(place)), neighbours)


def as_it_stands(problem: Problem) -> Trial:
    """Evaluate the case without any change; raises what ``trial`` raises."""
    return _read(problem, (), problem.case)


def _read(
    problem: Problem, place: Place, case: Case, neighbours: Neighbours | None = None
) -> Trial:
    """Solve a case and read its goals and limits."""
    machine, _ = (neighbours or Neighbours()).solve(case)
    goals = [(goal, goal.criterion.read(case, machine.results)) for goal in problem.goals]
    limits = [(limit, limit.criterion.read(case, machine.results)) for limit in problem.limits]
    margins = [limit.margin(reading) for limit, reading in limits]
    return Trial(
        place,
        goals=tuple(goal.worst(reading) for goal, reading in goals),
        margins=tuple(margin for margin, _ in margins),
        readings=tuple(value for _, value in margins),
        units=tuple(reading.unit for _, reading in (*goals, *limits)),
        absent=tuple(reading.absent for _, reading in (*goals, *limits)),
        sentence="; ".join(dict.fromkeys((*unsolved(machine.results), *_early(machine.results)))),
        warnings=(*machine.warnings, *result_warnings(machine.results)),
    )


def _early(results: Mapping[str, Any]) -> list[str]:
    """Sentences on time responses that end early, so that their largest values are not known."""
    return [str(w) for r in results.values() for w in getattr(r, "ending", ()) if str(w)]


@lru_cache(maxsize=1)
def _unpacked(packed: bytes) -> tuple[Problem, Neighbours]:
    return pickle.loads(packed)[0], Neighbours()
