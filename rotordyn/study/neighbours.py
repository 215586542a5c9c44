"""Similar machines, solved one after another in one process.

Stages that a machine has in common with the previous ones are not solved again, preload states of
the next machines are solved together, and the compiled bearing solver is loaded if many follow.

The error check by a finer model takes time (the finer model replaces the first one where the error
is too large). Similar machines have nearly the same error, so that one check serves several: the
first machine of a process is checked; if its error is at most half of the accuracy, the next nine
are not, or more of them the smaller it is; otherwise the next one is checked, too. If the accuracy
is below ``TIGHT`` every machine is checked: such small errors contain rounding and do not carry
over. A machine that is not checked keeps its first model, and its own error is unknown.

Theory: docs/theory/refinement.md.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from bearings.geometry import geometry
from bearings.ring.compiled.states import expect
from rotordyn.analyses.solving import MachineResults
from rotordyn.case.case import Case
from rotordyn.job.solving import solve
from rotordyn.numerics.threads import linear_algebra_alone
from rotordyn.scene.ahead import solve_ahead
from rotordyn.scene.checks import Checks
from rotordyn.scene.stage import Memo
from rotordyn.scene.statics import Statics

LATEST = 2  # values of a stage kept, beside the first one, which may be the nominal machine's
SMALL = 0.5  # share of the allowed error, up to which the check of a machine serves others
PER_CHECK = 10  # machines per check at an error of SMALL; more in proportion to SMALL/error
MOST = 40  # machines per check, however small the error is
TIGHT = 1e-7  # accuracy
SAVED = 0.25  # share of the time of a machine that the compiled bearing solver saves


@dataclass
class Neighbours:
    """Solver of similar machines.

    ``memo``: stages of machines solved so far; ``unchecked``: number of machines until the next
    check; ``fineness``: what decided the model of the last one; ``quickest``: least seconds of a
    machine, the first one excluded since it imports."""

    memo: Memo = field(default_factory=Memo)
    unchecked: int = 0
    fineness: tuple[Any, ...] = ()
    quickest: float = math.inf

    @property
    def empty(self) -> bool:
        """Whether no stage of a machine has been solved yet."""
        return not self.memo.values

    def solve_ahead(self, cases: Sequence[Case]) -> None:
        """Solve the preload states of the next machines together, where that is possible."""
        machines = [
            Statics(case.spindle, case.conditions, np.array(case.speeds), self.memo)
            for case in cases
            if case.spindle is not None
        ]
        with linear_algebra_alone():
            solve_ahead(machines, self.memo)

    def solve(
        self, case: Case, *, checked: bool = False, further: int = 0
    ) -> tuple[MachineResults, float | None]:
        """Solve a case; return its results and their largest error over the allowed one, None if
        not checked. ``checked``: check it whatever the previous ones showed; ``further``: number of
        machines still to come.

        Raises
        ------
        NoSolution : no speed has one
        """
        fineness = _fineness(case)
        checks = Checks(wanted=checked or not self.unchecked or fineness != self.fineness)
        self.fineness = fineness
        first, begin = self.empty, time.perf_counter()
        try:
            results = solve(case, memo=self.memo, checks=checks)
        finally:
            self.memo.forget(LATEST)
        if not first:
            self.quickest = min(self.quickest, time.perf_counter() - begin)
            self._expect(case, further)
        if not checks.wanted:
            self.unchecked -= 1
            return results, None
        self.unchecked = 0
        if checks.first <= SMALL and case.conditions.accuracy >= TIGHT:
            most = PER_CHECK * SMALL / checks.first if checks.first else math.inf
            self.unchecked = int(min(MOST, most)) - 1
        return results, checks.worst

    def _expect(self, case: Case, further: int) -> None:
        seats = case.spindle.seats if case.spindle else ()
        for grooves in {seat.bearing.grooves for seat in seats}:
            expect(SAVED * self.quickest * further, geometry(grooves))


def _fineness(case: Case) -> tuple[Any, ...]:
    """All that decides the model of a case; a check holds only for machines with the same."""
    conditions = case.conditions
    bands = [getattr(spec, "max_frequency", None) for spec in case.analyses.values()]
    required = conditions.accuracy, conditions.element_length, conditions.rotor
    return (*required, conditions.formulation, case.speeds, *bands)
