"""Profile likelihood: χ² over one unknown, minimised over all others at each of its values.

The interval is where χ² above the best, over the Birge factor squared, stays below t²: the interval
of the covariance if predictions are linear in the unknowns, and otherwise one that accounts for
curvature, kinks and bounds (D. Venzon and S. Moolgavkar, Appl. Statist. 37, 1988).

Theory: docs/theory/identification.md.
"""

from __future__ import annotations

import math
import pickle
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array
from rotordyn.case.identification import ALL
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.field import shown
from rotordyn.quantity import suggestion
from rotordyn.study.identification.certainty import BINDING, ON_A_BOUND, Certainty
from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.search import Fit, nearest
from rotordyn.study.identification.trial import Known
from rotordyn.study.identification.unknown import Sought
from rotordyn.study.workers import solved_here

STEP = 0.3  # increase of √Δχ² per step, over its threshold
FURTHER = 3.0  # largest ratio of a step to the previous one
JUMP = 0.6  # increase of √Δχ² at the threshold above which a value in between is solved
MOST = 12  # values on either side
HALVES = 4  # halvings of the step on either side, where no machine is found
DIFFERS = 0.25  # difference from the linear interval, over half of it, that is remarked
LOWER = 0.01  # decrease of χ² below the best, over the threshold, that is remarked

AT_BOUND = "bound"
NO_MACHINE = "no machine found beyond"
UNFINISHED = "χ² stays below its threshold"


@dataclass(frozen=True, eq=False, slots=True)
class Profile:
    """Profile of unknown ``number``: ``values`` (m,), ascending [SI], and ``excess`` (m,) of the
    minimised χ² over the best, divided by the Birge factor squared; ``interval``, and ``why`` each
    side ends: "" at the threshold, at a bound, or before; number of machines solved."""

    number: int
    values: Array
    excess: Array
    interval: tuple[float, float]
    why: tuple[str, str]
    evaluations: int


class _Point(NamedTuple):
    """Minimum at one value of the unknown: ``values`` (p,); ``root``: √Δχ² over its threshold."""

    values: Array
    excess: float
    root: float


@dataclass(eq=False)
class _Line:
    """Minimisation over all unknowns but ``k``, which is held at given values."""

    problem: Problem
    fit: Fit
    sure: Certainty
    k: int

    def at(self, value: float, starts: Sequence[Array]) -> _Point | None:
        """Best minimum from all starts, as a search may end early; None without a solution."""
        minima: list[_Point] = []
        for start in starts:
            values = np.clip(start, *self.problem.bounds)
            values[self.k] = value
            try:
                values, cost = self._least(values)
            except (InvalidInput, NoSolution):
                continue
            excess = (cost - self.fit.cost) / self.sure.birge**2
            root = math.sqrt(max(excess, 0.0)) / self.sure.quantile
            minima.append(_Point(values, excess, root))
        return min(minima, key=lambda each: each.excess, default=None)

    def _least(self, values: Array) -> tuple[Array, float]:
        """Minimise χ² over all unknowns but ``k``; return values and χ².

        Raises
        ------
        InvalidInput, NoSolution : the machine has no solution
        KeyboardInterrupt : interrupted
        """
        others = [j for j in range(len(values)) if j != self.k]
        if not others:
            predicted = self.problem.predicted(values)
            if predicted is None:
                raise NoSolution(self.problem.why)
            rows = self.problem.rows(predicted, values)
            return values, float(rows @ rows)
        reduced = replace(
            self.problem,
            case=self.problem.machine(values),
            unknowns=tuple(self.problem.unknowns[j] for j in others),
            evaluations=0,
        )
        fit = nearest(reduced, values[others])
        self.problem.evaluations += reduced.evaluations
        if not fit.ended:
            raise KeyboardInterrupt
        values[others] = fit.values
        return values, fit.cost + float(self.problem.prior_rows(values)[self.k] ** 2)

    def side(self, sign: float) -> tuple[list[_Point], float, str]:
        """March away from the best; return the points, the end of the interval, and why it ends."""
        low, high = (float(end[self.k]) for end in self.problem.bounds)
        bound = high if sign > 0.0 else low
        linear = self.sure.quantile * float(self.sure.deviation[self.k])
        step = STEP * min(linear or math.inf, 0.5 * (high - low))
        points = [_Point(self.fit.values, 0.0, 0.0)]
        if abs(bound - self.fit.values[self.k]) < BINDING * (high - low):
            return points, bound, AT_BOUND
        most, halves = FURTHER, HALVES
        while len(points) <= MOST:
            current = float(points[-1].values[self.k])
            value = min(max(current + sign * step, low), high)
            point = self._beyond(points, value)
            if point is None:
                if not halves:
                    return points, current, NO_MACHINE
                step, halves, most = 0.5 * abs(value - current), halves - 1, 1.0
                continue
            points.append(point)
            if point.root >= 1.0:
                return points, self._crossing(points), ""
            if value == bound:
                return points, bound, AT_BOUND
            gain = point.root - points[-2].root
            ratio = STEP / gain if gain > 0.0 else FURTHER
            step *= min(max(ratio, 1.0 / FURTHER), most)
            most = FURTHER
        return points, float(points[-1].values[self.k]), UNFINISHED

    def _beyond(self, points: list[_Point], value: float) -> _Point | None:
        """Minimum at the next value; from the last point if no extrapolation has a solution."""
        return self.at(value, self._starts(points, value)) or self.at(value, [points[-1].values])

    def _starts(self, points: list[_Point], value: float) -> list[Array]:
        """Start values of the other unknowns: extrapolated by the covariance, and linearly from the
        last two points."""
        scale, k, last = self.problem.scale, self.k, points[-1].values
        column, starts = self.sure.covariance[:, k], []
        if column[k] > 0.0:
            starts.append(last + scale * column / column[k] * (value - last[k]) / scale[k])
        if len(points) > 1:
            previous = points[-2].values
            starts.append(last + (value - last[k]) / (last[k] - previous[k]) * (last - previous))
        return starts

    def _crossing(self, points: list[_Point]) -> float:
        """Value where √Δχ² meets its threshold between the last two points; inserts points."""
        for _ in range(MOST):
            inner, outer = points[-2:]
            share = (1.0 - inner.root) / (outer.root - inner.root)
            a, b = float(inner.values[self.k]), float(outer.values[self.k])
            value = a + share * (b - a)
            if outer.root - inner.root <= JUMP:
                break
            point = self.at(value, [inner.values + share * (outer.values - inner.values)])
            if point is None:
                break
            points.insert(len(points) - 1, point)
            if point.root >= 1.0:
                points.pop()
        return value


