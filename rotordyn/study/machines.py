"""The machines that an interval takes, solved for what has a range and nothing else.

They are solved at few speeds: differences from the nominal machine at the same speeds are what is
kept, and these vary slowly. What machines have in common is solved once.
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
from rotordyn.case.varied import found_at
from rotordyn.case.vary import changed
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.job.values import Values, values_of
from rotordyn.results.headline import NONE
from rotordyn.study.neighbours import Neighbours

EVENLY = 9  # speeds, beside those that an analysis needs
TOGETHER = 32  # machines whose preload states are solved at a time


def lean(case: Case) -> Case:
    """The case with its analyses asked for what has a range alone, at few of its speeds: evenly
    from the first to the last, and next to those that an analysis needs."""
    case = certain(case)
    kept = {speed for name, spec in case.analyses.items() for speed in analysis(name).speeds(spec)}
    speeds = np.array(case.speeds)
    rows = {int(np.abs(speeds - speed).argmin()) for speed in kept}
    rows |= {round(k) for k in np.linspace(0.0, len(speeds) - 1.0, min(EVENLY, len(speeds)))}
    specs = {name: analysis(name).lean(spec) for name, spec in case.analyses.items()}
    return replace(case, speeds=tuple(case.speeds[k] for k in sorted(rows)), analyses=specs)


@dataclass
class Machines:
    """Machines that differ from ``case`` by some values, so many as are ``expected``; ``lost``: why
    some have no solution."""

    case: Case
    expected: int = 0
    solved: int = 0
    lost: list[str] = field(default_factory=list)
    _neighbours: Neighbours = field(default_factory=Neighbours)
    _known: dict[str, Values] = field(default_factory=dict)

    def values(self, changes: Mapping[str, Any]) -> Values:
        """What the machine with other values at dotted paths comes to; one without a solution has
        no numbers."""
        key, changes = self._other(changes)
        if key not in self._known:
            self._known[key] = self._solved(changes)
        return self._known[key]

    def _other(self, changes: Mapping[str, Any]) -> tuple[str, Mapping[str, Any]]:
        """Those of the values that are not those of the case already, and words for them."""
        other = {}
        for path, value in changes.items():
            found = [held for held, _ in found_at(self.case, path)]
            if any(type(held) is not type(value) or held != value for held in found):
                other[path] = value
        return repr(sorted(other.items())), other

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
        """What is said of a headline number that some of the machines solved lack, such as `not
        stable`."""
        held = (each.numbers[number] for each in self._known.values() if number in each.numbers)
        return next((each.absent for each in held if np.isnan(each.value)), NONE)

    def all(self, changes: Sequence[Mapping[str, Any]]) -> list[Values]:
        """The same of many; preload states of those that come next are solved together."""
        found = []
        for first in range(0, len(changes), TOGETHER):
            part = changes[first : first + TOGETHER]
            self._solve_ahead(part)
            found += [self.values(each) for each in part]
        return found

    def _solve_ahead(self, changes: Sequence[Mapping[str, Any]]) -> None:
        cases = []
        for key, other in map(self._other, changes):
            with suppress(InvalidInput, BearingError):  # told where it is solved
                if key not in self._known:
                    cases.append(changed(self.case, other))
        self._neighbours.solve_ahead(cases)
