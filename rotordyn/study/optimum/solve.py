"""Optimise a case: the best machine, and the limits that bind it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from bearings.arguments import typed
from rotordyn.case.case import Case
from rotordyn.case.study import MOST_TRIALS
from rotordyn.case.vary import vary
from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.job.solving import restricted
from rotordyn.numerics.threads import processors
from rotordyn.quantity import suggestion
from rotordyn.study import record
from rotordyn.study.design import one_machine
from rotordyn.study.optimum.front import cost_of, trade_off
from rotordyn.study.optimum.goals import Goal, Limit
from rotordyn.study.optimum.problem import Problem, Trial, as_it_stands
from rotordyn.study.optimum.search import search
from rotordyn.study.optimum.trials import Trials
from rotordyn.study.parameter import is_whole, parameters, require_each_once, require_whole
from rotordyn.study.solve import Progress

if TYPE_CHECKING:
    import xarray as xr

UNSETTLED = "The trials ended before the search converged: more trials may improve the result."
ALIKE = 1e-6  # relative difference of costs that rounding of the parameters may cause
BINDING = 1e-3  # margin of a limit, or distance from an end over the range, that counts as binding


@dataclass(frozen=True)
class Optimum:
    """Result of a search for the best machine.

    ``start``: the case itself; ``trials`` in the order in which they were made; ``best``: the
    feasible trial that is best in the first goal, None if no trial keeps all limits; ``front``: for
    two goals, the trials of which none beats another in both. ``settled``: the search has
    converged.
    """

    problem: Problem
    start: Trial
    trials: tuple[Trial, ...]
    best: Trial | None
    front: tuple[Trial, ...] = ()
    settled: bool = True

    @property
    def units(self) -> tuple[str, ...]:
        """Printed units of goals, then limits."""
        return self.start.units

    @property
    def nearest(self) -> Trial:
        """The best trial, or the one with the least violation."""
        return self.best or min(self.trials, key=lambda t: t.violation)

    @property
    def values(self) -> dict[str, Any]:
        """Values of the best, or nearest, trial by path: numbers in SI units, or words."""
        return self.problem.labels(self.nearest.number)

    @property
    def case(self) -> Case:
        """The case with these values.

        Raises
        ------
        InvalidInput : no trial keeps all limits; the sentence names those that cannot be kept
        """
        if self.best is None:
            raise InvalidInput(" ".join(self.verdict))
        return vary(self.problem.case, self.problem.values(self.best.number))

    @property
    def binding(self) -> list[str]:
        """Binding limits, and parameters at an end of their range."""
        trial = self.nearest
        limits = zip(self.problem.limits, trial.margins, strict=False)
        found = [limit.words for limit, margin in limits if margin < BINDING]
        for p, n, last in zip(
            self.problem.parameters, trial.number, self.problem.last, strict=True
        ):
            if p.ends is not None and (n <= BINDING * last or n >= (1.0 - BINDING) * last):
                found.append(f"{'lowest' if n < 0.5 * last else 'highest'} {p.path}")
        return found

    @property
    def absent(self) -> list[str]:
        """Sentences on goals and limits some of whose numbers the best, or nearest, trial lacks."""
        trial = self.nearest
        asked = [*(g.words for g in self.problem.goals), *(x.words for x in self.problem.limits)]
        values = (*trial.goals, *trial.readings)
        return [
            f"{words}: {_absent(count)}."
            for words, count, value in zip(asked, trial.absent, values, strict=False)
            if count and not math.isnan(value)
        ]

    @property
    def verdict(self) -> list[str]:
        """Sentences: whether a machine keeps all limits, and which limits bind."""
        if self.best is not None:
            binding = self.binding
            lines = [
                f"The best is limited by {'; '.join(binding)}."
                if binding
                else "No limit is active."
            ]
            cost = cost_of(self.problem, 0)
            least = cost(self.best)
            if self.start.feasible and cost(self.start) < least - ALIKE * abs(least):
                lines.append("The unchanged case is none of the choices, and better.")
            lines += self.absent
            return lines if self.settled else [*lines, UNSETTLED]
        solved = [each for each in self.trials if each.goals]
        if not solved:
            return [f"No trial has a solution; the first: {self.trials[0].sentence}."]
        lines = ["No trial keeps all limits."]
        for k, limit in enumerate(self.problem.limits):
            top = max(solved, key=lambda t, k=k: t.margins[k])  # type: ignore[misc]
            unit = self.units[len(self.problem.goals) + k]
            if top.margins[k] < 0.0:
                value = top.readings[k]
                why = f"the nearest value is {value:.4g} {unit}"
                if value != value:
                    counts = top.absent[len(self.problem.goals) :]
                    count = sum(counts[k : k + 1])
                    why = _absent(count) if count else "the value is absent"
                    why += " (absent: satisfies leaves such numbers out)"
                lines.append(f"{limit.words}: cannot be kept, {why}.")
        absent = [
            goal.words
            for k, goal in enumerate(self.problem.goals)
            if all(math.isnan(each.goals[k]) for each in solved)
        ]
        lines += [f"{words}: no trial has a value." for words in absent]
        if len(lines) == 1:
            broken = [
                limit.words
                for limit, margin in zip(self.problem.limits, self.nearest.margins, strict=False)
                if margin < 0.0
            ]
            lines.append(
                "Each limit is kept by some trials, but none keeps all; the nearest breaks "
                f"{'; '.join(broken) or 'none, but has speeds without a solution'}."
            )
        return lines

    def dataset(self) -> xr.Dataset:
        """All trials over ``trial``: values, goals, margins, whether all limits are kept."""
        import xarray as xr

        rows = [self.problem.labels(each.number) for each in self.trials]
        columns: dict[str, Any] = {
            p.path: ("trial", np.array([row[p.path] for row in rows]), {"units": p.unit})
            for p in self.problem.parameters
        }
        for k, goal in enumerate(self.problem.goals):
            values = [each.goals[k] if each.goals else np.nan for each in self.trials]
            columns[goal.words] = ("trial", values, {"units": self.units[k]})
        for k, limit in enumerate(self.problem.limits):
            rooms = [each.margins[k] if each.margins else np.nan for each in self.trials]
            columns[f"margin: {limit.words}"] = ("trial", rooms, {"units": "1"})
        columns["feasible"] = ("trial", [each.feasible for each in self.trials])
        columns["sentence"] = ("trial", np.array([each.sentence for each in self.trials], object))
        return xr.Dataset(columns)


def _absent(count: int) -> str:
    return f"{count} of the numbers it reads {'is' if count == 1 else 'are'} absent"


def problem_of(
    case: Case,
    varied: Mapping[str, object],
    goals: Sequence[Goal],
    limits: Sequence[Limit] = (),
) -> Problem:
    """Build a problem and check it against its case; see ``optimise``."""
    if not isinstance(case, Case):
        raise InvalidInput(f"an optimum takes a case, as rotordyn.load gives it; got {shown(case)}")
    if not 1 <= len(goals) <= 2:
        raise InvalidInput(f"goals: one, or two to trade off; got {len(goals)}")
    criteria = [*(each.criterion for each in goals), *(each.criterion for each in limits)]
    for each in criteria:
        if each.analysis not in case.analyses:
            raise InvalidInput(
                f"{shown(each.of)}: begins with an analysis of the case; allowed: "
                f"{', '.join(case.analyses)}{suggestion(each.analysis, case.analyses)}"
            )
        if not ({":", "."} & set(each.of)):
            raise InvalidInput(
                f"{shown(each.of)}: name a number, '{each.of}: words', or a variable of its "
                f"dataset, '{each.of}.variable'"
            )
    needed = tuple(dict.fromkeys(each.analysis for each in criteria))
    left_out, case = tuple(case.variants), restricted(one_machine(case, varied), needed)
    varied_parameters = tuple(parameters(case, varied))
    for parameter in varied_parameters:
        if parameter.ends is None and len(parameter.values) < 2:
            raise InvalidInput(
                f"{parameter.path}: one value is no choice: give two or more, or a span"
            )
    require_each_once(varied_parameters)
    return Problem(case, varied_parameters, tuple(goals), tuple(limits), left_out)


@typed(InvalidInput, besides=["case"])
def optimise(
    case: Case,
    varied: Mapping[str, object],
    goals: Sequence[Goal],
    limits: Sequence[Limit] = (),
    *,
    trials: int = 300,
    seed: int = 0,
    workers: int | None = None,
    folder: str | Path | None = None,
    progress: Progress = lambda done, of: None,
) -> Optimum:
    """Search the best values of the parameters of a case.

    Parameters
    ----------
    varied : lists of values or ``Span`` by dotted path, as ``rotordyn.vary`` takes them
    goals : one, or two whose trade-off is sought
    limits : limits that the best machine keeps
    trials : largest number of machines to solve; if there are fewer choices, all are tried
    seed : of the search
    workers : processes; as many as there are processors by default
    folder : where trials are kept as they are made; the same problem resumes from there
    progress : called with the number of trials made and allowed

    Returns
    -------
    Optimum : also where no trial keeps all limits, which its ``verdict`` says

    Raises
    ------
    InvalidInput : a path, value, goal or limit that cannot be, before the search begins; a folder
        of another problem
    NoSolution : the case as it stands has no solution
    """
    problem = problem_of(case, varied, goals, limits)
    return solved(problem, trials, seed, workers, folder, progress)


def solved(
    problem: Problem,
    trials: int,
    seed: int = 0,
    workers: int | None = None,
    folder: str | Path | None = None,
    progress: Progress = lambda done, of: None,
) -> Optimum:
    """Search the optimum of a problem; see ``optimise``."""
    if not is_whole(trials, 1, MOST_TRIALS):
        raise InvalidInput(
            f"trials: given {shown(trials)}; allowed: a whole number up to {MOST_TRIALS}"
        )
    require_whole("seed", seed, 0)
    if workers is not None:
        require_whole("workers", workers, 1)
    start = as_it_stands(problem)
    place = None if folder is None else Path(folder)
    with nullcontext() if place is None else record.alone(place, "trials"):
        made = Trials(problem, trials, workers or processors(), place, progress)
        if len(problem.goals) == 2:
            front, converged = trade_off(problem, made, seed)
        else:
            front, converged = [], search(problem, made, cost_of(problem, 0), trials, seed)
    feasible = [each for each in made.made.values() if each.feasible]
    best = min(feasible, key=cost_of(problem, 0), default=None)
    return Optimum(problem, start, tuple(made.made.values()), best, tuple(front), converged)
