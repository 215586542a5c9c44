"""The machines of an interval, solved only for results that get a range.

They are solved at few speeds: what counts are differences from the nominal machine at the same
speeds, and these vary slowly. Stages that machines have in common are solved once.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from bearings.errors import BearingError
from rotordyn.analyses.registry import analysis
from rotordyn.case.asked import certain
from rotordyn.case.case import Case
from rotordyn.case.paths import found_at
from rotordyn.case.vary import changed
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.job.values import Values, values_of
from rotordyn.results.headline import NONE
from rotordyn.study.neighbours import Neighbours

EVENLY = 9  # evenly spaced speeds, beside those that an analysis needs
TOGETHER = 32  # machines whose preload states are solved at a time


def lean(case: Case) -> Case:
    """Reduce a case to results that get a range and to few of its speeds: evenly spaced ones, and
    those nearest to what an analysis needs."""
    case = certain(case)
    kept = {speed for name, spec in case.analyses.items() for speed in analysis(name).speeds(spec)}
    speeds = np.array(case.speeds)
    rows = {int(np.abs(speeds - speed).argmin()) for speed in kept}
    rows |= {round(k) for k in np.linspace(0.0, len(speeds) - 1.0, min(EVENLY, len(speeds)))}
    specs = {name: analysis(name).lean(spec) for name, spec in case.analyses.items()}
    return replace(case, speeds=tuple(case.speeds[k] for k in sorted(rows)), analyses=specs)


@dataclass
class Machines:
    """Machines that differ from ``case`` by some values, each solved once.

    ``expected``: how many there will be; ``solved``: how many were; ``lost``: sentences on those
    without a solution."""

    case: Case
    expected: int = 0
    solved: int = 0
    lost: list[str] = field(default_factory=list)
    _neighbours: Neighbours = field(default_factory=Neighbours)
    _known: dict[str, Values] = field(default_factory=dict)

    def values(self, changes: Mapping[str, Any]) -> Values:
        """Solve the machine with other values at dotted paths; without a solution it has no
        numbers."""
        key, changes = self._other(changes)
        if key not in self._known:
            self._known[key] = self._solved(changes)
        return self._known[key]

    def _other(self, changes: Mapping[str, Any]) -> tuple[str, Mapping[str, Any]]:
        """Key of the changes, and the changes whose values differ from those of the case."""
        differing = {}
        for path, value in changes.items():
            present = [current for current, _ in found_at(self.case, path)]
            if any(type(current) is not type(value) or current != value for current in present):
                differing[path] = value
        return repr(sorted(differing.items())), differing

    def _solved(self, changes: Mapping[str, Any]) -> Values:
        self.solved += 1
        try:
            case = changed(self.case, changes)
            further = max(self.expected - self.solved, 0)
            return values_of(case, self._neighbours.solve(case, further=further)[0].results)
        except (InvalidInput, BearingError, NoSolution) as error:
            self.lost.append(str(error))
            return Values(sentence=str(error))

    def absent(self, number: str) -> str:
        """Text shown for a headline number that some solved machines lack, such as `not stable`."""
        numbers = (each.numbers[number] for each in self._known.values() if number in each.numbers)
        return next((each.absent for each in numbers if np.isnan(each.value)), NONE)

    def all(self, changes: Sequence[Mapping[str, Any]]) -> list[Values]:
        """Solve many machines; preload states of the next ones are solved together."""
        solutions = []
        for first in range(0, len(changes), TOGETHER):
            part = changes[first : first + TOGETHER]
            self._solve_ahead(part)
            solutions += [self.values(change) for change in part]
        return solutions

    def _solve_ahead(self, changes: Sequence[Mapping[str, Any]]) -> None:
        cases = []
        for key, other in map(self._other, changes):
            with suppress(InvalidInput, BearingError):  # raised again, and kept, where it is solved
                if key not in self._known:
                    cases.append(changed(self.case, other))
        self._neighbours.solve_ahead(cases)
