"""Values of the unknowns that explain measurements best.

Nonlinear least squares between ends (scipy's trust region reflective), from several starts. The
mean absolute difference is made least by least squares whose rows are weighed anew until nothing
changes (iteratively reweighted: P. Holland and R. Welsch, Commun. Statist. A6, 1977).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import NoSolution
from rotordyn.study.identification.problem import Problem
from rotordyn.study.latin_hypercube import latin_hypercube

Array = NDArray[np.float64]
FAR = 1e4  # weighed difference of every row of a machine without a solution
SMALL = 1e-7  # relative change of the cost, or of the unknowns, that ends a search
MOST = 60  # machines of one search, without those of Jacobians
HELD = 1e-3  # deviations by which an unknown is pulled to the start, over what was known before
ROUNDS = 40  # of weighing anew
GAIN = 1e-3  # of the median difference, which outliers leave alone: a smaller gain ends them
CANDIDATES = 6  # machines tried for each further start


@dataclass(frozen=True, eq=False, slots=True)
class Fit:
    """The best of a search: ``values`` (p,) [SI], its ``cost`` χ² (sum of squares of all rows),
    ``predicted`` of every measurement; ``ended``: whether the search came to its end, ``limited``:
    by the most machines that it may take; ``absolute``: the mean absolute difference, in
    deviations, with half of the squares of what is known before, where that is made least."""

    values: Array
    cost: float
    predicted: list[Array]
    ended: bool = True
    limited: bool = False
    absolute: float | None = None

    @property
    def merit(self) -> float:
        """What is made least."""
        return self.cost if self.absolute is None else self.absolute


class _Objective:
    """Residuals and Jacobian over scaled unknowns z (p,); keeps the best machine seen, so that an
    interrupted search has one.

    A weak pull to ``begin`` (p,), which counts in no cost, holds unknowns that no row follows:
    steps of the search would grow along them, and be cut for all.
    """

    def __init__(self, problem: Problem, begin: Array) -> None:
        self.problem = problem
        self.begin = begin
        self.best: Fit | None = None
        self._last: tuple[bytes, list[Array] | None] = (b"", None)

    def first(self) -> Fit:
        """The machine to begin with, not ended.

        Raises
        ------
        NoSolution : it has none
        """
        self.rows(self.begin)
        return self.reached

    @property
    def reached(self) -> Fit:
        """The best machine so far; NoSolution where none has one."""
        if self.best is None:
            raise NoSolution(self.problem.why)
        return self.best

    def rows(self, z: Array) -> Array:
        """Weighed differences (n,), ``FAR`` each where the machine has no solution."""
        values = z * self.problem.scale
        predicted = self._predicted(values)
        if predicted is None:
            return np.full(self._size, FAR)
        rows = self.problem.rows(predicted, values)
        cost = float(rows @ rows)
        if self.best is None or cost < self.best.cost:
            self.best = Fit(values, cost, predicted, ended=False)
        return np.concatenate([rows, HELD * (z - self.begin)])

    def slopes(self, z: Array) -> Array:
        """Derivatives of the rows (n, p)."""
        values = z * self.problem.scale
        predicted = self._predicted(values)
        if predicted is None:
            return np.zeros((self._size, len(z)))
        slopes = self.problem.slopes(values, predicted)
        held = HELD * np.eye(len(z))
        rows = self.problem.weighed_slopes(slopes)
        return np.concatenate([rows, self.problem.prior_slopes, held])

    def _predicted(self, values: Array) -> list[Array] | None:
        key = values.tobytes()
        if self._last[0] != key:
            self._last = key, self.problem.predicted(values)
        return self._last[1]

    @property
    def _size(self) -> int:
        rows = sum(
            len(m.data.observed) + len(m.data.column_names) for m in self.problem.measurements
        )
        return rows + 2 * len(self.problem.unknowns)


def search(problem: Problem, start: Array) -> Fit:
    """The best from one start, led there by blurred measurements; interrupted, the best so far.

    Raises
    ------
    NoSolution : the machine at the start has none
    """
    for blurred in problem.blurred:
        led = nearest(blurred, start)
        problem.evaluations += blurred.evaluations
        start = led.values
        if not led.ended:
            return _Objective(problem, start / problem.scale).first()
    return nearest(problem, start)


def nearest(problem: Problem, start: Array) -> Fit:
    """The best about one start; interrupted, the best so far.

    Raises
    ------
    NoSolution : the machine at the start has none
    """
    from scipy.optimize import least_squares

    low, high = (end / problem.scale for end in problem.bounds)
    room = 1e-6 * (high - low)  # scipy begins between the ends, on none
    begin = np.clip(start / problem.scale, low + room, high - room)
    goal = _Objective(problem, begin)
    goal.first()
    try:
        found = least_squares(
            goal.rows, begin, goal.slopes, (low, high), ftol=SMALL, xtol=SMALL, max_nfev=MOST
        )
    except KeyboardInterrupt:
        return goal.reached
    return replace(goal.reached, ended=True, limited=found.status == 0)


def search_absolute(problem: Problem, start: Array) -> Fit:
    """The best by the mean absolute difference from one start; interrupted, the best so far.

    Rows are weighed anew from the least squares and from the start itself: either may end where the
    other goes on.

    Raises
    ------
    NoSolution : the machine at the start has none
    """
    found = _weighed_anew(problem, search(problem, start))
    if not found.ended:
        return found
    begin = replace(_Objective(problem, start / problem.scale).first(), ended=True)
    return min(found, _weighed_anew(problem, begin), key=lambda fit: fit.merit)


def _weighed_anew(problem: Problem, begin: Fit) -> Fit:
    """The best of least squares whose rows are weighed by the differences before, again and again,
    ``begin`` among them."""
    best, least, found = begin, np.inf, begin
    for _ in range(ROUNDS):
        pairs = [*zip(problem.weighings, found.predicted, strict=True)]
        anew = [(each.anew(one), one) for each, one in pairs]
        rows = np.concatenate([each.residual(one) / each.data.deviation for each, one in anew])
        priors = problem.prior_rows(found.values)
        squares = float(priors @ priors) + sum(each.beside(one) for each, one in anew)
        mean = float(np.abs(rows).mean()) + squares / (2.0 * len(rows))
        gain = least - mean
        if gain > 0.0:
            best, least = replace(found, absolute=mean), mean
        if not found.ended or gain < GAIN * float(np.median(np.abs(rows))):
            break
        weighed = replace(problem, weights=tuple(each.weight for each, _ in anew))
        found = search(weighed, found.values)
        problem.evaluations = weighed.evaluations
    rows = problem.rows(best.predicted, best.values)
    cost = float(rows @ rows)
    return replace(best, cost=cost, ended=found.ended, limited=found.limited)


def begin_at(problem: Problem, start: int, seed: int) -> Array:
    """The stated start (0), or the best of some machines drawn between the ends.

    Raises
    ------
    NoSolution : none of them has one
    """
    if start == 0:
        return problem.start
    low, high = problem.bounds
    best, least = problem.start, np.inf
    for share in latin_hypercube(CANDIDATES, len(low), (seed, start)):
        values = low + share * (high - low)
        predicted = problem.predicted(values)
        if predicted is None:
            continue
        rows = problem.rows(predicted, values)
        cost = float(rows @ rows)
        if cost < least:
            best, least = values, cost
    return best
