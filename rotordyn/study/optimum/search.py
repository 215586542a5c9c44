"""The search: all choices if they are few, else differential evolution (evenly distributed places
if trials are few), then a local search.

Differential evolution (Storn & Price, J. Global Optimization 11 (1997) 341; ``scipy``) compares
places by the rules of Deb (Comput. Methods Appl. Mech. Eng. 186 (2000) 311): a feasible place beats
an infeasible one, the lower cost wins among the former, the smaller violation among the latter. The
best combinations of integer parameters are then refined by a trust-region method with constraints
(COBYQA, Ragonneau & Zhang, 2024); if all parameters are integers, neighbours of the best places are
tried.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from itertools import product
from typing import Any

import numpy as np

from rotordyn.arrays import Array
from rotordyn.study.latin_hypercube import latin_hypercube
from rotordyn.study.optimum.problem import Place, Problem, Trial
from rotordyn.study.optimum.trials import Spent, Trials

BROKEN = 1e9  # cost of an infeasible place, to which its violation is added
BROAD = 0.7  # share of the trials of a search spent on differential evolution
FEW = 3  # generations below which there is no evolution
POPULATION = (8, 12, 48)  # places per parameter, least and largest number
FOLLOWED = 3  # integer combinations refined by local searches
SMALL = 1e-3  # relative reduction of the cost that counts as progress
STEP, LAST = 0.08, 1e-6  # first and last radius of a local search, over the range

Cost = Callable[[Trial], float]


def search(problem: Problem, trials: Trials, cost: Cost, most: int, seed: int) -> bool:
    """Make up to ``most`` trials to minimise ``cost``; the first ones include the case itself and
    the best trials made before.

    Returns whether the search has converged.
    """
    with suppress(Spent):
        if problem.choices <= most:
            trials.at([tuple(map(float, x)) for x in product(*_numbers(problem))])
            return True
        end = len(trials.made) + most
        ranked = sorted(trials.made.values(), key=lambda t: _energy(t, cost, 1.0))
        first = [*filter(None, [problem.present]), *(each.number for each in ranked)]
        _evolve(problem, trials, cost, int(BROAD * most), seed, [*dict.fromkeys(first)])
        finish = beside if problem.whole.all() else _follow
        if finish(problem, trials, cost, end):
            return True
        if (remaining := end - len(trials.made)) > 0:  # too few for a local search
            trials.at([problem.place(x) for x in _spread(problem, remaining, seed + 1)])
    return False


def _spread(problem: Problem, count: int, seed: int) -> Array:
    """Places (count, n) distributed evenly over the design space."""
    shares = latin_hypercube(count, len(problem.parameters), seed)
    places = shares * np.where(problem.whole, problem.last + 1.0, 1.0)
    whole = np.minimum(np.floor(places), problem.last)
    return np.asarray(np.where(problem.whole, whole, places))


def _numbers(problem: Problem) -> list[range]:
    return [range(int(n) + 1) for n in problem.last]


def _energy(trial: Trial, cost: Cost, scale: float) -> float:
    """Objective of differential evolution: the rules of Deb as one number."""
    return cost(trial) / scale if trial.feasible else BROKEN + trial.violation


def _scale(trials: Trials, cost: Cost) -> float:
    """Largest cost so far; costs over it stay well below ``BROKEN``."""
    sizes = [abs(cost(t)) for t in trials.made.values() if t.goals and np.isfinite(cost(t))]
    return max(sizes, default=1.0) or 1.0


def _evolve(
    problem: Problem, trials: Trials, cost: Cost, most: int, seed: int, known: Sequence[Place]
) -> None:
    from scipy.optimize import differential_evolution

    size = len(problem.parameters)
    each, least, largest = POPULATION
    count = int(np.clip(each * size, least, min(largest, max(most // 4, least))))
    first = _spread(problem, count, seed)
    for k, place in enumerate(known[: count // 2]):
        first[k] = place
    if most < FEW * count:  # too few generations: the local search gets the remaining trials
        trials.at([problem.place(x) for x in first[: max(most, 1)]])
        return

    def energies(x: Array) -> Array:
        evaluated = trials.at([problem.place(column) for column in np.atleast_2d(x.T)])
        scale = _scale(trials, cost)
        return np.array([_energy(each, cost, scale) for each in evaluated])

    differential_evolution(
        energies,
        [(0.0, float(n)) for n in problem.last],
        init=first,
        integrality=problem.whole,
        maxiter=max(1, most // count - 1),
        mutation=(0.4, 0.9),
        tol=1e-6,
        rng=seed,
        polish=False,
        vectorized=True,
        updating="deferred",
    )


def beside(problem: Problem, trials: Trials, cost: Cost, end: int) -> bool:
    """Try untried neighbours of the best place that has any, again and again; return whether all
    neighbours of the best one were tried."""
    while trials.made:
        ranked = sorted(trials.made.values(), key=lambda t: _energy(t, cost, 1.0))
        neighbours = ([*_untried(problem, trials, each.number)] for each in ranked)
        remaining, places = end - len(trials.made), next(filter(None, neighbours), None)
        if places is None or remaining <= 0:
            return not [*_untried(problem, trials, ranked[0].number)]
        trials.at(places[:remaining])
    return False


def _untried(problem: Problem, trials: Trials, place: Place) -> Iterator[Place]:
    """Yield untried places that differ from ``place`` in one parameter, by one index."""
    for k, last in enumerate(problem.last):
        for number in (place[k] - 1.0, place[k] + 1.0):
            neighbour = (*place[:k], number, *place[k + 1 :])
            if 0.0 <= number <= last and neighbour not in trials.made:
                yield neighbour


def _follow(problem: Problem, trials: Trials, cost: Cost, end: int) -> bool:
    """Run local searches from the best integer combinations; return whether that of the best one
    has converged."""
    ranked = sorted(trials.made.values(), key=lambda t: _energy(t, cost, 1.0))
    starts: dict[tuple[float, ...], Trial] = {}
    for each in ranked:
        starts.setdefault(_combination(problem, each.number), each)
    chosen = [t for t in [*starts.values()][:FOLLOWED] if t.goals and np.isfinite(cost(t))]
    converged: dict[Place, bool] = {}
    for k, start in enumerate(chosen):
        share = (end - len(trials.made)) // (len(chosen) - k)
        if share > 2 * len(problem.parameters):
            converged[_combination(problem, start.number)] = local(
                problem, trials, cost, start, share
            )
    best = min(trials.made.values(), key=lambda t: _energy(t, cost, 1.0), default=None)
    return best is not None and converged.get(_combination(problem, best.number), False)


def _combination(problem: Problem, place: Place) -> tuple[float, ...]:
    return tuple(np.array(place)[problem.whole])


def local(problem: Problem, trials: Trials, cost: Cost, start: Trial, most: int) -> bool:
    """Local search over the continuous parameters, the integers being those of ``start``; costs are
    relative to its cost.

    Returns whether it has converged: the last trials, as many as determine the slopes of all
    parameters, after as many before them, reduced the cost by less than ``SMALL``.

    Raises
    ------
    Spent : all allowed trials have been made
    """
    from scipy.optimize import NonlinearConstraint, minimize

    free = ~problem.whole
    base, scale = np.array(start.number), abs(cost(start)) or 1.0
    energy = [_energy(start, cost, scale)]  # lowest so far, after each trial

    def at(x: Array) -> Trial:
        place = base.copy()
        place[free] = x
        return trials.at([problem.place(place)])[0]

    def value(x: Array) -> float:
        worth = cost(found) if (found := at(x)).goals else np.nan
        energy.append(min(energy[-1], _energy(found, cost, scale)))
        if np.isneginf(worth):  # the goal is unbounded
            return -BROKEN
        return worth / scale if np.isfinite(worth) else BROKEN

    def room(x: Array) -> Any:
        found = at(x)
        return np.clip(found.margins, -1.0, 1.0) if found.goals else -np.ones(len(problem.limits))

    found = minimize(
        value,
        base[free],
        method="COBYQA",
        bounds=[(0.0, 1.0)] * int(free.sum()),
        constraints=[NonlinearConstraint(room, 0.0, np.inf)] if problem.limits else [],
        options={"maxfev": most, "initial_tr_radius": STEP, "final_tr_radius": LAST},
    )
    slopes = 2 * int(free.sum()) + 1
    still = len(energy) > 2 * slopes and energy[-1 - slopes] - energy[-1] < SMALL
    return bool(found.success) or still
