"""Predictions: headline numbers of the identified machine, with their intervals.

Intervals follow by the delta method, from the derivatives of a number with respect to the unknowns
and their covariance. That excludes unknowns on a bound: a number that depends on one of these, by
more than a small share of its interval, has no interval.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from bearings.errors import BearingError
from rotordyn.analyses.registry import analysis
from rotordyn.arrays import Array
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.field import shown
from rotordyn.study.identification.certainty import ON_A_BOUND, Certainty
from rotordyn.study.identification.problem import STEP, Problem
from rotordyn.study.identification.trial import Known
from rotordyn.study.identification.unknown import FLAT
from rotordyn.study.optimum.criterion import Criterion, amount

FOLLOWS = 0.05  # effect of an unknown on a bound, over half the interval, that is neglected
ROUNDING = 1e-6  # relative change of a number that is neglected


@dataclass(frozen=True, slots=True)
class Predicted:
    """A number to predict: ``of`` and ``where`` as in ``Criterion``; ``name`` in tables; a
    ``measured`` value for comparison, as printed."""

    of: str
    where: Mapping[str, object] = field(default_factory=dict)
    name: str = ""
    measured: float | str | None = None


@dataclass(frozen=True, slots=True)
class Prediction:
    """A predicted number as printed, its 95 % interval, and the measured value; NaN if the
    identified machine lacks the number.

    ``low`` and ``high`` are NaN if the number depends on unknowns on a ``bound``, listed by name.
    ``least`` and ``most``: range over the surviving models, if there are several; ``lacking``:
    names of those without the number.
    """

    name: str
    unit: str
    value: float
    low: float
    high: float
    measured: float | None
    least: float | None = None
    most: float | None = None
    lacking: tuple[str, ...] = ()
    bound: tuple[str, ...] = ()


def asked_of(case: Case, wanted: tuple[Predicted, ...]) -> Case:
    """Reduce the case to the analyses that predictions need.

    Raises
    ------
    InvalidInput : the case lacks an analysis
    """
    names = [Criterion(each.of).analysis for each in wanted]
    for each, name in zip(wanted, names, strict=True):
        if name not in case.analyses:
            raise InvalidInput(
                f"{shown(each.of)}: begins with an analysis of the case; allowed: "
                f"{', '.join(case.analyses)}"
            )
    specs = {name: analysis(name).lean(case.analyses[name]) for name in dict.fromkeys(names)}
    return replace(case, analyses=specs)


def numbers(
    problem: Problem, values: Array, wanted: tuple[Predicted, ...], known: Known
) -> dict[str, tuple[str, float, float | None]]:
    """Solve the machine with ``values``: unit, number and measured value by name (repeated names
    are numbered).

    Raises
    ------
    InvalidInput, NoSolution, BearingError : the machine has no solution
    """
    case = asked_of(problem.machine(values), wanted)
    results = known.neighbours.solve(case)[0].results
    predicted: dict[str, tuple[str, float, float | None]] = {}
    for each in wanted:
        reading = Criterion(each.of, each.where).read(case, results)
        for k, value in enumerate(reading.values.tolist()):
            words = each.name or reading.names[k]
            words = words if words not in predicted else f"{words} ({k + 1})"
            predicted[words] = reading.unit, value, _known(each, reading.unit)
        if reading.absent or not reading.values.size:
            more = f", {reading.absent} more" if reading.values.size else ""
            words = f"{each.name or Criterion(each.of, each.where).words}{more}"
            predicted[words] = reading.unit, np.nan, _known(each, reading.unit)
    return predicted


def _known(of: Predicted, unit: str) -> float | None:
    try:
        return None if of.measured is None else amount(of.measured, unit)
    except InvalidInput as refusal:
        raise InvalidInput(f"{shown(of.of)}: measured: {refusal}") from None


def predictions(
    problem: Problem, sure: Certainty, wanted: tuple[Predicted, ...]
) -> tuple[Prediction, ...]:
    """Predict numbers of the identified machine with their intervals."""
    if not wanted:
        return ()
    known = Known()
    best = numbers(problem, sure.values, wanted, known)
    slopes = {name: np.zeros(len(sure.values)) for name in best}
    for k in range(len(sure.values)):
        for name, slope in _slopes(problem, sure.values, k, wanted, known, best).items():
            slopes[name][k] = slope
    result = []
    for name, (unit, value, measured) in best.items():
        if np.isnan(value):
            result.append(Prediction(name, unit, value, value, value, measured))
            continue
        half = sure.quantile * float(np.sqrt(slopes[name] @ sure.covariance @ slopes[name]))
        neglected = max(FOLLOWS * half, ROUNDING * abs(value))
        changes = FLAT * np.abs(slopes[name])  # over the whole range of each unknown
        triples = zip(problem.unknowns, sure.words, changes, strict=True)
        bound = tuple(u.name for u, w, change in triples if w == ON_A_BOUND and change > neglected)
        half = np.nan if bound else half
        result.append(
            Prediction(name, unit, value, value - half, value + half, measured, bound=bound)
        )
    return tuple(result)


def over_models(
    nominal: Sequence[Prediction],
    others: Sequence[tuple[str, Problem, Array]],
    wanted: tuple[Predicted, ...],
) -> tuple[Prediction, ...]:
    """Add the range over the surviving models to predictions; ``others``: name, problem and values
    of those beside the best."""
    if not nominal or not others:
        return tuple(nominal)
    by_model: dict[str, dict[str, tuple[str, float, float | None]]] = {}
    for name, problem, values in others:
        try:
            by_model[name] = numbers(problem, values, wanted, Known())
        except (InvalidInput, NoSolution, BearingError):
            by_model[name] = {}
    ranged = []
    for each in nominal:
        predicted = {model: of[each.name][1] for model, of in by_model.items() if each.name in of}
        present = {model: value for model, value in predicted.items() if not np.isnan(value)}
        all_values = [
            value for value in (each.value, *present.values()) if not np.isnan(value)
        ] or [np.nan]
        lacking = tuple(model for model in by_model if model not in present)
        ranged.append(replace(each, least=min(all_values), most=max(all_values), lacking=lacking))
    return tuple(ranged)


def _slopes(
    problem: Problem,
    values: Array,
    k: int,
    wanted: tuple[Predicted, ...],
    known: Known,
    best: Mapping[str, tuple[str, float, float | None]],
) -> dict[str, float]:
    """Derivatives of the numbers by unknown ``k`` over its scale; central differences if both sides
    have a solution."""
    low, high = (float(end[k]) for end in problem.bounds)
    scale, steps = float(problem.scale[k]), []
    for side in (-1.0, 1.0):
        moved = values.copy()
        moved[k] = min(max(values[k] + side * STEP * scale, low), high)
        if moved[k] == values[k]:
            continue
        try:
            predicted = numbers(problem, moved, wanted, known)
        except (InvalidInput, NoSolution, BearingError):
            continue
        steps.append(((moved[k] - values[k]) / scale, predicted))
    if not steps:
        return {}
    ends = [(0.0, best), *steps] if len(steps) == 1 else steps
    (a, first), (b, last) = ends
    return {
        name: (last[name][1] - first[name][1]) / (b - a)
        for name in best
        if name in first and name in last and not np.isnan(last[name][1] - first[name][1])
    }
