"""Which places are tried: all of few choices, else differential evolution, or where trials are few
places spread evenly, and a local search.

Differential evolution (Storn & Price, J. Global Optimization 11 (1997) 341; ``scipy``) compares
places by the rules of Deb (Comput. Methods Appl. Mech. Eng. 186 (2000) 311): what keeps the limits
beats what does not, the lower cost wins among the former, the smaller violation among the others.
The best combinations of whole numbers are then followed by a trust-region method that knows the
limits (COBYQA, Ragonneau & Zhang, 2024); where there are whole numbers alone, choices beside the
best ones are tried.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from itertools import product
from typing import Any

import numpy as np

from rotordyn.results.kinds import Array
from rotordyn.study.latin_hypercube import latin_hypercube
from rotordyn.study.optimum.problem import Place, Problem, Trial
from rotordyn.study.optimum.trials import Spent, Trials

BROKEN = 1e9  # cost of a place that breaks a limit, its violation beside
BROAD = 0.7  # of the trials of a search go to differential evolution
FEW = 3  # populations: with less there is no evolution
POPULATION = (8, 12, 48)  # places a parameter has, least and most of all
FOLLOWED = 3  # combinations of whole numbers that a local search follows
SMALL = 1e-3  # of a cost: less is no gain
STEP, LAST = 0.08, 1e-6  # of the way between the ends: first and last radius of a local search

Cost = Callable[[Trial], float]


def search(problem: Problem, trials: Trials, cost: Cost, most: int, seed: int) -> bool:
    """Make up to ``most`` trials where they lower ``cost``, starting from the case as it stands and
    the best that were made before, too.

    Returns whether it has settled: nothing beside the best one is known, or likely, to be better.
    """
    with suppress(Spent):
        if problem.choices <= most:
            trials.at([tuple(map(float, x)) for x in product(*_numbers(problem))])
            return True
        end = len(trials.made) + most
        ranked = sorted(trials.made.values(), key=lambda t: _energy(t, cost, 1.0))
        before = [*filter(None, [problem.present]), *(each.number for each in ranked)]
        _evolve(problem, trials, cost, int(BROAD * most), seed, [*dict.fromkeys(before)])
        finish = beside if problem.whole.all() else _follow
        if finish(problem, trials, cost, end):
            return True
        if (left := end - len(trials.made)) > 0:  # too few for a local search
            trials.at([problem.place(x) for x in _spread(problem, left, seed + 1)])
    return False


def _spread(problem: Problem, count: int, seed: int) -> Array:
    """So many places evenly between all ends (count, n)."""
    shares = latin_hypercube(count, len(problem.parameters), seed)
    places = shares * np.where(problem.whole, problem.last + 1.0, 1.0)
    whole = np.minimum(np.floor(places), problem.last)
    return np.asarray(np.where(problem.whole, whole, places))


def _numbers(problem: Problem) -> list[range]:
    return [range(int(n) + 1) for n in problem.last]


def _energy(trial: Trial, cost: Cost, scale: float) -> float:
    """What differential evolution makes least: the rules of Deb as one number."""
    return cost(trial) / scale if trial.feasible else BROKEN + trial.violation


def _scale(trials: Trials, cost: Cost) -> float:
    """The largest cost so far, over which each lies well below ``BROKEN``."""
    sizes = [abs(cost(t)) for t in trials.made.values() if t.goals and np.isfinite(cost(t))]
    return max(sizes, default=1.0) or 1.0


def _evolve(
    problem: Problem, trials: Trials, cost: Cost, most: int, seed: int, before: Sequence[Place]
) -> None:
    from scipy.optimize import differential_evolution

    size = len(problem.parameters)
    each, least, largest = POPULATION
    count = int(np.clip(each * size, least, min(largest, max(most // 4, least))))
    first = _spread(problem, count, seed)
    for k, place in enumerate(before[: count // 2]):
        first[k] = place
    if most < FEW * count:  # too few generations to get anywhere: the local search has the others
        trials.at([problem.place(x) for x in first[: max(most, 1)]])
        return

    def energies(x: Array) -> Array:
        found = trials.at([problem.place(column) for column in np.atleast_2d(x.T)])
        scale = _scale(trials, cost)
        return np.array([_energy(each, cost, scale) for each in found])

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
    """Choices not yet tried beside the best one that has such, again and again; whether all beside
    the best of all were."""
    while trials.made:
        ranked = sorted(trials.made.values(), key=lambda t: _energy(t, cost, 1.0))
        untried = ([*_untried(problem, trials, each.number)] for each in ranked)
        left, places = end - len(trials.made), next(filter(None, untried), None)
        if places is None or left <= 0:
            return not [*_untried(problem, trials, ranked[0].number)]
        trials.at(places[:left])
    return False


def _untried(problem: Problem, trials: Trials, place: Place) -> Iterator[Place]:
    """Places that differ from one by one value, the one before or after it."""
    for k, last in enumerate(problem.last):
        for number in (place[k] - 1.0, place[k] + 1.0):
            other = (*place[:k], number, *place[k + 1 :])
            if 0.0 <= number <= last and other not in trials.made:
                yield other


def _follow(problem: Problem, trials: Trials, cost: Cost, end: int) -> bool:
    """Local searches from the best combinations of whole numbers; whether that of the best one has
    settled."""
    ranked = sorted(trials.made.values(), key=lambda t: _energy(t, cost, 1.0))
    starts: dict[tuple[float, ...], Trial] = {}
    for each in ranked:
        starts.setdefault(_combination(problem, each.number), each)
    chosen = [t for t in [*starts.values()][:FOLLOWED] if t.goals and np.isfinite(cost(t))]
    settled: dict[Place, bool] = {}
    for k, start in enumerate(chosen):
        left = (end - len(trials.made)) // (len(chosen) - k)
        if left > 2 * len(problem.parameters):
            settled[_combination(problem, start.number)] = local(problem, trials, cost, start, left)
    best = min(trials.made.values(), key=lambda t: _energy(t, cost, 1.0), default=None)
    return best is not None and settled.get(_combination(problem, best.number), False)


def _combination(problem: Problem, place: Place) -> tuple[float, ...]:
    return tuple(np.array(place)[problem.whole])


def local(problem: Problem, trials: Trials, cost: Cost, start: Trial, most: int) -> bool:
    """A search between the ends, its whole numbers those of ``start``; costs over that of it.

    Returns whether it has settled: so many trials as tell it the slopes of all parameters, after as
    many before them, lowered the cost by less than ``SMALL``.

    Raises
    ------
    Spent : all trials that were granted have been made
    """
    from scipy.optimize import NonlinearConstraint, minimize

    free = ~problem.whole
    base, scale = np.array(start.number), abs(cost(start)) or 1.0
    energy = [_energy(start, cost, scale)]  # of the best, after each trial

    def at(x: Array) -> Trial:
        place = base.copy()
        place[free] = x
        return trials.at([problem.place(place)])[0]

    def value(x: Array) -> float:
        worth = cost(found) if (found := at(x)).goals else np.nan
        energy.append(min(energy[-1], _energy(found, cost, scale)))
        if np.isneginf(worth):  # a largest value without bound
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
