"""Machines that differ little, solved one after another in one process.

Stages that the next machine has in common with the last ones are not solved again, preload states
of those that come next are solved together, and where many are to come the compiled solver of
bearings is loaded for them.

A check by a finer model, which takes the place of the first one where the error of that is too
large, takes time. Machines that differ little have nearly the same error, so that one check serves
several: the first machine of a process is checked, and if its error is at most half of what the
accuracy allows, the nine that follow are not, or more of them the smaller it is; if it is more, the
very next one is. Where the accuracy is beyond ``TIGHT`` every machine is checked: errors so small
are of rounding too, and say little of others. A machine that is not checked keeps its first model,
and its own error is not known.

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
from rotordyn.analyses.solving import Answers
from rotordyn.case.case import Case
from rotordyn.job.solving import solve
from rotordyn.numerics.threads import linear_algebra_alone
from rotordyn.scene.ahead import solve_ahead
from rotordyn.scene.checks import Checks
from rotordyn.scene.stage import Memo
from rotordyn.scene.statics import Statics

LATEST = 2  # values of a stage kept, beside the first: that of the nominal machine, if any
SMALL = 0.5  # share of the error allowed up to which the error of a machine stands for others
PER_CHECK = (
    10  # so many, itself among them, where it is ``SMALL``; more in proportion to SMALL/error
)
MOST = 40  # of them, however small it is
TIGHT = 1e-7  # accuracy asked for
SAVED = 0.25  # of the time of a machine, by the compiled solver of bearings


@dataclass
class Neighbours:
    """``memo``: stages of machines solved so far; ``unchecked``: how many machines are left until
    one is checked; ``fineness``: what the model of the last was made for; ``quickest``: seconds of
    the quickest after the first, which imports."""

    memo: Memo = field(default_factory=Memo)
    unchecked: int = 0
    fineness: tuple[Any, ...] = ()
    quickest: float = math.inf

    @property
    def empty(self) -> bool:
        """Whether no stage of a machine has been solved yet."""
        return not self.memo.values

    def solve_ahead(self, cases: Sequence[Case]) -> None:
        """Solve together what can be of machines that come next."""
        machines = [
            Statics(case.spindle, case.conditions, np.array(case.speeds), self.memo)
            for case in cases
            if case.spindle is not None
        ]
        with linear_algebra_alone():
            solve_ahead(machines, self.memo)

    def solve(
        self, case: Case, *, checked: bool = False, further: int = 0
    ) -> tuple[Answers, float | None]:
        """The answers to a case, and their largest error as a share of that allowed; None if the
        machine is not checked. ``checked``: check it whatever the last ones showed; ``further``:
        how many are to come.

        Raises
        ------
        NoSolution : no speed has one
        """
        fineness = _fineness(case)
        checks = Checks(wanted=checked or not self.unchecked or fineness != self.fineness)
        self.fineness = fineness
        first, begin = self.empty, time.perf_counter()
        try:
            answers = solve(case, memo=self.memo, checks=checks)
        finally:
            self.memo.forget(LATEST)
        if not first:
            self.quickest = min(self.quickest, time.perf_counter() - begin)
            self._expect(case, further)
        if not checks.wanted:
            self.unchecked -= 1
            return answers, None
        self.unchecked = 0
        if checks.first <= SMALL and case.conditions.accuracy >= TIGHT:
            most = PER_CHECK * SMALL / checks.first if checks.first else math.inf
            self.unchecked = int(min(MOST, most)) - 1
        return answers, checks.worst

    def _expect(self, case: Case, further: int) -> None:
        seats = case.spindle.seats if case.spindle else ()
        for grooves in {seat.bearing.grooves for seat in seats}:
            expect(SAVED * self.quickest * further, geometry(grooves))


def _fineness(case: Case) -> tuple[Any, ...]:
    """What is asked of the model of a case: another one is checked again."""
    conditions = case.conditions
    bands = [getattr(spec, "max_frequency", None) for spec in case.analyses.values()]
    asked = conditions.accuracy, conditions.element_length, conditions.rotor
    return (*asked, conditions.formulation, case.speeds, *bands)
