"""The range of every headline number and curve over what is uncertain of a case.

Every combination of hypotheses is solved as a machine of its own. Each tolerance is set to its two
ends, the others nominal, and ``quantiles`` sums the effects; two corners, where all tolerances are
off at once, check the sum. With ``samples``, machines are drawn at random instead.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Flags
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

Progress = Callable[[str], None]
RULES = 0.1  # share of the sum of squared effects above which a tolerance rules a number
BENT = 0.05  # deviation from a straight line, over the change from end to end, that is neglected


class Nominal(NamedTuple):
    """The nominal machine: ``values`` of the case's own results, ``base`` solved at the few speeds
    at which the other machines are solved.

    The columns of arrays here are its headline numbers, followed by the points of all its curves.
    """

    values: Values
    base: Values

    @property
    def value(self) -> Array:
        """Nominal value of every column in printed units; NaN for curves compared by logarithm."""
        numbers = np.array([each.value for each in self.values.numbers.values()], dtype=float)
        curves = self.values.curves.values()
        parts = [np.asarray(c.y, float) * (np.nan if c.by_ratio else 1.0) for c in curves]
        return np.concatenate([numbers, *parts])

    def of(self, machines: Sequence[Values]) -> Array:
        """Differences of machines from the nominal one (machines, columns), NaN where a number is
        missing."""
        rows = [np.concatenate([self._numbers(each), *self._curves(each)]) for each in machines]
        return np.array(rows).reshape(len(machines), len(self.value))

    def _numbers(self, machine: Values) -> list[float]:
        numbers, base = machine.numbers, self.base.numbers
        return [
            numbers[key].value - base[key].value if key in numbers and key in base else np.nan
            for key in self.values.numbers
        ]

    def _curves(self, machine: Values) -> Iterator[Array]:
        curves, base = machine.curves, self.base.curves
        for key, curve in self.values.curves.items():
            comparable = key in curves and key in base
            missing = np.full(len(curve.x), np.nan)
            yield difference(curve, curves[key], base[key]) if comparable else missing


def interval(
    case: Case, results: Mapping[str, Any], progress: Progress = lambda name: None
) -> Interval:
    """Range of the ``results`` of ``case`` over its uncertain parameters.

    Raises
    ------
    InvalidInput : the uncertainties contradict the case, or there are none
    NoSolution : the nominal machine has no solution
    """
    asked = asked_of(case)
    total = _count(asked, case.uncertain)
    progress(f"interval, {total} machines")
    machines = Machines(lean(case), total)
    combined = machines.all([*asked.combinations])  # the one of the case included
    nominal = Nominal(values_of(case, results), machines.values({}))
    toleranced = _toleranced(case, asked, machines, nominal)
    found = derivatives(asked, machines, nominal.values.numbers)
    return _joined(asked, nominal, combined, toleranced, found, machines, results)


def _count(asked: Asked, given: Uncertain | None) -> int:
    combinations = sum(1 for _ in asked.combinations)
    return combinations + 2 * len(asked.tolerances) + (given.samples or 0 if given else 0)


class Toleranced(NamedTuple):
    """Changes over the tolerances (columns, 2): ``usual`` holds 95 % of machines, ``worst`` all.

    ``effect`` (columns, sources, 2): changes at both ends of each tolerance alone; ``interaction``
    (columns,): see ``quantiles.Ranges``; ``without`` (columns,): number of machines that lack the
    number although the nominal machine has it."""

    usual: Array
    worst: Array
    effect: Array
    interaction: Array
    without: NDArray[np.int64]


def _toleranced(case: Case, asked: Asked, machines: Machines, nominal: Nominal) -> Toleranced:
    tolerances, value = asked.tolerances, nominal.value
    if not tolerances:
        zeros, count = np.zeros((len(value), 2)), len(value)
        nothing = np.zeros((count, 0, 2)), np.full(count, np.nan), np.zeros(count, dtype=int)
        return Toleranced(zeros, zeros, *nothing)
    effects = _effects(tolerances, machines, nominal)
    ends = np.stack([each.change[[0, -1]].T for each in effects], axis=1)
    corners = _corners(tolerances, ends, machines, nominal) if len(tolerances) > 1 else None
    summed = quantiles.ranges(value, effects, corners)
    usual, worst, together = summed.usual, summed.worst, summed.interaction
    solved = [each.change for each in effects] + ([corners.change] if corners else [])
    if case.uncertain is not None and case.uncertain.samples:
        changes = sampled(tolerances, case.uncertain.samples, case.uncertain.seed)
        random_machines = machines.all(changes)
        if all(each.sentence for each in random_machines):
            machines.lost.insert(
                0, f"all {len(random_machines)} machines drawn, so that tolerances have no ranges"
            )
        drawn = nominal.of(random_machines)
        usual, worst = _tails(drawn), _ends(drawn)
        together = np.full_like(together, np.nan)  # not needed where samples are drawn
        solved.append(drawn)
    usual, worst = (_within_solved(each, ends, np.concatenate(solved)) for each in (usual, worst))
    without = np.isnan(value + np.concatenate(solved)).sum(axis=0)
    without[~np.isfinite(value)] = 0  # an infinite number has no changes
    without[(value > 0.0) & (value + usual[:, 0] <= 0.0)] += 1  # such as a load that vanishes
    return Toleranced(usual, worst, ends, together, without)


def _within_solved(changes: Array, effect: Array, solved: Array) -> Array:
    """Limit extrapolated ranges of change (columns, 2) to the changes of machines ``solved``
    (machines, columns).

    Done where one end of a tolerance has no number (its ``effect`` is NaN), and for the end of the
    range to which the effect of its other end does not lead.
    """
    missing, other = np.isnan(effect), effect[..., ::-1]
    lost = [(missing & ~(other * sign > 0.0)).any(axis=(1, 2)) for sign in (-1.0, 1.0)]
    least, most = np.fmin.reduce(solved, axis=0), np.fmax.reduce(solved, axis=0)
    low = np.where(lost[0], np.fmax(changes[:, 0], least), changes[:, 0])
    high = np.where(lost[1], np.fmin(changes[:, 1], most), changes[:, 1])
    return np.stack([low, high], axis=1)


def _effects(
    given: Sequence[Tolerance], machines: Machines, nominal: Nominal
) -> list[quantiles.Effect]:
    """Effects of each tolerance alone, from machines at its ends, and at two values in between
    where it rules a number that is not linear in it."""
    machines.all([each.at(end) for each in given for end in (0.0, 1.0)])  # at once, and kept
    effects = [_along(each, (0.0, 1.0), machines, nominal) for each in given]
    numbers = len(nominal.values.numbers)
    ends = np.array([np.nan_to_num(each.change[[0, -1], :numbers]) for each in effects])
    share = (ends**2).max(axis=1)
    share = share / np.maximum(share.sum(axis=0), 1e-300)
    nominal_shares = [each.nominal for each in given]
    low, high = ends[:, 0], ends[:, 1]
    half = np.clip(nominal_shares, quantiles.EDGE, 1.0 - quantiles.EDGE)[:, None]
    deviation = np.abs(low * (1.0 - half) + high * half)  # of the chord, at the nominal value
    nonlinear = deviation > BENT * np.maximum(np.abs(high - low), 1e-300)
    refined = ((share > RULES) & nonlinear).any(axis=1)
    for k in np.flatnonzero(refined).tolist():
        if not given[k].levels:
            inner = (nominal_shares[k] / 2.0, (1.0 + nominal_shares[k]) / 2.0)
            effects[k] = _along(given[k], (0.0, *inner, 1.0), machines, nominal)
    return effects


def _along(
    given: Tolerance, shares: Sequence[float], machines: Machines, nominal: Nominal
) -> quantiles.Effect:
    """Effect of a tolerance from machines at ``shares`` of its range, and the nominal one."""
    all_shares = sorted({*shares, given.nominal})
    changes = [{} if share == given.nominal else given.at(share) for share in all_shares]
    change = nominal.of(machines.all(changes))
    return quantiles.Effect(np.array(all_shares), change, given.nominal, given.levels)


def _corners(
    given: Sequence[Tolerance], ends: Array, machines: Machines, nominal: Nominal
) -> quantiles.Corners:
    """Two machines with all tolerances off at once, in the direction common to most numbers."""
    ends = np.nan_to_num(ends[: len(nominal.values.numbers)])
    scale = np.abs(ends).max(axis=(1, 2), initial=0.0)
    scaled = ends / np.where(scale > 0.0, scale, 1.0)[:, None, None]
    middle = np.array([each.nominal for each in given])
    share = quantiles.corner_shares(scaled[..., 1] - scaled[..., 0], middle)
    changes = [_together(given, row.tolist()) for row in share]
    return quantiles.Corners(share, nominal.of(machines.all(changes)))


def _together(given: Sequence[Tolerance], shares: Sequence[float]) -> dict[str, Any]:
    """Values by path of a machine whose tolerances all stand at ``shares`` of their ranges."""
    pairs = zip(given, shares, strict=True)
    return {path: value for each, share in pairs for path, value in each.at(share).items()}


def sampled(given: Sequence[Tolerance], count: int, seed: int) -> list[dict[str, Any]]:
    """Values by path of machines drawn uniformly within tolerances (Latin hypercube)."""
    return [_together(given, row.tolist()) for row in latin_hypercube(count, len(given), seed)]


def _tails(drawn: Array) -> Array:
    """Percentiles (n, 2) that enclose 95 % of the drawn changes (machines, n)."""
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
    """Numbers (n, combinations): nominal value plus change, or a machine's own value where the
    nominal machine has none."""
    value = nominal.value[: moved.shape[1], None]
    keys, nan = [*nominal.values.numbers], np.nan
    values = [[m.numbers[k].value if k in m.numbers else nan for m in machines] for k in keys]
    return np.where(
        np.isnan(value), np.reshape(values, (len(keys), len(machines))), value + moved.T
    )


def _limits(values: Array) -> Array:
    """Lowest and highest value (n, 2), NaN ignored."""
    low, high = np.fmin.reduce(values, axis=1), np.fmax.reduce(values, axis=1)
    return np.stack([low, high], axis=1)


def _missing(values: Array) -> NDArray[np.int64]:
    """Number of NaN in each row (n,); 0 for rows of NaN alone."""
    missing = np.isnan(values)
    return np.where(missing.all(axis=1), 0, missing.sum(axis=1))


def _ends(changes: Array) -> Array:
    """Lowest and highest change (n, 2), with 0, that of the case itself, included."""
    return np.stack([_least(changes), -_least(-changes)], axis=1)


def _moved(y: Array, log: Flags, changes: Array) -> Array:
    """Points of curves plus ``changes``, which are of their logarithms where ``log``."""
    changes = np.nan_to_num(changes)
    with np.errstate(over="ignore", invalid="ignore"):
        return np.where(
            log[:, None],
            y[:, None] * np.exp(np.where(log[:, None], changes, 0.0)),
            y[:, None] + changes,
        )


def _said(asked: Asked, combination: Mapping[str, Any]) -> str:
    """Short text of a combination of hypotheses."""
    return (
        ", ".join(f"{each.name} {combination[each.path]}" for each in asked.hypotheses)
        or "as in the case"
    )


def _numerical(key: str, results: Mapping[str, Any]) -> float:
    """Relative error that the analysis of a number reports; NaN where it reports none, or an error
    with a unit."""
    result = results.get(key.partition(":")[0])
    error = getattr(result, "largest_error", getattr(result, "error", None))
    declaration = declared(result).get("error") if result is not None else None
    if declaration is not None and declaration.metadata["unit"] != "1":
        return np.nan
    errors = np.asarray(error, dtype=float) if error is not None else np.empty(0)
    return float(np.nanmax(errors)) if np.isfinite(errors).any() else np.nan
