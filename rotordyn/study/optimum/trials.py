"""Trials made so far, kept on disk as they come; no place is evaluated twice."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from rotordyn.study import record
from rotordyn.study.optimum.problem import Place, Problem, Trial, solve_trial
from rotordyn.study.workers import pack, solved_here

JOURNAL = "trials.jsonl"


class Spent(Exception):
    """All allowed trials have been made."""


class Trials:
    """Trials of a problem: at most ``most``, on ``workers`` processes.

    ``made``: trials by place, in the order of the requests. With a ``folder``, trials of an earlier
    call with the same problem are read from there.
    """

    def __init__(
        self,
        problem: Problem,
        most: int,
        workers: int,
        folder: Path | None,
        progress: Callable[[int, int], None],
    ) -> None:
        self.problem, self.most, self.workers, self.progress = problem, most, workers, progress
        self.made: dict[Place, Trial] = {}
        self._packed = pack(problem)
        self._path = None if folder is None else folder / JOURNAL
        self._kept = {} if self._path is None else _read(self._path, _signature(problem))

    def at(self, places: Sequence[Place]) -> list[Trial]:
        """Evaluate places.

        Raises
        ------
        Spent : not all of them are allowed any more; those that are have been made
        """
        new = [place for place in dict.fromkeys(places) if place not in self.made]
        granted = new[: self.most - len(self.made)]
        missing = [place for place in granted if place not in self._kept]
        already_known = len(self.made) + len(granted) - len(missing)
        outcomes = solved_here(self._packed, missing, self.workers, solve_trial)
        for k, each in enumerate(outcomes, start=1):
            self._keep(each)
            self.progress(already_known + k, self.most)
        self.made |= {place: self._kept[place] for place in granted}
        self.progress(len(self.made), self.most)
        if len(granted) < len(new):
            raise Spent
        return [self.made[place] for place in places]

    def _keep(self, trial: Trial) -> None:
        self._kept[trial.number] = trial
        if self._path is not None:
            record.add(self._path, asdict(trial))


def _signature(problem: Problem) -> str:
    words = repr(replace(problem, case=replace(problem.case, files=())))
    return hashlib.sha256(words.encode()).hexdigest()


def _read(path: Path, signature: str) -> dict[Place, Trial]:
    """Read the trials kept of this problem, by place."""
    lines = record.begun(path, "optimum", signature, "trials")
    try:
        trials = [Trial(**{key: _tuple(value) for key, value in line.items()}) for line in lines]
    except (TypeError, AttributeError):
        raise record.unreadable(path, "trials") from None
    return {each.number: each for each in trials}


def _tuple(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value
