"""Measurements explained by a machine: the best one, how sure it is, what else would do."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bearings.arguments import typed
from bearings.errors import BearingError
from rotordyn.case.case import Case
from rotordyn.case.identification import MINIMISED
from rotordyn.case.varied import found_at
from rotordyn.description import quantity_of
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.field import shown
from rotordyn.numerics.threads import processors
from rotordyn.study.identification.certainty import (
    BY_ITS_PRIOR,
    IDENTIFIED,
    ON_A_BOUND,
    UNIDENTIFIABLE,
    Certainty,
    apart,
    certainty,
)
from rotordyn.study.identification.criterion import Criterion
from rotordyn.study.identification.measurement import Beside, Measurement
from rotordyn.study.identification.models import Model, Phase, models
from rotordyn.study.identification.prediction import Predicted, Prediction, numbers, predictions
from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.search import Fit
from rotordyn.study.identification.started import Progress, Search, Searches, best_of, run
from rotordyn.study.identification.trial import Known
from rotordyn.study.identification.unknown import Unknown, sought
from rotordyn.study.parameter import is_whole

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
SURVIVES = 6.0  # difference of BIC up to which a model is kept
INSUFFICIENT = "insufficient"
UNDECIDED = "undecidable"


@dataclass(frozen=True, eq=False)
class Explained:
    """One model at its best: ``fit``, how ``sure`` its values are, searches from all starts."""

    model: Model
    problem: Problem
    fit: Fit
    sure: Certainty
    searches: tuple[Search, ...]

    @property
    def name(self) -> str:
        """Of the model."""
        return self.model.name

    @property
    def held(self) -> dict[str, Any]:
        """What the model holds by path, as files write it."""
        return {path: _written(self.problem.case, path) for path in self.model.holds}

    @property
    def information(self) -> float:
        """BIC: χ² of measurements and priors + unknowns · ln of observations (G. Schwarz, Ann.
        Statist. 6, 1978)."""
        return self.fit.cost + len(self.problem.unknowns) * float(np.log(self.problem.count))

    @property
    def left(self) -> list[Array]:
        """What it does not explain of every measurement [SI]."""
        pairs = zip(self.problem.weighings, self.fit.predicted, strict=True)
        return [each.left(one) for each, one in pairs]

    @property
    def case(self) -> Case:
        """The machine."""
        return self.problem.machine(self.fit.values)

    @cached_property
    def beside(self) -> list[Beside]:
        """What measurements say of the machine beside differences."""
        asked = [m for m in self.problem.measurements if hasattr(m, "beside")]
        if not asked:
            return []
        trial = self.problem.trial(self.fit.values)
        return [each.beside(trial) for each in asked]

    @property
    def on_bounds(self) -> list[str]:
        """Names of the unknowns that stand on a bound."""
        return [n for n, w in self.named if w == ON_A_BOUND]

    @property
    def named(self) -> list[tuple[str, str]]:
        """Every unknown with the word about it."""
        pairs = zip(self.problem.unknowns, self.sure.words, strict=True)
        return [(unknown.name, word) for unknown, word in pairs]


@dataclass(frozen=True, eq=False)
class Identification:
    """What measurements say of a case.

    ``models`` by evidence, the best first; ``predictions`` of the best; ``failed``: models without
    a machine, and why; ``stopped`` before the end.
    """

    name: str
    title: str
    models: tuple[Explained, ...]
    criterion: Criterion
    predictions: tuple[Prediction, ...] = ()
    failed: Mapping[str, str] = field(default_factory=dict)
    stopped: bool = False

    @property
    def order(self) -> list[Explained]:
        """Models in the order in which they were asked for."""
        return sorted(self.models, key=lambda each: each.searches[0].number)

    @property
    def explained(self) -> Explained:
        """The best model."""
        return self.models[0]

    @property
    def best(self) -> Case:
        """The identified machine."""
        return self.explained.case

    @property
    def values(self) -> dict[str, float]:
        """Its unknowns by path [SI]."""
        best = self.explained
        pairs = zip(best.problem.unknowns, best.fit.values.tolist(), strict=True)
        return {unknown.path: value for unknown, value in pairs}

    @property
    def intervals(self) -> dict[str, tuple[float, float]]:
        """Their 95 % intervals [SI]; of one on a bound both ends are that bound."""
        best = self.explained
        pairs = zip(best.problem.unknowns, best.sure.interval.tolist(), strict=True)
        return {unknown.path: (ends[0], ends[1]) for unknown, ends in pairs}

    @cached_property
    def evidence(self) -> list[float]:
        """How far the BIC of every model lies above the best, χ² counted by the best model's where
        that leaves more than the stated noise (K. Burnham and D. Anderson, 2002, 2.5)."""
        best = self.models[0]
        reduced = max(1.0, best.sure.reduced)
        penalty = np.log(best.problem.count)

        def scaled(model: Explained) -> float:
            return model.fit.cost / reduced + len(model.problem.unknowns) * float(penalty)

        return [scaled(each) - scaled(best) for each in self.models]

    @property
    def surviving(self) -> list[str]:
        """Names of the models that the measurements do not rule out."""
        pairs = zip(self.models, self.evidence, strict=True)
        return [each.name for each, above in pairs if above <= SURVIVES]

    @property
    def residual(self) -> float:
        """What the criterion bounds: the mean absolute difference, in its unit."""
        return self.criterion.residual(self.explained.problem, self.explained.left)

    @property
    def verdict(self) -> list[str]:
        """In sentences: does the model suffice, what is identified, what is not."""
        best, lines = self.explained, []
        why = self.criterion.excess(best.problem, best.left, best.sure)
        bound = best.on_bounds
        if bound:
            what = f"{', '.join(bound)} {'stands' if len(bound) == 1 else 'stand'} {ON_A_BOUND}"
            why.append(f"{what}: the model lacks a phenomenon, or the bound is too tight")
        head = f"{INSUFFICIENT}: " + "; ".join(why) if why else self.criterion.kept(self.residual)
        lines.append(head)
        lines += [remark for each in best.beside for remark in each.remarks]
        for word in (IDENTIFIED, BY_ITS_PRIOR, UNIDENTIFIABLE):
            names = [name for name, each in best.named if each == word]
            if names:
                lines.append(f"{word}: {', '.join(names)}")
        lines += apart(best.problem.unknowns, best.sure)
        others = self.surviving
        if len(others) > 1:
            lines.append(f"{UNDECIDED}: {len(others)} models explain it alike: {'; '.join(others)}")
        return lines

    @property
    def sufficient(self) -> bool:
        """Whether the best model explains the measurements with no value on a bound."""
        return not self.verdict[0].startswith(INSUFFICIENT)

    @property
    def summary(self) -> str:
        """The whole in one screen of plain text."""
        from rotordyn.study.identification.summary import summary

        return summary(self)

    def plot(self, name: str) -> Any:
        """A figure by its name; ``figures`` lists them."""
        from rotordyn.study.identification.figures import figures

        known = dict(figures(self))
        if name not in known:
            raise InvalidInput(f"no figure {shown(name)}; allowed: {', '.join(known)}")
        return known[name]()

    @property
    def figures(self) -> list[str]:
        """Names of its figures."""
        from rotordyn.study.identification.figures import figures

        return [name for name, _ in figures(self)]

    def dataset(self) -> xr.Dataset:
        """Values, intervals, correlation, residuals, evidence and predictions."""
        from rotordyn.study.identification.dataset import dataset

        return dataset(self)

    def save(self, folder: str | Path, *, draw: bool = True) -> None:
        """Write summary, dataset, tables, figures and the identified machine into a folder."""
        from rotordyn.study.identification.deliver import write

        write(self, Path(folder), draw=draw)


@dataclass(frozen=True, eq=False)
class Asked:
    """An identification held against its case, before anything is solved."""

    case: Case
    searches: Searches
    criterion: Criterion
    predict: tuple[Predicted, ...]


def asked(  # noqa: PLR0913 - see identify
    case: Case,
    unknowns: Mapping[str, Unknown],
    measurements: Sequence[Measurement],
    *,
    hypotheses: Mapping[str, Sequence[Any]] | None = None,
    phases: Mapping[str, Phase] | None = None,
    predict: Sequence[Predicted] = (),
    criterion: str | None = None,
    minimise: str = "squares",
    starts: int = 1,
    seed: int = 0,
) -> Asked:
    """An identification held against its case; see ``identify``."""
    if not isinstance(case, Case):
        raise InvalidInput(f"a case is needed, as rotordyn.load gives it; got {shown(case)}")
    case = replace(case, variants={}, uncertain=None)
    _require_measurements(case, measurements)
    found = sought(case, unknowns)
    if minimise not in MINIMISED:
        raise InvalidInput(f"minimise: given {shown(minimise)}; allowed: {', '.join(MINIMISED)}")
    if not is_whole(starts, 1, 1000):
        raise InvalidInput(f"starts: given {shown(starts)}; allowed: a whole number up to 1000")
    if not is_whole(seed, 0):
        raise InvalidInput(f"seed: given {shown(seed)}; allowed: a whole number from 0 up")
    every = models(case, found, hypotheses or {}, phases or {})
    _require_points(every, measurements)
    searches = Searches(every, tuple(measurements), starts, seed, minimise == MINIMISED[1])
    held = Criterion.of(criterion, searches.measurements)
    if predict:
        first = searches.problem(0)
        with suppress(NoSolution, BearingError):
            numbers(first, first.start, tuple(predict), Known())  # refuses what is no number
    return Asked(case, searches, held, tuple(predict))


def _require_measurements(case: Case, measurements: Sequence[Measurement]) -> None:
    if not len(measurements):
        raise InvalidInput("nothing was measured: give at least one measurement")
    names = [each.data.name for each in measurements]
    for each in measurements:
        data = each.data
        if names.count(data.name) > 1:
            raise InvalidInput(f"two measurements are called {data.name}: name them apart")
        for fault in each.faults(case):
            raise InvalidInput(fault)
        if data.swamped:
            size = float(np.ptp(data.observed)) * data.factor
            noise = float(data.deviation.min()) * data.factor
            raise InvalidInput(
                f"measurement {data.name}: noise swamps it: its points differ by {size:.3g} "
                f"{data.unit}, their deviation is {noise:.3g} {data.unit}"
            )


def _require_points(every: Sequence[Model], measurements: Sequence[Measurement]) -> None:
    count = sum(getattr(each, "carried", len(each.data.observed)) for each in measurements)
    for model in every:
        priors = sum(each.deviation is not None for each in model.unknowns)
        if len(model.unknowns) > count + priors:
            raise InvalidInput(
                f"{len(model.unknowns)} unknowns, but the measurements have {count} points and "
                f"there are {priors} priors: fewer unknowns, or more points"
            )


@typed(InvalidInput, besides=["case", "measurements"])
def identify(  # noqa: PLR0913 - all of it describes one identification
    case: Case,
    unknowns: Mapping[str, Unknown],
    measurements: Sequence[Any],
    *,
    hypotheses: Mapping[str, Sequence[Any]] | None = None,
    phases: Mapping[str, Phase] | None = None,
    predict: Sequence[Predicted] = (),
    criterion: str | None = None,
    minimise: str = "squares",
    starts: int = 1,
    seed: int = 0,
    workers: int | None = None,
    folder: str | Path | None = None,
    progress: Progress = lambda done, of: None,
) -> Identification:
    """Values of a case with which it shows what was measured, and how sure they are.

    Parameters
    ----------
    unknowns : dotted paths, as ``rotordyn.vary`` takes them, to ``Unknown``
    measurements : such as ``AxialCurve``; see ``rotordyn.study.identification.measurement``
    hypotheses : dotted paths to lists of values, every combination of which is held against the
        measurements
    phases : names to ``Phase``, models that seek other unknowns, side by side
    predict : numbers of the case that are said of the identified machine, with their intervals
    criterion : mean absolute difference up to which a model suffices, with its unit, such as
        "1 um"; without it χ² decides
    minimise : "squares" of differences over noise, or their "absolute" mean
    starts : of each search, the first the stated one, others the best of some drawn at random
    seed : of these
    workers : processes; as many as there are processors by default
    folder : where searches are kept as they end; the same study goes on from there
    progress : called with the number of searches ended and of all

    Returns
    -------
    Identification : of the best so far where it is interrupted

    Raises
    ------
    InvalidInput : a path, value or measurement that cannot be, before anything is solved; a folder
        of another study
    NoSolution : no model has a machine with a solution
    """
    held = asked(
        case,
        unknowns,
        measurements,
        hypotheses=hypotheses,
        phases=phases,
        predict=predict,
        criterion=criterion,
        minimise=minimise,
        starts=starts,
        seed=seed,
    )
    return identified(held, workers, None if folder is None else Path(folder), progress)


def identified(
    held: Asked,
    workers: int | None = None,
    folder: Path | None = None,
    progress: Progress = lambda done, of: None,
) -> Identification:
    """What measurements say; see ``identify``."""
    if workers is not None and not is_whole(workers, 1):
        raise InvalidInput(f"workers: given {shown(workers)}; allowed: a whole number from 1 up")
    searches = held.searches
    found, stopped = run(searches, workers or processors(), folder, progress)
    explained: list[Explained] = []
    failed: dict[str, str] = {}
    for k, model in enumerate(searches.models):
        best = best_of(found, k)
        if best is None:
            tried = [each.sentence for each in found if each.number[0] == k]
            failed[model.name] = tried[0] if tried else "not searched yet"
            continue
        mine = tuple(each for each in found if each.number[0] == k)
        explained.append(_explained(model, searches.problem(k), best, mine))
    if not explained:
        if stopped:
            raise KeyboardInterrupt
        raise NoSolution("; ".join(dict.fromkeys(failed.values())))
    explained.sort(key=lambda each: each.information)
    shown_of = predictions(explained[0].problem, explained[0].sure, held.predict)
    return Identification(
        held.case.name,
        held.case.title,
        tuple(explained),
        held.criterion,
        shown_of,
        failed,
        stopped,
    )


def _written(case: Case, path: str) -> Any:
    value, annotation = found_at(case, path)[0]
    quantity = quantity_of(annotation)
    if quantity is None or isinstance(value, str | bool):
        return value
    return quantity.infinite if np.isinf(value) else f"{value!r} {quantity.coherent_unit}".strip()


def _explained(
    model: Model, problem: Problem, best: Search, searches: tuple[Search, ...]
) -> Explained:
    values = np.array(best.values)
    predicted = problem.predicted(values)
    assert predicted is not None, "the search solved it"
    fit = Fit(values, best.cost, predicted, best.ended)
    return Explained(model, problem, fit, certainty(problem, fit), searches)
