"""What the identified machine would show: headline numbers of its case, with their intervals.

By the delta method: the derivatives of a number by the unknowns, and the covariance of these. An
unknown on a bound is not in that: a number that would change over all that was known of it before
by more than a small share of its interval has none.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from bearings.errors import BearingError
from rotordyn.analyses.registry import analysis
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.field import shown
from rotordyn.study.identification.certainty import ON_A_BOUND, Certainty
from rotordyn.study.identification.problem import STEP, Problem
from rotordyn.study.identification.trial import Known
from rotordyn.study.identification.unknown import FLAT
from rotordyn.study.optimum.criterion import Criterion, amount

Array = NDArray[np.float64]
FOLLOWS = 0.05  # of half an interval: a change below it is left out
ROUNDING = 1e-6  # of a number: a change below it is none


@dataclass(frozen=True, slots=True)
class Predicted:
    """What is predicted: ``of`` and ``where`` as of ``Criterion``; ``name`` in tables; a
    ``measured`` value to show beside it, as printed."""

    of: str
    where: Mapping[str, object] = field(default_factory=dict)
    name: str = ""
    measured: float | str | None = None


@dataclass(frozen=True, slots=True)
class Prediction:
    """A number of the identified machine as printed, its 95 % interval, what was measured; NaN
    where it has no such number.

    ``low`` and ``high`` are NaN of a number that follows unknowns on a ``bound``, these by name.
    ``least`` and ``most`` of the numbers of all surviving models at their best, where there are
    several; ``lacking``: those of them that have no such number.
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
    """The case with the analyses that predictions need, and no other.

    Raises
    ------
    InvalidInput : an analysis that the case lacks
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
    """Of the machine with such values: unit, number and what was measured, by name (those that
    share one are counted).

    Raises
    ------
    InvalidInput, NoSolution, BearingError : the machine has none
    """
    case = asked_of(problem.machine(values), wanted)
    results = known.neighbours.solve(case)[0].results
    found: dict[str, tuple[str, float, float | None]] = {}
    for each in wanted:
        reading = Criterion(each.of, each.where).read(case, results)
        for k, value in enumerate(reading.values.tolist()):
            words = each.name or reading.names[k]
            words = words if words not in found else f"{words} ({k + 1})"
            found[words] = reading.unit, value, _known(each, reading.unit)
        if reading.absent or not reading.values.size:
            more = f", {reading.absent} more" if reading.values.size else ""
            words = f"{each.name or Criterion(each.of, each.where).words}{more}"
            found[words] = reading.unit, np.nan, _known(each, reading.unit)
    return found


def _known(of: Predicted, unit: str) -> float | None:
    try:
        return None if of.measured is None else amount(of.measured, unit)
    except InvalidInput as refusal:
        raise InvalidInput(f"{shown(of.of)}: measured: {refusal}") from None


def predictions(
    problem: Problem, sure: Certainty, wanted: tuple[Predicted, ...]
) -> tuple[Prediction, ...]:
    """Numbers of the identified machine with their intervals."""
    if not wanted:
        return ()
    known = Known()
    best = numbers(problem, sure.values, wanted, known)
    slopes = {name: np.zeros(len(sure.values)) for name in best}
    for k in range(len(sure.values)):
        for name, slope in _slopes(problem, sure.values, k, wanted, known, best).items():
            slopes[name][k] = slope
    found = []
    for name, (unit, value, measured) in best.items():
        if np.isnan(value):
            found.append(Prediction(name, unit, value, value, value, measured))
            continue
        half = sure.quantile * float(np.sqrt(slopes[name] @ sure.covariance @ slopes[name]))
        least = max(FOLLOWS * half, ROUNDING * abs(value))
        changes = FLAT * np.abs(slopes[name])  # over the whole range known before
        triples = zip(problem.unknowns, sure.words, changes, strict=True)
        bound = tuple(u.name for u, w, change in triples if w == ON_A_BOUND and change > least)
        half = np.nan if bound else half
        found.append(
            Prediction(name, unit, value, value - half, value + half, measured, bound=bound)
        )
    return tuple(found)


def over_models(
    nominal: Sequence[Prediction],
    others: Sequence[tuple[str, Problem, Array]],
    wanted: tuple[Predicted, ...],
) -> tuple[Prediction, ...]:
    """Predictions with the range over the best model and the ``others`` that survive, each a name,
    problem and values."""
    if not nominal or not others:
        return tuple(nominal)
    found: dict[str, dict[str, tuple[str, float, float | None]]] = {}
    for name, problem, values in others:
        try:
            found[name] = numbers(problem, values, wanted, Known())
        except (InvalidInput, NoSolution, BearingError):
            found[name] = {}
    ranged = []
    for each in nominal:
        known = {model: of[each.name][1] for model, of in found.items() if each.name in of}
        has = {model: value for model, value in known.items() if not np.isnan(value)}
        every = [value for value in (each.value, *has.values()) if not np.isnan(value)] or [np.nan]
        lacking = tuple(model for model in found if model not in has)
        ranged.append(replace(each, least=min(every), most=max(every), lacking=lacking))
    return tuple(ranged)


def _slopes(
    problem: Problem,
    values: Array,
    k: int,
    wanted: tuple[Predicted, ...],
    known: Known,
    best: Mapping[str, tuple[str, float, float | None]],
) -> dict[str, float]:
    """Derivatives by one unknown over its scale, on both sides where both have a solution."""
    low, high = (float(end[k]) for end in problem.bounds)
    scale, found = float(problem.scale[k]), []
    for side in (-1.0, 1.0):
        moved = values.copy()
        moved[k] = min(max(values[k] + side * STEP * scale, low), high)
        if moved[k] == values[k]:
            continue
        try:
            there = numbers(problem, moved, wanted, known)
        except (InvalidInput, NoSolution, BearingError):
            continue
        found.append(((moved[k] - values[k]) / scale, there))
    if not found:
        return {}
    ends = [(0.0, best), *found] if len(found) == 1 else found
    (a, first), (b, last) = ends
    return {
        name: (last[name][1] - first[name][1]) / (b - a)
        for name in best
        if name in first and name in last and not np.isnan(last[name][1] - first[name][1])
    }
