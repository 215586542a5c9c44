"""The trade-off of two goals: places where none can be better without the other being worse."""

from __future__ import annotations

from contextlib import suppress

import numpy as np

from rotordyn.study.optimum.problem import Problem, Trial
from rotordyn.study.optimum.search import Cost, beside, local, search
from rotordyn.study.optimum.trials import Spent, Trials

LEVELS = 7  # of the second goal, between the best of either, at most
EACH = 4  # trials of a level for every parameter: with fewer there are less levels
ENDS = 0.6  # of the trials go to the best of each goal alone
STEEP = 1e3  # growth of the first cost, over it, where the second is a level above its level


def cost_of(problem: Problem, goal: int) -> Cost:
    """The cost of one of the goals."""
    return lambda trial: problem.goals[goal].cost(trial.goals[goal]) if trial.goals else np.inf


def trade_off(problem: Problem, trials: Trials, seed: int) -> tuple[list[Trial], bool]:
    """Front of two goals: the best of each, then of the first with the second held at levels.

    Returns also whether the searches for the best of each have settled.
    """
    costs = [cost_of(problem, k) for k in (0, 1)]
    most = trials.most - len(trials.made)
    if problem.choices <= most:
        search(problem, trials, costs[0], most, seed)
        return front(problem, trials), True
    share = int(0.5 * ENDS * most)
    settled = [search(problem, trials, cost, share, seed) for cost in costs]
    found = front(problem, trials)
    levels = [costs[1](each) for each in found]
    if len(found) > 1 and np.isfinite(levels).all():
        with suppress(Spent):
            _between(problem, trials, costs, (levels[-1], levels[0]))
    else:  # one machine is the best in both so far
        search(problem, trials, costs[0], trials.most - len(trials.made), seed + 1)
    return front(problem, trials), all(settled)


def _between(
    problem: Problem, trials: Trials, costs: list[Cost], ends: tuple[float, float]
) -> None:
    """The best of the first goal with the second held at levels, each sought from the best so far.

    Raises
    ------
    Spent : all trials that were granted have been made
    """
    least = EACH * len(problem.parameters)
    levels = int(np.clip((trials.most - len(trials.made)) // least, 1, LEVELS))
    for k, level in enumerate(np.linspace(*ends, levels + 2)[1:-1]):
        held, left = _held(costs, float(level)), trials.most - len(trials.made)
        near = min(trials.made.values(), key=lambda t: (not t.feasible, held(t)))
        share = left // (levels - k)
        if problem.whole.all():
            beside(problem, trials, held, len(trials.made) + share)
        else:
            local(problem, trials, held, near, share)


def _held(costs: list[Cost], level: float) -> Cost:
    """The first cost, and what the second has above a level as a steep slope."""

    def cost(trial: Trial) -> float:
        first, second = costs[0](trial), costs[1](trial)
        size = abs(level) or 1.0
        return first + STEEP * abs(first) * max(second - level, 0.0) / size

    return cost


def front(problem: Problem, trials: Trials) -> list[Trial]:
    """Feasible trials that no other beats in both goals, by the first; equal ones once."""
    costs = [cost_of(problem, k) for k in (0, 1)]
    good = [each for each in trials.made.values() if each.feasible]
    good.sort(key=lambda t: (costs[0](t), costs[1](t)))
    kept: list[Trial] = []
    least = np.inf
    for each in good:
        if not kept or costs[1](each) < least:
            kept.append(each)
            least = costs[1](each)
    return kept
