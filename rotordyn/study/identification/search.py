"""Search of the values of the unknowns that fit the measurements best.

Nonlinear least squares with bounds (scipy's trust region reflective), from several starts. The mean
absolute difference is minimised by iteratively reweighted least squares (P. Holland and R. Welsch,
Commun. Statist. A6, 1977).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rotordyn.arrays import Array
from rotordyn.errors import NoSolution
from rotordyn.study.identification.problem import Problem
from rotordyn.study.latin_hypercube import latin_hypercube

FAR = 1e4  # weighed difference in every row of a machine without a solution
SMALL = 1e-7  # relative change of the cost, or of the unknowns, that ends a search
MOST = 60  # machines of one search, without those of Jacobians
HELD = 1e-3  # weight of the regularisation towards the start, over that of the prior knowledge
ROUNDS = 40  # reweightings at most
GAIN = 1e-3  # improvement over the median difference (robust against outliers) that ends them
CANDIDATES = 6  # machines drawn for each further start


@dataclass(frozen=True, eq=False, slots=True)
class Fit:
    """Result of a search: ``values`` (p,) [SI], ``cost`` χ² (sum of squares of all rows), and
    ``predicted`` values of every measurement. ``ended``: whether the search was not interrupted;
    ``limited``: whether it ended by its limit of machines. ``absolute``: mean absolute difference
    in standard deviations, plus the penalty of priors and nuisances, if that is minimised."""

    values: Array
    cost: float
    predicted: list[Array]
    ended: bool = True
    limited: bool = False
    absolute: float | None = None

    @property
    def merit(self) -> float:
        """Quantity that is minimised."""
        return self.cost if self.absolute is None else self.absolute


class _Objective:
    """Residuals and Jacobian over scaled unknowns z (p,); keeps the best machine so far, for the
    case of an interruption.

    A weak regularisation towards ``begin`` (p,), not part of the cost, holds unknowns on which no
    row depends: otherwise steps would grow along them, and be shortened for all unknowns.
    """

    def __init__(self, problem: Problem, begin: Array) -> None:
        self.problem = problem
        self.begin = begin
        self.best: Fit | None = None
        self._last: tuple[bytes, list[Array] | None] = (b"", None)

    def first(self) -> Fit:
        """Evaluate the start; the fit counts as not ended.

        Raises
        ------
        NoSolution : the machine at the start has no solution
        """
        self.rows(self.begin)
        return self.reached

    @property
    def reached(self) -> Fit:
        """Best fit so far; raises NoSolution if no machine had a solution."""
        if self.best is None:
            raise NoSolution(self.problem.why)
        return self.best

    def rows(self, z: Array) -> Array:
        """Residual rows (n,); all ``FAR`` if the machine has no solution."""
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
        """Jacobian of the rows (n, p)."""
        values = z * self.problem.scale
        predicted = self._predicted(values)
        if predicted is None:
            return np.zeros((self._size, len(z)))
        slopes = self.problem.slopes(values, predicted)
        regularisation = HELD * np.eye(len(z))
        rows = self.problem.weighed_slopes(slopes)
        return np.concatenate([rows, self.problem.prior_slopes, regularisation])

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
    """Search from one start, first with smoothed measurements; if interrupted, the best so far.

    Raises
    ------
    NoSolution : the machine at the start has no solution
    """
    for blurred in problem.blurred:
        fit = nearest(blurred, start)
        problem.evaluations += blurred.evaluations
        start = fit.values
        if not fit.ended:
            return _Objective(problem, start / problem.scale).first()
    return nearest(problem, start)


def nearest(problem: Problem, start: Array) -> Fit:
    """Local search from one start; if interrupted, the best so far.

    Raises
    ------
    NoSolution : the machine at the start has no solution
    """
    from scipy.optimize import least_squares

    low, high = (end / problem.scale for end in problem.bounds)
    room = 1e-6 * (high - low)  # scipy needs a start strictly within the bounds
    begin = np.clip(start / problem.scale, low + room, high - room)
    objective = _Objective(problem, begin)
    objective.first()
    try:
        solution = least_squares(
            objective.rows,
            begin,
            objective.slopes,
            (low, high),
            ftol=SMALL,
            xtol=SMALL,
            max_nfev=MOST,
        )
    except KeyboardInterrupt:
        return objective.reached
    return replace(objective.reached, ended=True, limited=solution.status == 0)


def search_absolute(problem: Problem, start: Array) -> Fit:
    """Minimise the mean absolute difference from one start; if interrupted, the best so far.

    Reweighting begins at the least-squares fit and at the start itself, and the better result
    counts: either may end in a worse minimum.

    Raises
    ------
    NoSolution : the machine at the start has no solution
    """
    from_squares = _weighed_anew(problem, search(problem, start))
    if not from_squares.ended:
        return from_squares
    begin = replace(_Objective(problem, start / problem.scale).first(), ended=True)
    return min(from_squares, _weighed_anew(problem, begin), key=lambda fit: fit.merit)


def _weighed_anew(problem: Problem, begin: Fit) -> Fit:
    """Iteratively reweighted least squares from ``begin``; return the best of all iterates."""
    best, least, fit = begin, np.inf, begin
    for _ in range(ROUNDS):
        pairs = [*zip(problem.weighings, fit.predicted, strict=True)]
        weighings = [(each.anew(one), one) for each, one in pairs]
        rows = np.concatenate([each.residual(one) / each.data.deviation for each, one in weighings])
        priors = problem.prior_rows(fit.values)
        squares = float(priors @ priors) + sum(each.beside(one) for each, one in weighings)
        mean = float(np.abs(rows).mean()) + squares / (2.0 * len(rows))
        gain = least - mean
        if gain > 0.0:
            best, least = replace(fit, absolute=mean), mean
        if not fit.ended or gain < GAIN * float(np.median(np.abs(rows))):
            break
        weighed = replace(problem, weights=tuple(each.weight for each, _ in weighings))
        fit = search(weighed, fit.values)
        problem.evaluations = weighed.evaluations
    rows = problem.rows(best.predicted, best.values)
    cost = float(rows @ rows)
    return replace(best, cost=cost, ended=fit.ended, limited=fit.limited)


def begin_at(problem: Problem, start: int, seed: int) -> Array:
    """The stated start (0), or the best of some machines drawn within the bounds.

    Raises
    ------
    NoSolution : none of them has a solution
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
