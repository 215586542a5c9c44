"""The best machine found, and why it is no better."""

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

UNSETTLED = "The trials ended before the search had settled: more of them may go further."
ALIKE = 1e-6  # of a cost: so much is rounding of what is chosen
BINDING = 1e-3  # margin of a limit, or share of a way between ends, that holds the best back


@dataclass(frozen=True)
class Optimum:
    """What a search for the best machine came to.

    ``start``: the case as it stands; ``trials`` in the order in which they were made; ``best``: the
    feasible one of the first goal, None where no trial keeps all limits; ``front``: of two goals,
    the trials of which none beats another in both. ``settled``: the search came to where its
    last trials hardly found better.
    """

    problem: Problem
    start: Trial
    trials: tuple[Trial, ...]
    best: Trial | None
    front: tuple[Trial, ...] = ()
    settled: bool = True

    @property
    def units(self) -> tuple[str, ...]:
        """Printed units of what goals, then limits, read."""
        return self.start.units

    @property
    def nearest(self) -> Trial:
        """The best trial, or the one that breaks limits least."""
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
        """What holds the best back: limits without room, ends of what may be chosen."""
        near = self.nearest
        limits = zip(self.problem.limits, near.margins, strict=False)
        found = [limit.words for limit, margin in limits if margin < BINDING]
        for p, n, last in zip(self.problem.parameters, near.number, self.problem.last, strict=True):
            if p.ends is not None and (n <= BINDING * last or n >= (1.0 - BINDING) * last):
                found.append(f"{'lowest' if n < 0.5 * last else 'highest'} {p.path}")
        return found

    @property
    def absent(self) -> list[str]:
        """Of which goals and limits the best, or nearest, lacks some of several numbers."""
        near = self.nearest
        asked = [*(g.words for g in self.problem.goals), *(x.words for x in self.problem.limits)]
        values = (*near.goals, *near.readings)
        return [
            f"{words}: {count} of the numbers it reads {'is' if count == 1 else 'are'} absent."
            for words, count, value in zip(asked, near.absent, values, strict=False)
            if count and not math.isnan(value)
        ]

    @property
    def verdict(self) -> list[str]:
        """In sentences: whether there is a machine that keeps all limits, and what binds."""
        if self.best is not None:
            held = self.binding
            lines = [f"The best is held by {'; '.join(held)}." if held else "No limit holds it."]
            cost = cost_of(self.problem, 0)
            least = cost(self.best)
            if self.start.feasible and cost(self.start) < least - ALIKE * abs(least):
                lines.append("The case as it stands is none of the choices, and better.")
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
                nearest = (
                    f"nearest reads {value:.4g} {unit}" if value == value else "value is absent"
                )
                lines.append(f"{limit.words}: cannot be kept, the {nearest}.")
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
                "Each limit is kept by some, but not all by one; the nearest breaks "
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


def problem_of(
    case: Case,
    varied: Mapping[str, object],
    goals: Sequence[Goal],
    limits: Sequence[Limit] = (),
) -> Problem:
    """A problem held against its case; see ``optimise``."""
    if not isinstance(case, Case):
        raise InvalidInput(f"an optimum takes a case, as rotordyn.load gives it; got {shown(case)}")
    if not 1 <= len(goals) <= 2:
        raise InvalidInput(f"goals: one, or two to trade off; got {len(goals)}")
    asked = [*(each.criterion for each in goals), *(each.criterion for each in limits)]
    for each in asked:
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
    needed = tuple(dict.fromkeys(each.analysis for each in asked))
    left_out, case = tuple(case.variants), restricted(one_machine(case, varied), needed)
    found = tuple(parameters(case, varied))
    for one in found:
        if one.ends is None and len(one.values) < 2:
            raise InvalidInput(f"{one.path}: one value is no choice: give two or more, or a span")
    require_each_once(found)
    return Problem(case, found, tuple(goals), tuple(limits), left_out)


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
    """The best of what may be varied in a case.

    Parameters
    ----------
    varied : dotted paths, as ``rotordyn.vary`` takes them, to lists of values or ``Span``
    goals : one, or two whose trade-off is sought
    limits : that the best keeps
    trials : how many machines are solved at most; fewer choices than that are all tried
    seed : of the search
    workers : processes; as many as there are processors by default
    folder : where trials are kept as they are made; the same problem goes on from there
    progress : called with the number of trials made and granted

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
    """The best found of a problem; see ``optimise``."""
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
            found, settled = trade_off(problem, made, seed)
        else:
            found, settled = [], search(problem, made, cost_of(problem, 0), trials, seed)
    good = [each for each in made.made.values() if each.feasible]
    best = min(good, key=cost_of(problem, 0), default=None)
    return Optimum(problem, start, tuple(made.made.values()), best, tuple(found), settled)
