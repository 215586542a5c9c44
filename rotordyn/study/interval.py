"""The range of every headline number and curve over what is uncertain of a case.

Hypotheses are combined, each combination solved as a machine of its own. Of tolerances each goes to
its two ends alone, and ``quantiles`` joins the effects; two corners, where all go to their ends
together, tell how far their sum holds. With ``samples`` machines are drawn at random instead.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.case.asked import Asked, asked_of
from rotordyn.case.case import Case
from rotordyn.case.tolerance import Tolerance
from rotordyn.case.uncertain import Uncertain
from rotordyn.job.values import Values, difference, values_of
from rotordyn.results.headline import Curve
from rotordyn.results.interval import ENDS, Interval
from rotordyn.study import quantiles
from rotordyn.study.machines import Machines, lean
from rotordyn.study.sensitivity import Derivatives, derivatives

Array = NDArray[np.float64]
Progress = Callable[[str], None]
RULES = 0.1  # share of the range from which a tolerance rules a number
BENT = 0.05  # of the change from end to end: how far from a straight line it is not seen


class Differences(NamedTuple):
    """How far machines lie from the nominal one: ``numbers`` (machines, numbers) in printed units,
    ``points`` (machines, points) of curves, logarithms where these are logarithmic."""

    numbers: Array
    points: Array


class Nominal(NamedTuple):
    """The machine of the case as solved for its results, and at the few speeds of the others."""

    values: Values
    base: Values

    @property
    def numbers(self) -> Array:
        """Headline numbers in printed units."""
        return np.array([each.value for each in self.values.numbers.values()], dtype=float)

    @property
    def points(self) -> Array:
        """Points of all curves; NaN of logarithmic ones, whose differences are logarithms."""
        curves = self.values.curves.values()
        parts = [np.full(len(c.x), np.nan) if c.log else np.asarray(c.y, float) for c in curves]
        return np.concatenate(parts) if parts else np.empty(0)

    def of(self, machines: Sequence[Values]) -> Differences:
        """Differences of machines from it; NaN where they have no such number."""
        points = sum(len(curve.x) for curve in self.values.curves.values())
        size, count = len(machines), len(self.values.numbers)
        return Differences(
            np.array([self._numbers(each) for each in machines], float).reshape(size, count),
            np.array([self._points(each) for each in machines], float).reshape(size, points),
        )

    def _numbers(self, machine: Values) -> list[float]:
        known, base = machine.numbers, self.base.numbers
        return [
            known[key].value - base[key].value if key in known and key in base else np.nan
            for key in self.values.numbers
        ]

    def _points(self, machine: Values) -> Array:
        parts = [self._curve(key, curve, machine) for key, curve in self.values.curves.items()]
        return np.concatenate(parts) if parts else np.empty(0)

    def _curve(self, key: str, curve: Curve, machine: Values) -> Array:
        if key not in machine.curves or key not in self.base.curves:
            return np.full(len(curve.x), np.nan)
        return difference(curve, machine.curves[key], self.base.curves[key])


def interval(
    case: Case, results: Mapping[str, Any], progress: Progress = lambda name: None
) -> Interval:
    """How sure the ``results`` of ``case`` are, over what it says is uncertain.

    Raises
    ------
    InvalidInput : what is uncertain contradicts the case; nothing is uncertain
    NoSolution : the nominal machine has none
    """
    asked = asked_of(case)
    machines = Machines(lean(case))
    nominal = Nominal(values_of(case, results), machines.values({}))
    total = _count(asked, case.uncertain)
    progress(f"interval, {total} machines")
    combined = nominal.of(machines.all(list(asked.combinations)))
    toleranced = _toleranced(case, asked, machines, nominal)
    found = derivatives(asked, machines, nominal.values.numbers)
    return _joined(asked, nominal, combined, toleranced, found, machines, results)


def _count(asked: Asked, given: Uncertain | None) -> int:
    combinations = sum(1 for _ in asked.combinations)
    return combinations + 2 * len(asked.tolerances) + (given.samples or 0 if given else 0)


class Toleranced(NamedTuple):
    """Changes over tolerances: ``numbers`` and ``points`` (…, 2) of 95 %, ``worst`` of all;
    ``effect`` (numbers, sources, 2); ``interaction`` (numbers,); ``without``: how many machines
    have no such number, which that of the case has."""

    numbers: Array
    points: Array
    worst: Array
    effect: Array
    interaction: Array
    without: NDArray[np.int64]


def _toleranced(case: Case, asked: Asked, machines: Machines, nominal: Nominal) -> Toleranced:
    given = asked.tolerances
    count = len(nominal.values.numbers)
    if not given:
        none, curves = np.zeros((count, 2)), np.zeros((len(nominal.points), 2))
        nowhere = np.full(count, np.nan), np.zeros(count, dtype=int)
        return Toleranced(none, curves, none, np.zeros((count, 0, 2)), *nowhere)
    solved = [_along(each, (0.0, 1.0), machines, nominal) for each in given]
    solved = _refined(given, solved, machines, nominal)
    numbers, points = ([each.of_what(k) for each in solved] for k in range(2))
    effect = np.stack([each.change[[0, -1]].T for each in numbers], axis=1)
    corners = _corners(given, effect, machines, nominal) if len(given) > 1 else (None, None)
    every = [each.found.numbers for each in solved]
    every += [] if corners[0] is None else [corners[0].change]
    found = quantiles.ranges(nominal.numbers, numbers, corners[0])
    of_curves = quantiles.ranges(nominal.points, points, corners[1]).usual
    usual, worst = found.usual, found.worst
    if case.uncertain is not None and case.uncertain.samples:
        changes = sampled(given, case.uncertain.samples, case.uncertain.seed)
        drawn = nominal.of(machines.all(changes))
        usual, of_curves = (_tails(each) for each in drawn)
        worst = _ends(drawn.numbers)
        every.append(drawn.numbers)
    without = np.isnan(nominal.numbers + np.concatenate(every)).sum(axis=0)
    without[np.isnan(nominal.numbers)] = 0
    without[(nominal.numbers > 0.0) & (nominal.numbers + usual[:, 0] <= 0.0)] += 1  # a load lost
    return Toleranced(usual, of_curves, worst, effect, found.interaction, without)


def _corners(
    given: Sequence[Tolerance], effect: Array, machines: Machines, nominal: Nominal
) -> tuple[quantiles.Corners, quantiles.Corners]:
    """Two machines of which all tolerances are off at once: their numbers, points of curves."""
    scale = np.nanmax(np.abs(effect), axis=(1, 2), initial=0.0)
    scaled = np.nan_to_num(effect / np.where(scale > 0.0, scale, 1.0)[:, None, None])
    middle = np.array([each.nominal for each in given])
    share = quantiles.corner_shares(scaled[..., 1] - scaled[..., 0], middle)
    found = nominal.of(machines.all([_together(given, row.tolist()) for row in share]))
    return quantiles.Corners(share, found.numbers), quantiles.Corners(share, found.points)


def _together(given: Sequence[Tolerance], shares: Sequence[float]) -> dict[str, Any]:
    """Values by path of a machine that is off by shares of all tolerances."""
    pairs = zip(given, shares, strict=True)
    return {path: value for each, share in pairs for path, value in each.at(share).items()}


class Along(NamedTuple):
    """Machines along one tolerance: shares of its way, differences there."""

    given: Tolerance
    share: tuple[float, ...]
    found: Differences

    def of_what(self, place: int) -> quantiles.Effect:
        """The effect on numbers (0) or on points of curves (1)."""
        change, nominal = self.found[place], self.given.nominal
        return quantiles.Effect(np.array(self.share), change, nominal, self.given.levels)


def _along(
    given: Tolerance, shares: Sequence[float], machines: Machines, nominal: Nominal
) -> Along:
    """The machines at some shares of the way, and the nominal one."""
    every = sorted({*shares, given.nominal})
    changes = [{} if share == given.nominal else given.at(share) for share in every]
    return Along(given, tuple(every), nominal.of(machines.all(changes)))


def _refined(
    given: Sequence[Tolerance], solved: list[Along], machines: Machines, nominal: Nominal
) -> list[Along]:
    """The same with two machines more along tolerances that rule a number and bend it."""
    ends = np.array([np.nan_to_num(each.found.numbers[[0, -1]]) for each in solved])
    share = (ends**2).max(axis=1)
    share = share / np.maximum(share.sum(axis=0), 1e-300)
    middle = [each.nominal for each in given]
    low, high = ends[:, 0], ends[:, 1]
    half = np.clip(middle, quantiles.EDGE, 1.0 - quantiles.EDGE)[:, None]
    bend = np.abs(low * (1.0 - half) + high * half)  # of the chord, at the nominal value
    bent = bend > BENT * np.maximum(np.abs(high - low), 1e-300)
    chosen = ((share > RULES) & bent).any(axis=1)
    for k in np.flatnonzero(chosen).tolist():
        if not given[k].levels:
            inner = (middle[k] / 2.0, (1.0 + middle[k]) / 2.0)
            solved[k] = _along(given[k], (0.0, *inner, 1.0), machines, nominal)
    return solved


def sampled(given: Sequence[Tolerance], count: int, seed: int) -> list[dict[str, Any]]:
    """Machines drawn within tolerances, each evenly (Latin hypercube): values by path."""
    from scipy.stats import qmc

    shares = qmc.LatinHypercube(len(given), rng=seed).random(count)
    return [_together(given, row.tolist()) for row in shares]


def _tails(drawn: Array) -> Array:
    """Ends of what 95 of 100 machines (machines, n) have, (n, 2)."""
    known = np.isfinite(drawn).any(axis=0)
    ends = np.zeros((drawn.shape[1], 2))
    half = quantiles.COVERED / 2.0
    ends[known] = np.nanpercentile(drawn[:, known], (50.0 - half, 50.0 + half), axis=0).T
    return ends


def _least(values: Array) -> Array:
    return np.nanmin(np.vstack([values, np.zeros(values.shape[1])]), axis=0)


def _joined(
    asked: Asked,
    nominal: Nominal,
    combined: Differences,
    toleranced: Toleranced,
    found: Derivatives,
    machines: Machines,
    results: Mapping[str, Any],
) -> Interval:
    numbers, curves = nominal.values.numbers, nominal.values.curves
    value = nominal.numbers
    length = [len(curve.x) for curve in curves.values()]
    y = np.concatenate([np.asarray(c.y, float) for c in curves.values()]) if curves else np.empty(0)
    log = np.repeat([curve.log for curve in curves.values()], length).astype(bool)
    over = _ends(combined.points)
    by_combination = _each(nominal, combined, machines.all(list(asked.combinations)))
    return Interval(
        number=tuple(numbers),
        source=tuple(each.path for each in asked.tolerances),
        end=ENDS,
        combination=tuple(_said(asked, each) for each in asked.combinations),
        path=asked.paths,
        curve=tuple(curves),
        unit=tuple(each.unit for each in numbers.values()),
        nominal=value,
        by_combination=by_combination,
        hypotheses=_limits(np.column_stack([value, by_combination])),
        tolerances=value[:, None] + toleranced.numbers,
        worst=value[:, None] + toleranced.worst,
        effect=toleranced.effect,
        interaction=toleranced.interaction,
        without=_missing(by_combination),
        without_within=toleranced.without,
        numerical_error=np.array([_numerical(key, results) for key in numbers]),
        tolerance=tuple(each.text for each in asked.tolerances),
        derivative=found.derivative,
        elasticity=found.elasticity,
        range_effect=found.over_range,
        curve_of=np.repeat(np.arange(len(curves)), length),
        x=np.concatenate([np.asarray(c.x, float) for c in curves.values()]) if curves else y,
        curve_nominal=y,
        curve_hypotheses=_moved(y, log, over),
        curve_tolerances=_moved(y, log, toleranced.points),
        runs=machines.solved,
        lost="; ".join(dict.fromkeys(machines.lost)),
    )


def _each(nominal: Nominal, combined: Differences, machines: Sequence[Values]) -> Array:
    """Numbers by combination; as they are where the machine of the case has none."""
    value = nominal.numbers[:, None]
    keys, none = [*nominal.values.numbers], np.nan
    own = [[m.numbers[k].value if k in m.numbers else none for m in machines] for k in keys]
    return np.where(np.isnan(value), np.reshape(own, (len(keys), -1)), value + combined.numbers.T)


def _limits(values: Array) -> Array:
    """Lowest and highest of those that are numbers (n, 2)."""
    low, high = np.fmin.reduce(values, axis=1), np.fmax.reduce(values, axis=1)
    return np.stack([low, high], axis=1)


def _missing(values: Array) -> NDArray[np.int64]:
    """How many are no numbers, where some are (n,)."""
    none = np.isnan(values)
    return np.where(none.all(axis=1), 0, none.sum(axis=1))


def _ends(changes: Array) -> Array:
    """Lowest and highest change (n, 2), that of the case itself, 0, among them."""
    return np.stack([_least(changes), -_least(-changes)], axis=1)


def _moved(y: Array, log: NDArray[np.bool_], changes: Array) -> Array:
    """Points of curves moved by changes, of logarithms where they are logarithmic."""
    changes = np.nan_to_num(changes)
    with np.errstate(over="ignore", invalid="ignore"):
        return np.where(
            log[:, None],
            y[:, None] * np.exp(np.where(log[:, None], changes, 0.0)),
            y[:, None] + changes,
        )


def _said(asked: Asked, combination: Mapping[str, Any]) -> str:
    """A combination in a few words."""
    return (
        ", ".join(f"{each.name} {combination[each.path]}" for each in asked.hypotheses)
        or "as in the case"
    )


def _numerical(key: str, results: Mapping[str, Any]) -> float:
    """Relative error that the analysis of a number reports, NaN where it reports none."""
    result = results.get(key.partition(":")[0])
    error = getattr(result, "largest_error", getattr(result, "error", None))
    known = np.asarray(error, dtype=float) if error is not None else np.empty(0)
    return float(np.nanmax(known)) if np.isfinite(known).any() else np.nan
