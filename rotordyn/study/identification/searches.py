"""Searches of all models from all starts, on disk as they end, so that a stopped study goes on."""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, fields, is_dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import NoSolution
from rotordyn.study import record
from rotordyn.study.identification.measurement import Measurement
from rotordyn.study.identification.models import Model
from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.search import Fit, begin_at, search, search_absolute
from rotordyn.study.identification.trial import Known
from rotordyn.study.workers import solved_here

Array = NDArray[np.float64]
JOURNAL = "searches.jsonl"
Progress = Callable[[int, int], None]


@dataclass(frozen=True, eq=False, slots=True)
class Searches:
    """What is searched: ``models`` against ``measurements``, ``starts`` of each, ``absolute``
    whether the mean absolute difference is made least."""

    models: tuple[Model, ...]
    measurements: tuple[Measurement, ...]
    starts: int
    seed: int
    absolute: bool = False

    def problem(self, model: int, known: Known | None = None) -> Problem:
        """One model against the measurements."""
        held = self.models[model]
        known = known or Known()
        return Problem(held.case, held.unknowns, self.measurements, known=known)


@dataclass(frozen=True, slots=True)
class Search:
    """A search that came to an end (``limited``: by the most machines that it may take), or was
    stopped (``ended`` false): ``number`` (model, start); values, sum of squares, what was made
    least, machines solved; ``sentence``: why there are none."""

    number: tuple[int, int]
    values: tuple[float, ...] = ()
    cost: float = float("inf")
    merit: float = float("inf")
    evaluations: int = 0
    ended: bool = True
    limited: bool = False
    sentence: str = ""


def searched(packed: bytes, number: tuple[int, int], count: int = 1) -> Search:
    """One search of pickled ``Searches``, in whatever process this is."""
    all_of_them, known = _unpacked(packed)
    model, start = number
    problem = all_of_them.problem(model, known)
    try:
        begin = begin_at(problem, start, all_of_them.seed)
        how = search_absolute if all_of_them.absolute else search
        found: Fit = how(problem, begin)
    except NoSolution as error:
        return Search(number, sentence=str(error), evaluations=problem.evaluations)
    values = tuple(found.values.tolist())
    return Search(
        number,
        values,
        found.cost,
        found.merit,
        problem.evaluations,
        found.ended,
        found.limited,
    )


@lru_cache(maxsize=1)
def _unpacked(packed: bytes) -> tuple[Searches, Known]:
    return pickle.loads(packed), Known()


def run(
    searches: Searches, workers: int, folder: Path | None, progress: Progress
) -> tuple[list[Search], bool]:
    """All searches, and whether they were stopped before the end; those kept without a solution are
    made anew.

    Raises
    ------
    InvalidInput : the folder holds something else, or cannot be written
    """
    every = [(m, s) for m in range(len(searches.models)) for s in range(searches.starts)]
    journal = None if folder is None else folder / JOURNAL
    kept = {} if journal is None else _read(journal, _signature(searches))
    found = {number: kept[number] for number in every if number in kept and kept[number].values}
    missing = [number for number in every if number not in found]
    progress(len(found), len(every))
    try:
        for each in solved_here(pickle.dumps(searches), missing, workers, searched):
            found[each.number] = each
            if not each.ended:
                return [*found.values()], True
            if journal is not None:
                record.add(journal, asdict(each))
            progress(len(found), len(every))
    except KeyboardInterrupt:
        return [*found.values()], True
    return [*found.values()], False


def best_of(found: Sequence[Search], model: int) -> Search | None:
    """The best search of a model; None where none has a solution."""
    good = [each for each in found if each.number[0] == model and each.values]
    return min(good, key=lambda each: each.merit, default=None)


def _signature(searches: Searches) -> str:
    """What two studies have in common whose searches are the same."""
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
    """What describes a dataclass; nothing of a measurement that is none."""
    return [getattr(of, f.name) for f in fields(of) if f.repr] if is_dataclass(of) else []


def _read(path: Path, signature: str) -> dict[tuple[int, int], Search]:
    """Searches kept of this study."""
    what = "searches"
    lines = record.begun(path, "identification", signature, what)
    try:
        found = [
            Search(**line | {"number": tuple(line["number"]), "values": tuple(line["values"])})
            for line in lines
        ]
    except (TypeError, KeyError):
        raise record.unreadable(path, what) from None
    return {each.number: each for each in found}
