"""Identify a case: check the request, run the searches, evaluate the models."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from bearings.arguments import typed
from bearings.errors import BearingError
from rotordyn.case.case import Case
from rotordyn.case.identification import MINIMISED
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.field import shown
from rotordyn.numerics.threads import processors
from rotordyn.study.design import one_machine
from rotordyn.study.identification.certainty import certainty
from rotordyn.study.identification.criterion import FitCriterion
from rotordyn.study.identification.identification import Explained, Identification
from rotordyn.study.identification.measurement import Measurement
from rotordyn.study.identification.models import Model, Phase, models
from rotordyn.study.identification.numbers import Numbers
from rotordyn.study.identification.prediction import Predicted, numbers, over_models, predictions
from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.profile import asked_profiles
from rotordyn.study.identification.profile import profiles as profiles_of
from rotordyn.study.identification.search import Fit
from rotordyn.study.identification.searches import Progress, Search, Searches, best_of, run
from rotordyn.study.identification.trial import Known
from rotordyn.study.identification.unknown import Unknown, sought
from rotordyn.study.parameter import is_whole


@dataclass(frozen=True, eq=False)
class Asked:
    """A request that was checked against its case, before anything is solved; ``left_out``:
    variants of the case, ignored."""

    case: Case
    searches: Searches
    criterion: FitCriterion
    predict: tuple[Predicted, ...]
    profiles: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()


def asked(  # noqa: PLR0913 - see identify
    case: Case,
    unknowns: Mapping[str, Unknown],
    measurements: Sequence[Measurement],
    *,
    hypotheses: Mapping[str, Sequence[Any]] | None = None,
    phases: Mapping[str, Phase] | None = None,
    predict: Sequence[Predicted] = (),
    profiles: str | Sequence[str] = (),
    criterion: str | None = None,
    minimise: str = "squares",
    starts: int = 1,
    seed: int = 0,
) -> Asked:
    """Check a request against its case; see ``identify``."""
    if not isinstance(case, Case):
        raise InvalidInput(f"a case is needed, as rotordyn.load gives it; got {shown(case)}")
    left_out, case = tuple(case.variants), one_machine(case, unknowns)
    _require_measurements(case, measurements)
    found = sought(case, unknowns)
    if minimise not in MINIMISED:
        raise InvalidInput(f"minimise: given {shown(minimise)}; allowed: {', '.join(MINIMISED)}")
    profiled = asked_profiles(found, profiles)
    if profiled and minimise == MINIMISED[1]:
        raise InvalidInput(f"profiles: need minimise: {MINIMISED[0]}; given minimise: {minimise}")
    if not is_whole(starts, 1, 1000):
        raise InvalidInput(f"starts: given {shown(starts)}; allowed: a whole number up to 1000")
    if not is_whole(seed, 0):
        raise InvalidInput(f"seed: given {shown(seed)}; allowed: a whole number from 0 up")
    all_models = models(case, found, hypotheses or {}, phases or {})
    _require_points(all_models, measurements)
    searches = Searches(all_models, tuple(measurements), starts, seed, minimise == MINIMISED[1])
    fit_criterion = FitCriterion.of(criterion, searches.measurements)
    first = searches.problem(0)
    _require_numbers(first)
    if predict:
        with suppress(NoSolution, BearingError):
            numbers(first, first.start, tuple(predict), Known())  # refuses what is no number
    return Asked(case, searches, fit_criterion, tuple(predict), profiled, left_out)


def _require_measurements(case: Case, measurements: Sequence[Measurement]) -> None:
    if not len(measurements):
        raise InvalidInput("measurements: none is given: at least one is needed")
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
                f"measurement {data.name}: noise dominates it: its points differ by {size:.3g} "
                f"{data.unit}, their deviation is {noise:.3g} {data.unit}: leave it out, or check "
                "both units"
            )


def _require_points(every: Sequence[Model], measurements: Sequence[Measurement]) -> None:
    count = sum(getattr(each, "carried", len(each.data.observed)) for each in measurements)
    for model in every:
        priors = sum(each.deviation is not None for each in model.unknowns)
        if len(model.unknowns) > count + priors:
            raise InvalidInput(
                f"unknowns: {len(model.unknowns)} are given, more than numbers measured "
                f"({count}) and priors ({priors}): give fewer, measure more points, or give priors"
            )


def _require_numbers(problem: Problem) -> None:
    """Raise InvalidInput if the start has a solution but lacks one of the measured ``Numbers``."""
    measured = [each for each in problem.measurements if isinstance(each, Numbers)]
    with suppress(NoSolution, BearingError):
        trial = problem.trial(problem.start)
        for each in measured:
            try:
                each.predicted(trial)
            except InvalidInput as refusal:
                words = str(refusal).removeprefix(f"measurement {each.name}: ")
                raise InvalidInput(f"measurement {each.name}: {words}") from None


@typed(InvalidInput, besides=["case", "measurements"])
def identify(  # noqa: PLR0913 - all of it describes one identification
    case: Case,
    unknowns: Mapping[str, Unknown],
    measurements: Sequence[Any],
    *,
    hypotheses: Mapping[str, Sequence[Any]] | None = None,
    phases: Mapping[str, Phase] | None = None,
    predict: Sequence[Predicted] = (),
    profiles: str | Sequence[str] = (),
    criterion: str | None = None,
    minimise: str = "squares",
    starts: int = 1,
    seed: int = 0,
    workers: int | None = None,
    folder: str | Path | None = None,
    progress: Progress = lambda done, of: None,
) -> Identification:
    """Find values of a case with which it reproduces measurements, and their uncertainty.

    Parameters
    ----------
    unknowns : ``Unknown`` by dotted path, as ``rotordyn.vary`` takes it
    measurements : such as ``AxialCurve``; see ``rotordyn.study.identification.measurement``
    hypotheses : lists of values by dotted path; every combination is a model
    phases : ``Phase`` by name; each seeks other unknowns
    predict : numbers of the identified machine to compute, with their intervals
    profiles : "all", or paths or names of unknowns of the best model whose intervals are also found
        by profile likelihood
    criterion : mean absolute difference up to which a model suffices, with its unit, such as
        "1 um"; without it χ² decides
    minimise : "squares" of differences over noise, or "absolute": the mean of their absolute values
    starts : number of starts of each search: the stated one, then the best of some drawn at random
    seed : of the random starts
    workers : processes; as many as there are processors by default
    folder : where searches are kept as they end; the same study resumes from there
    progress : called with the number of searches ended and of all, then of profiles

    Returns
    -------
    Identification : with the best values so far if it is interrupted

    Raises
    ------
    InvalidInput : an invalid path, value or measurement, before anything is solved; a folder of
        another study
    NoSolution : no model has a machine with a solution
    """
    request = asked(
        case,
        unknowns,
        measurements,
        hypotheses=hypotheses,
        phases=phases,
        predict=predict,
        profiles=profiles,
        criterion=criterion,
        minimise=minimise,
        starts=starts,
        seed=seed,
    )
    return identified(request, workers, None if folder is None else Path(folder), progress)


def identified(
    request: Asked,
    workers: int | None = None,
    folder: Path | None = None,
    progress: Progress = lambda done, of: None,
) -> Identification:
    """Run a checked request; see ``identify``."""
    if workers is not None and not is_whole(workers, 1):
        raise InvalidInput(f"workers: given {shown(workers)}; allowed: a whole number from 1 up")
    searches = request.searches
    outcomes, stopped = run(searches, workers or processors(), folder, progress)
    explained: list[Explained] = []
    failed: dict[str, str] = {}
    for k, model in enumerate(searches.models):
        best_search = best_of(outcomes, k)
        if best_search is None:
            tried = [each.sentence for each in outcomes if each.number[0] == k]
            failed[model.name] = tried[0] if tried else "not searched yet"
            continue
        own_searches = tuple(each for each in outcomes if each.number[0] == k)
        explained.append(_explained(model, searches, k, best_search, own_searches))
    if not explained:
        if stopped:
            raise KeyboardInterrupt
        raise NoSolution("; ".join(dict.fromkeys(failed.values())))
    explained.sort(key=lambda each: each.information)
    best = explained[0]
    parts: dict[str, Any] = {"failed": failed, "stopped": stopped, "left_out": request.left_out}
    if request.profiles and not stopped and not best.fit.limited:
        parts["profiles"], parts["stopped"] = profiles_of(
            best.problem, best.fit, best.sure, request.profiles, workers or processors(), progress
        )
    result = Identification(
        request.case.name, request.case.title, tuple(explained), request.criterion, **parts
    )
    nominal = predictions(best.problem, best.sure, request.predict)
    others = [(each.name, each.problem, each.fit.values) for each in result.survivors[1:]]
    return replace(result, predictions=over_models(nominal, others, request.predict))


def _explained(
    model: Model, asked: Searches, number: int, best: Search, searches: tuple[Search, ...]
) -> Explained:
    problem = asked.problem(number)
    values = np.array(best.values)
    predicted = problem.predicted(values)
    assert predicted is not None, "the search solved it"
    absolute = best.merit if asked.absolute else None
    fit = Fit(values, best.cost, predicted, best.ended, best.limited, absolute)
    sure = certainty(problem, fit, absolute=asked.absolute)
    return Explained(model, problem, fit, sure, searches)
