"""The trade-off of two goals: the Pareto front, where neither improves but at the other's cost."""

from __future__ import annotations

from contextlib import suppress

import numpy as np

from rotordyn.study.optimum.problem import Problem, Trial
from rotordyn.study.optimum.search import Cost, beside, local, search
from rotordyn.study.optimum.trials import Spent, Trials

LEVELS = 7  # largest number of levels of the second goal, between the best of either goal
EACH = 4  # trials per parameter that a level needs at least
ENDS = 0.6  # share of the trials spent on the best of each goal alone
STEEP = 1e3  # penalty on the first cost, over it, per relative excess of the second over its level


def cost_of(problem: Problem, goal: int) -> Cost:
    """Cost function of one goal; infinite without a solution."""
    return lambda trial: problem.goals[goal].cost(trial.goals[goal]) if trial.goals else np.inf


def trade_off(problem: Problem, trials: Trials, seed: int) -> tuple[list[Trial], bool]:
    """Search the front of two goals: the best of each, then the best of the first with the second
    limited to levels in between.

    Returns the front, and whether the searches for the best of each goal have converged.
    """
    costs = [cost_of(problem, k) for k in (0, 1)]
    most = trials.most - len(trials.made)
    if problem.choices <= most:
        search(problem, trials, costs[0], most, seed)
        return front(problem, trials), True
    share = int(0.5 * ENDS * most)
    converged = [search(problem, trials, cost, share, seed) for cost in costs]
    best = front(problem, trials)
    levels = [costs[1](each) for each in best]
    if len(best) > 1 and np.isfinite(levels).all():
        with suppress(Spent):
            _between(problem, trials, costs, (levels[-1], levels[0]))
    else:  # one machine is the best in both so far
        search(problem, trials, costs[0], trials.most - len(trials.made), seed + 1)
    return front(problem, trials), all(converged)


def _between(
    problem: Problem, trials: Trials, costs: list[Cost], ends: tuple[float, float]
) -> None:
    """Search the best of the first goal with the second limited to levels, each from the best so
    far.

    Raises
    ------
    Spent : all allowed trials have been made
    """
    least = EACH * len(problem.parameters)
    levels = int(np.clip((trials.most - len(trials.made)) // least, 1, LEVELS))
    for k, level in enumerate(np.linspace(*ends, levels + 2)[1:-1]):
        penalised, remaining = _held(costs, float(level)), trials.most - len(trials.made)
        start = min(trials.made.values(), key=lambda t: (not t.feasible, penalised(t)))
        share = remaining // (levels - k)
        if problem.whole.all():
            beside(problem, trials, penalised, len(trials.made) + share)
        else:
            local(problem, trials, penalised, start, share)


def _held(costs: list[Cost], level: float) -> Cost:
    """The first cost with a steep penalty on the excess of the second over a level."""

    def cost(trial: Trial) -> float:
        first, second = costs[0](trial), costs[1](trial)
        size = abs(level) or 1.0
        return first + STEEP * abs(first) * max(second - level, 0.0) / size

    return cost


def front(problem: Problem, trials: Trials) -> list[Trial]:
    """Feasible trials that no other beats in both goals, sorted by the first; equal ones once."""
    costs = [cost_of(problem, k) for k in (0, 1)]
    feasible = [each for each in trials.made.values() if each.feasible]
    feasible.sort(key=lambda t: (costs[0](t), costs[1](t)))
    nondominated: list[Trial] = []
    least = np.inf
    for each in feasible:
        if not nondominated or costs[1](each) < least:
            nondominated.append(each)
            least = costs[1](each)
    return nondominated
