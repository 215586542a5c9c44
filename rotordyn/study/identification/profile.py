"""Profile likelihood: the least χ² over one unknown, all others sought anew at each of its values.

The interval is where χ² above the best, over the Birge factor squared, stays below t²: that of the
covariance where predictions are linear in the unknowns, and one that follows bends, kinks and
bounds elsewhere (D. Venzon and S. Moolgavkar, Appl. Statist. 37, 1988).

Theory: docs/theory/identification.md.
"""

from __future__ import annotations

import math
import pickle
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

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

Array = NDArray[np.float64]
STEP = 0.3  # from value to value, of √Δχ² over its threshold
FURTHER = 3.0  # times the step before, at most
JUMP = 0.6  # of √Δχ² where it crosses: above that a value is solved between
MOST = 12  # values on either side
HALVES = 4  # times that steps are halved on either side, where no machine is found
DIFFERS = 0.25  # of half the linear interval: worth a sentence
LOWER = 0.01  # of the threshold: χ² that far below the best is a better machine

AT_BOUND = "bound"
NO_MACHINE = "no machine found beyond"
UNFINISHED = "χ² stays below its threshold"


@dataclass(frozen=True, eq=False, slots=True)
class Profile:
    """Of unknown ``number``: ``values`` (m,), ascending [SI], least ``excess`` (m,) of χ² over the
    best there, over the Birge factor squared; ``interval`` and why each ends: at the threshold
    (empty), at a bound, or before; machines solved."""

    number: int
    values: Array
    excess: Array
    interval: tuple[float, float]
    why: tuple[str, str]
    evaluations: int


class _Point(NamedTuple):
    """``values`` (p,) of the least χ² at one value; its ``root``: √Δχ² over the threshold."""

    values: Array
    excess: float
    root: float


@dataclass(eq=False)
class _Line:
    """Unknown ``k`` of a problem held at values, others sought."""

    problem: Problem
    fit: Fit
    sure: Certainty
    k: int

    def at(self, value: float, starts: Sequence[Array]) -> _Point | None:
        """Least χ² there of all starts, as a search may end too soon; None without a machine."""
        found: list[_Point] = []
        for start in starts:
            values = np.clip(start, *self.problem.bounds)
            values[self.k] = value
            try:
                values, cost = self._least(values)
            except (InvalidInput, NoSolution):
                continue
            excess = (cost - self.fit.cost) / self.sure.birge**2
            root = math.sqrt(max(excess, 0.0)) / self.sure.quantile
            found.append(_Point(values, excess, root))
        return min(found, key=lambda each: each.excess, default=None)

    def _least(self, values: Array) -> tuple[Array, float]:
        """Values and χ² where all but one unknown are the best.

        Raises
        ------
        InvalidInput, NoSolution : no machine
        KeyboardInterrupt : interrupted
        """
        others = [j for j in range(len(values)) if j != self.k]
        if not others:
            predicted = self.problem.predicted(values)
            if predicted is None:
                raise NoSolution(self.problem.why)
            rows = self.problem.rows(predicted, values)
            return values, float(rows @ rows)
        held = replace(
            self.problem,
            case=self.problem.machine(values),
            unknowns=tuple(self.problem.unknowns[j] for j in others),
            evaluations=0,
        )
        found = nearest(held, values[others])
        self.problem.evaluations += held.evaluations
        if not found.ended:
            raise KeyboardInterrupt
        values[others] = found.values
        return values, found.cost + float(self.problem.prior_rows(values)[self.k] ** 2)

    def side(self, sign: float) -> tuple[list[_Point], float, str]:
        """Points away from the best, the end of the interval, and why it ends there."""
        low, high = (float(end[self.k]) for end in self.problem.bounds)
        bound = high if sign > 0.0 else low
        linear = self.sure.quantile * float(self.sure.deviation[self.k])
        step = STEP * min(linear or math.inf, 0.5 * (high - low))
        points = [_Point(self.fit.values, 0.0, 0.0)]
        if abs(bound - self.fit.values[self.k]) < BINDING * (high - low):
            return points, bound, AT_BOUND
        most, halves = FURTHER, HALVES
        while len(points) <= MOST:
            here = float(points[-1].values[self.k])
            value = min(max(here + sign * step, low), high)
            found = self._beyond(points, value)
            if found is None:
                if not halves:
                    return points, here, NO_MACHINE
                step, halves, most = 0.5 * abs(value - here), halves - 1, 1.0
                continue
            points.append(found)
            if found.root >= 1.0:
                return points, self._crossing(points), ""
            if value == bound:
                return points, bound, AT_BOUND
            gain = found.root - points[-2].root
            ratio = STEP / gain if gain > 0.0 else FURTHER
            step *= min(max(ratio, 1.0 / FURTHER), most)
            most = FURTHER
        return points, float(points[-1].values[self.k]), UNFINISHED

    def _beyond(self, points: list[_Point], value: float) -> _Point | None:
        """The point at the next value; others as they were last where no start has a machine."""
        return self.at(value, self._starts(points, value)) or self.at(value, [points[-1].values])

    def _starts(self, points: list[_Point], value: float) -> list[Array]:
        """Where others begin: on from the last point as the covariance says, and straight on from
        the last two."""
        scale, k, last = self.problem.scale, self.k, points[-1].values
        column, starts = self.sure.covariance[:, k], []
        if column[k] > 0.0:
            starts.append(last + scale * column / column[k] * (value - last[k]) / scale[k])
        if len(points) > 1:
            before = points[-2].values
            starts.append(last + (value - last[k]) / (last[k] - before[k]) * (last - before))
        return starts

    def _crossing(self, points: list[_Point]) -> float:
        """Where √Δχ² meets its threshold between the last two points; inserts those it needs."""
        for _ in range(MOST):
            inner, outer = points[-2:]
            share = (1.0 - inner.root) / (outer.root - inner.root)
            a, b = float(inner.values[self.k]), float(outer.values[self.k])
            value = a + share * (b - a)
            if outer.root - inner.root <= JUMP:
                break
            found = self.at(value, [inner.values + share * (outer.values - inner.values)])
            if found is None:
                break
            points.insert(len(points) - 1, found)
            if found.root >= 1.0:
                points.pop()
        return value