def profiled(packed: bytes, number: int, count: int = 1) -> Profile:
    """Profile of one unknown; ``packed``: pickled problem, fit and certainty."""
    problem, fit, sure = pickle.loads(packed)
    line = _Line(replace(problem, known=Known(), evaluations=0), fit, sure, number)
    (below, low, why_low), (above, high, why_high) = line.side(-1.0), line.side(1.0)
    points = [*below[:0:-1], *above]
    values = np.array([each.values[number] for each in points])
    excess = np.array([each.excess for each in points])
    ends, why = (low, high), (why_low, why_high)
    return Profile(number, values, excess, ends, why, line.problem.evaluations)


def profiles(
    problem: Problem,
    fit: Fit,
    sure: Certainty,
    paths: Sequence[str],
    workers: int,
    progress: Callable[[int, int], None],
) -> tuple[dict[str, Profile], bool]:
    """Profiles by path of the unknowns among ``paths``, and whether they were interrupted."""
    known = [each.path for each in problem.unknowns]
    numbers = [k for k, path in enumerate(known) if path in paths]
    packed = pickle.dumps((replace(problem, known=Known()), fit, sure))
    by_number: dict[int, Profile] = {}
    stopped = False
    try:
        for each in solved_here(packed, numbers, workers, profiled):
            by_number[each.number] = each
            progress(len(by_number), len(numbers))
    except KeyboardInterrupt:
        stopped = True
    return {known[k]: by_number[k] for k in sorted(by_number)}, stopped


def asked_profiles(unknowns: Sequence[Sought], asked: str | Sequence[str]) -> tuple[str, ...]:
    """Paths of the unknowns whose profiles are requested by path or name.

    Raises
    ------
    InvalidInput : no such unknown
    """
    paths = {each.path: each.path for each in unknowns}
    if asked == ALL:
        return tuple(paths)
    names = {each.name: each.path for each in unknowns}
    words = (asked,) if isinstance(asked, str) else tuple(asked)
    for word in words:
        if word not in paths | names:
            raise InvalidInput(
                f"profiles: no unknown {shown(word)}; allowed: {ALL}, {', '.join(names)}"
                f"{suggestion(word, names)}"
            )
    return tuple(dict.fromkeys((paths | names)[word] for word in words))


def differing(profile: Profile, sure: Certainty) -> float:
    """Largest difference of an end of the profile's interval from the linear one, over half of
    that; infinite if the linear one has no width."""
    linear = sure.interval[profile.number]
    half = 0.5 * float(np.ptp(linear))
    off = float(np.abs(linear - profile.interval).max())
    return off / half if half > 0.0 else (math.inf if off > 0.0 else 0.0)


def remarks(found: Mapping[str, Profile], problem: Problem, sure: Certainty) -> list[str]:
    """Sentences on profiles that differ from linear intervals, end early or find a lower χ²."""
    differing_names, sentences = [], []
    for each in found.values():
        unknown = problem.unknowns[each.number]
        off = differing(each, sure)
        if off > DIFFERS and sure.words[each.number] != ON_A_BOUND:
            size = "" if math.isinf(off) else f" by {100.0 * off:.0f} %"
            differing_names.append(unknown.name + size)
        for end, reason in zip(each.interval, each.why, strict=True):
            if reason in (NO_MACHINE, UNFINISHED):
                at = f"{unknown.shown(end):.4g} {unknown.unit}".strip()
                sentences.append(f"the profile of {unknown.name} ends at {at}: {reason}")
        least = float(each.excess.min())
        if least < -LOWER * sure.quantile**2:
            sentences.append(
                f"the profile of {unknown.name} finds χ² lower by {-least:.2g}: the search ended "
                "before the best; give more starts"
            )
    if differing_names:
        words = "the interval by profile departs from the linear one by more than a quarter"
        sentences.insert(0, f"{words}: {', '.join(differing_names)}")
    return sentences
