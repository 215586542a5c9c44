"""Searches of all models from all starts, kept on disk so that an interrupted study can resume."""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, fields, is_dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from rotordyn.errors import NoSolution
from rotordyn.study import record
from rotordyn.study.identification.measurement import Measurement
from rotordyn.study.identification.models import Model
from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.search import Fit, begin_at, search, search_absolute
from rotordyn.study.identification.trial import Known
from rotordyn.study.workers import solved_here

JOURNAL = "searches.jsonl"
Progress = Callable[[int, int], None]


@dataclass(frozen=True, eq=False, slots=True)
class Searches:
    """``models``, ``measurements``, number of ``starts`` of each model; ``absolute``: whether the
    mean absolute difference is minimised."""

    models: tuple[Model, ...]
    measurements: tuple[Measurement, ...]
    starts: int
    seed: int
    absolute: bool = False

    def problem(self, model: int, known: Known | None = None) -> Problem:
        """Problem of one model."""
        chosen = self.models[model]
        known = known or Known()
        return Problem(chosen.case, chosen.unknowns, self.measurements, known=known)


@dataclass(frozen=True, slots=True)
class Search:
    """Outcome of a search: ``number`` (model, start), ``values``, ``cost`` (sum of squares),
    ``merit`` (the minimised quantity), machines solved. ``ended``: false if interrupted;
    ``limited``: ended by its limit of machines; ``sentence``: why there are no values."""

    number: tuple[int, int]
    values: tuple[float, ...] = ()
    cost: float = float("inf")
    merit: float = float("inf")
    evaluations: int = 0
    ended: bool = True
    limited: bool = False
    sentence: str = ""


def searched(packed: bytes, number: tuple[int, int], count: int = 1) -> Search:
    """Run one search of pickled ``Searches`` in this process."""
    searches, known = _unpacked(packed)
    model, start = number
    problem = searches.problem(model, known)
    try:
        begin = begin_at(problem, start, searches.seed)
        method = search_absolute if searches.absolute else search
        fit: Fit = method(problem, begin)
    except NoSolution as error:
        return Search(number, sentence=str(error), evaluations=problem.evaluations)
    values = tuple(fit.values.tolist())
    return Search(
        number,
        values,
        fit.cost,
        fit.merit,
        problem.evaluations,
        fit.ended,
        fit.limited,
    )


@lru_cache(maxsize=1)
def _unpacked(packed: bytes) -> tuple[Searches, Known]:
    return pickle.loads(packed), Known()


def run(
    searches: Searches, workers: int, folder: Path | None, progress: Progress
) -> tuple[list[Search], bool]:
    """Run all searches; return outcomes, and whether they were interrupted. Kept searches without
    a solution are repeated.

    Raises
    ------
    InvalidInput : the folder holds something else, or cannot be written
    """
    numbers = [(m, s) for m in range(len(searches.models)) for s in range(searches.starts)]
    journal = None if folder is None else folder / JOURNAL
    kept = {} if journal is None else _read(journal, _signature(searches))
    outcomes = {
        number: kept[number] for number in numbers if number in kept and kept[number].values
    }
    missing = [number for number in numbers if number not in outcomes]
    progress(len(outcomes), len(numbers))
    try:
        for each in solved_here(pickle.dumps(searches), missing, workers, searched):
            outcomes[each.number] = each
            if not each.ended:
                return [*outcomes.values()], True
            if journal is not None:
                record.add(journal, asdict(each))
            progress(len(outcomes), len(numbers))
    except KeyboardInterrupt:
        return [*outcomes.values()], True
    return [*outcomes.values()], False


def best_of(found: Sequence[Search], model: int) -> Search | None:
    """Best search of a model; None if none has a solution."""
    solved = [each for each in found if each.number[0] == model and each.values]
    return min(solved, key=lambda each: each.merit, default=None)


def _signature(searches: Searches) -> str:
    """Hash of all that decides the searches."""
    digest = hashlib.sha256()
    for model in searches.models:
        digest.update(repr((model.name, replace(model.case, files=()), model.unknowns)).encode())
    for each in searches.measurements:
        digest.update(type(each).__name__.encode())
        for part in (*_fields(each.data), *_fields(each)):
            written = part.tobytes() if isinstance(part, np.ndarray) else repr(part).encode()
            digest.update(written)
    digest.update(repr((searches.seed, searches.absolute)).encode())
    return digest.hexdigest()


def _fields(of: Any) -> list[Any]:
    """Values of the fields of a dataclass; empty for another object."""
    return [getattr(of, f.name) for f in fields(of) if f.repr] if is_dataclass(of) else []


def _read(path: Path, signature: str) -> dict[tuple[int, int], Search]:
    """Read the searches kept of this study, by number."""
    what = "searches"
    lines = record.begun(path, "identification", signature, what)
    try:
        kept = [
            Search(**line | {"number": tuple(line["number"]), "values": tuple(line["values"])})
            for line in lines
        ]
    except (TypeError, KeyError):
        raise record.unreadable(path, what) from None
    return {each.number: each for each in kept}