def profiled(packed: bytes, number: int, count: int = 1) -> Profile:
    """Profile of one unknown of a pickled problem, its fit and certainty."""
    problem, fit, sure = pickle.loads(packed)
    line = _Line(replace(problem, known=Known(), evaluations=0), fit, sure, number)
    (below, low, why_low), (above, high, why_high) = line.side(-1.0), line.side(1.0)
    every = [*below[:0:-1], *above]
    values = np.array([each.values[number] for each in every])
    excess = np.array([each.excess for each in every])
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
    """Profiles of those unknowns at ``paths`` that the problem seeks, and whether they were stopped
    before the end."""
    known = [each.path for each in problem.unknowns]
    numbers = [k for k, path in enumerate(known) if path in paths]
    packed = pickle.dumps((replace(problem, known=Known()), fit, sure))
    found: dict[int, Profile] = {}
    stopped = False
    try:
        for each in solved_here(packed, numbers, workers, profiled):
            found[each.number] = each
            progress(len(found), len(numbers))
    except KeyboardInterrupt:
        stopped = True
    return {known[k]: found[k] for k in sorted(found)}, stopped


def asked_profiles(unknowns: Sequence[Sought], asked: str | Sequence[str]) -> tuple[str, ...]:
    """Paths of the unknowns whose profiles are asked for, by path or name.

    Raises
    ------
    InvalidInput : no such unknown
    """
    every = {each.path: each.path for each in unknowns}
    if asked == ALL:
        return tuple(every)
    names = {each.name: each.path for each in unknowns}
    words = (asked,) if isinstance(asked, str) else tuple(asked)
    for word in words:
        if word not in every | names:
            raise InvalidInput(
                f"profiles: no unknown {shown(word)}; allowed: {ALL}, {', '.join(names)}"
                f"{suggestion(word, names)}"
            )
    return tuple(dict.fromkeys((every | names)[word] for word in words))


def differing(profile: Profile, sure: Certainty) -> float:
    """How far an end of the profile's interval lies from the linear one, over half of that;
    infinite where that has no width."""
    linear = sure.interval[profile.number]
    half = 0.5 * float(np.ptp(linear))
    off = float(np.abs(linear - profile.interval).max())
    return off / half if half > 0.0 else (math.inf if off > 0.0 else 0.0)


def remarks(found: Mapping[str, Profile], problem: Problem, sure: Certainty) -> list[str]:
    """What profiles say that linear intervals do not, in sentences."""
    apart, sentences = [], []
    for each in found.values():
        unknown = problem.unknowns[each.number]
        off = differing(each, sure)
        if off > DIFFERS and sure.words[each.number] != ON_A_BOUND:
            size = "" if math.isinf(off) else f" by {100.0 * off:.0f} %"
            apart.append(unknown.name + size)
        for end, why in zip(each.interval, each.why, strict=True):
            if why in (NO_MACHINE, UNFINISHED):
                at = f"{unknown.shown(end):.4g} {unknown.unit}".strip()
                sentences.append(f"the profile of {unknown.name} ends at {at}: {why}")
        least = float(each.excess.min())
        if least < -LOWER * sure.quantile**2:
            sentences.append(
                f"the profile of {unknown.name} finds χ² lower by {-least:.2g}: the search ended "
                "before the best; give more starts"
            )
    if apart:
        words = "the interval by profile departs from the linear one by more than a quarter"
        sentences.insert(0, f"{words}: {', '.join(apart)}")
    return sentences
