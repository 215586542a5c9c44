"""The trade-off of two goals: places where none can be better without the other being worse."""

from __future__ import annotations

import numpy as np

from rotordyn.study.optimum.problem import Problem, Trial
from rotordyn.study.optimum.search import Cost, search
from rotordyn.study.optimum.trials import Trials

LEVELS = 7  # of the second goal, between the best of either
ENDS = 0.4  # of the trials go to the best of each goal alone
STARTS = 12  # known places a search of a level starts from
STEEP = 1e3  # growth of the first cost, over it, where the second is a level above its level


def cost_of(problem: Problem, goal: int) -> Cost:
    """The cost of one of the goals."""
    return lambda trial: problem.goals[goal].cost(trial.goals[goal]) if trial.goals else np.inf


def trade_off(problem: Problem, trials: Trials, seed: int) -> list[Trial]:
    """Front of two goals: the best of each, then of the first with the second held at levels."""
    costs = [cost_of(problem, k) for k in (0, 1)]
    most = trials.most - len(trials.made)
    if problem.choices <= most:
        search(problem, trials, costs[0], most, seed)
        return front(problem, trials)
    for cost in costs:
        search(problem, trials, cost, int(0.5 * ENDS * most), seed, list(trials.made))
    found = front(problem, trials)
    if len(found) > 1:
        ends = costs[1](found[-1]), costs[1](found[0])
        for level in np.linspace(*ends, LEVELS + 2)[1:-1]:
            left = trials.most - len(trials.made)
            share = max(int((1.0 - ENDS) * most / LEVELS), 1)
            held = _held(costs, float(level))
            near = sorted(trials.made.values(), key=lambda t: (not t.feasible, held(t)))
            starts = [each.number for each in near[:STARTS]]
            search(problem, trials, held, min(share, left), seed, starts)
    return front(problem, trials)


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
        if costs[1](each) < least:
            kept.append(each)
            least = costs[1](each)
    return kept
