"""The range of every headline number and curve over what is uncertain of a case.

Hypotheses are combined, each combination solved as a machine of its own. Of tolerances each goes to
its two ends alone, and ``quantiles`` joins the effects; two corners, where all go to their ends
together, tell how far their sum holds. With ``samples`` machines are drawn at random instead.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.case.asked import Asked, asked_of
from rotordyn.case.case import Case
from rotordyn.case.tolerance import Tolerance
from rotordyn.case.uncertain import Uncertain
from rotordyn.job.values import Values, difference, values_of
from rotordyn.results.declaration import declared
from rotordyn.results.interval import ENDS, Interval
from rotordyn.study import quantiles
from rotordyn.study.latin_hypercube import latin_hypercube
from rotordyn.study.machines import Machines, lean
from rotordyn.study.sensitivity import Derivatives, derivatives

Array = NDArray[np.float64]
Progress = Callable[[str], None]
RULES = 0.1  # share of the range from which a tolerance rules a number
BENT = 0.05  # of the change from end to end: how far from a straight line it is not seen


class Nominal(NamedTuple):
    """The machine of the case as solved for its results, and at the few speeds of the others.

    Its headline numbers, then the points of all its curves, are the columns of what follows.
    """

    values: Values
    base: Values

    @property
    def value(self) -> Array:
        """Every column in printed units; NaN of curves that differ by logarithms."""
        numbers = np.array([each.value for each in self.values.numbers.values()], dtype=float)
        curves = self.values.curves.values()
        parts = [np.asarray(c.y, float) * (np.nan if c.by_ratio else 1.0) for c in curves]
        return np.concatenate([numbers, *parts])

    def of(self, machines: Sequence[Values]) -> Array:
        """How far machines lie from it (machines, columns); NaN where they have no such number."""
        rows = [np.concatenate([self._numbers(each), *self._curves(each)]) for each in machines]
        return np.array(rows).reshape(len(machines), len(self.value))

    def _numbers(self, machine: Values) -> list[float]:
        known, base = machine.numbers, self.base.numbers
        return [
            known[key].value - base[key].value if key in known and key in base else np.nan
            for key in self.values.numbers
        ]

    def _curves(self, machine: Values) -> Iterator[Array]:
        known, base = machine.curves, self.base.curves
        for key, curve in self.values.curves.items():
            there = key in known and key in base
            none = np.full(len(curve.x), np.nan)
            yield difference(curve, known[key], base[key]) if there else none


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
    total = _count(asked, case.uncertain)
    progress(f"interval, {total} machines")
    machines = Machines(lean(case), total)
    combined = machines.all([*asked.combinations])  # that of the case among them
    nominal = Nominal(values_of(case, results), machines.values({}))
    toleranced = _toleranced(case, asked, machines, nominal)
    found = derivatives(asked, machines, nominal.values.numbers)
    return _joined(asked, nominal, combined, toleranced, found, machines, results)


def _count(asked: Asked, given: Uncertain | None) -> int:
    combinations = sum(1 for _ in asked.combinations)
    return combinations + 2 * len(asked.tolerances) + (given.samples or 0 if given else 0)


class Toleranced(NamedTuple):
    """Changes over tolerances (columns, 2): ``usual`` of 95 % of machines, ``worst`` of all;
    ``effect`` (columns, sources, 2) of each alone; ``interaction`` (columns,); ``without``: how
    many machines have no such number, which that of the case has."""

    usual: Array
    worst: Array
    effect: Array
    interaction: Array
    without: NDArray[np.int64]


def _toleranced(case: Case, asked: Asked, machines: Machines, nominal: Nominal) -> Toleranced:
    given, value = asked.tolerances, nominal.value
    if not given:
        none, count = np.zeros((len(value), 2)), len(value)
        nothing = np.zeros((count, 0, 2)), np.full(count, np.nan), np.zeros(count, dtype=int)
        return Toleranced(none, none, *nothing)
    effects = _effects(given, machines, nominal)
    ends = np.stack([each.change[[0, -1]].T for each in effects], axis=1)
    corners = _corners(given, ends, machines, nominal) if len(given) > 1 else None
    found = quantiles.ranges(value, effects, corners)
    usual, worst, together = found.usual, found.worst, found.interaction
    solved = [each.change for each in effects] + ([corners.change] if corners else [])
    if case.uncertain is not None and case.uncertain.samples:
        changes = sampled(given, case.uncertain.samples, case.uncertain.seed)
        others = machines.all(changes)
        if all(each.sentence for each in others):
            machines.lost.insert(
                0, f"all {len(others)} machines drawn, so that tolerances have no ranges"
            )
        drawn = nominal.of(others)
        usual, worst = _tails(drawn), _ends(drawn)
        together = np.full_like(together, np.nan)  # not needed where samples are drawn
        solved.append(drawn)
    usual, worst = (_within_solved(each, ends, np.concatenate(solved)) for each in (usual, worst))
    without = np.isnan(value + np.concatenate(solved)).sum(axis=0)
    without[~np.isfinite(value)] = 0  # where it has no limit, changes are of nothing
    without[(value > 0.0) & (value + usual[:, 0] <= 0.0)] += 1  # a load lost
    return Toleranced(usual, worst, ends, together, without)


def _within_solved(found: Array, effect: Array, solved: Array) -> Array:
    """Changes ``found`` (columns, 2), of which an end beyond that of all machines ``solved``
    (machines, columns) is theirs where some tolerance has an ``effect`` without a number.

    It counts for the end to which its other effect does not lead.
    """
    none, other = np.isnan(effect), effect[..., ::-1]
    lost = [(none & ~(other * way > 0.0)).any(axis=(1, 2)) for way in (-1.0, 1.0)]
    least, most = np.fmin.reduce(solved, axis=0), np.fmax.reduce(solved, axis=0)
    low = np.where(lost[0], np.fmax(found[:, 0], least), found[:, 0])
    high = np.where(lost[1], np.fmin(found[:, 1], most), found[:, 1])
    return np.stack([low, high], axis=1)


def _effects(
    given: Sequence[Tolerance], machines: Machines, nominal: Nominal
) -> list[quantiles.Effect]:
    """Of each tolerance alone, from machines at its ends; from two more in between where it rules a
    number and bends it."""
    machines.all([each.at(end) for each in given for end in (0.0, 1.0)])  # at once, and kept
    effects = [_along(each, (0.0, 1.0), machines, nominal) for each in given]
    numbers = len(nominal.values.numbers)
    ends = np.array([np.nan_to_num(each.change[[0, -1], :numbers]) for each in effects])
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
            effects[k] = _along(given[k], (0.0, *inner, 1.0), machines, nominal)
    return effects


def _along(
    given: Tolerance, shares: Sequence[float], machines: Machines, nominal: Nominal
) -> quantiles.Effect:
    """From machines at some shares of the way, and the nominal one."""
    every = sorted({*shares, given.nominal})
    changes = [{} if share == given.nominal else given.at(share) for share in every]
    change = nominal.of(machines.all(changes))
    return quantiles.Effect(np.array(every), change, given.nominal, given.levels)


def _corners(
    given: Sequence[Tolerance], ends: Array, machines: Machines, nominal: Nominal
) -> quantiles.Corners:
    """Two machines of which all tolerances are off at once, the way most numbers go together."""
    ends = np.nan_to_num(ends[: len(nominal.values.numbers)])
    scale = np.abs(ends).max(axis=(1, 2), initial=0.0)
    scaled = ends / np.where(scale > 0.0, scale, 1.0)[:, None, None]
    middle = np.array([each.nominal for each in given])
    share = quantiles.corner_shares(scaled[..., 1] - scaled[..., 0], middle)
    changes = [_together(given, row.tolist()) for row in share]
    return quantiles.Corners(share, nominal.of(machines.all(changes)))


def _together(given: Sequence[Tolerance], shares: Sequence[float]) -> dict[str, Any]:
    """Values by path of a machine that is off by shares of all tolerances."""
    pairs = zip(given, shares, strict=True)
    return {path: value for each, share in pairs for path, value in each.at(share).items()}


def sampled(given: Sequence[Tolerance], count: int, seed: int) -> list[dict[str, Any]]:
    """Machines drawn within tolerances, each evenly (Latin hypercube): values by path."""
    return [_together(given, row.tolist()) for row in latin_hypercube(count, len(given), seed)]


def _tails(drawn: Array) -> Array:
    """Ends of what 95 of 100 machines (machines, n) have, (n, 2)."""
    known = np.isfinite(drawn).any(axis=0)
    ends = np.zeros((drawn.shape[1], 2))
    half = quantiles.COVERED / 2.0
    if known.any():
        ends[known] = np.nanpercentile(drawn[:, known], (50.0 - half, 50.0 + half), axis=0).T
    return ends


def _least(values: Array) -> Array:
    return np.nanmin(np.vstack([values, np.zeros(values.shape[1])]), axis=0)


def _joined(
    asked: Asked,
    nominal: Nominal,
    combined: Sequence[Values],
    toleranced: Toleranced,
    found: Derivatives,
    machines: Machines,
    results: Mapping[str, Any],
) -> Interval:
    numbers, curves = nominal.values.numbers, nominal.values.curves
    count = len(numbers)
    value, points = nominal.value[:count], slice(count, None)
    length = [len(curve.x) for curve in curves.values()]
    y = np.concatenate([np.asarray(c.y, float) for c in curves.values()]) if curves else np.empty(0)
    log = np.repeat([curve.by_ratio for curve in curves.values()], length).astype(bool)
    moved = nominal.of(combined)
    by_combination = _each(nominal, combined, moved[:, :count])
    return Interval(
        number=tuple(numbers),
        source=tuple(each.path for each in asked.tolerances),
        end=ENDS,
        combination=tuple(_said(asked, each) for each in asked.combinations),
        path=asked.paths,
        curve=tuple(curves),
        unit=tuple(each.unit for each in numbers.values()),
        absent=tuple(machines.absent(key) for key in numbers),
        nominal=value,
        by_combination=by_combination,
        hypotheses=_limits(np.column_stack([value, by_combination])),
        tolerances=value[:, None] + toleranced.usual[:count],
        worst=value[:, None] + toleranced.worst[:count],
        effect=toleranced.effect[:count],
        interaction=toleranced.interaction[:count],
        without=_missing(by_combination),
        without_within=toleranced.without[:count],
        numerical_error=np.array([_numerical(key, results) for key in numbers]),
        tolerance=tuple(each.text for each in asked.tolerances),
        derivative=found.derivative,
        elasticity=found.elasticity,
        range_effect=found.over_range,
        curve_of=np.repeat(np.arange(len(curves)), length),
        x=np.concatenate([np.asarray(c.x, float) for c in curves.values()]) if curves else y,
        curve_nominal=y,
        curve_hypotheses=_moved(y, log, _ends(moved[:, points])),
        curve_tolerances=_moved(y, log, toleranced.usual[points]),
        runs=machines.solved,
        narrowed="; ".join(asked.narrowed),
        lost="; ".join(dict.fromkeys(machines.lost)),
    )


def _each(nominal: Nominal, machines: Sequence[Values], moved: Array) -> Array:
    """Numbers by combination; as they are where the machine of the case has none."""
    value = nominal.value[: moved.shape[1], None]
    keys, none = [*nominal.values.numbers], np.nan
    own = [[m.numbers[k].value if k in m.numbers else none for m in machines] for k in keys]
    return np.where(np.isnan(value), np.reshape(own, (len(keys), len(machines))), value + moved.T)


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
    """Points of curves moved by changes, of their logarithms where ``log``."""
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
    """Relative error that the analysis of a number reports, NaN where it reports none, or one of
    something else in a unit of its own."""
    result = results.get(key.partition(":")[0])
    error = getattr(result, "largest_error", getattr(result, "error", None))
    own = declared(result).get("error") if result is not None else None
    if own is not None and own.metadata["unit"] != "1":
        return np.nan
    known = np.asarray(error, dtype=float) if error is not None else np.empty(0)
    return float(np.nanmax(known)) if np.isfinite(known).any() else np.nan
