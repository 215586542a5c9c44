"""Machines that differ little, solved one after another in one process.

What the last ones have in common with the next is not solved again, and where many are to come the
compiled solver of bearings is loaded for them. Their errors are the same to a
few percent: a finer model looks for them at every tenth machine, and at the next one again where
they are not well below what the accuracy allows.

Theory: docs/theory/refinement.md.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, field

from bearings.geometry import geometry
from bearings.ring.compiled.states import expect
from rotordyn.analyses.solving import Answers
from rotordyn.case.case import Case
from rotordyn.job.solving import solve
from rotordyn.scene.checks import Checks
from rotordyn.scene.stage import Memo

LATEST = 2  # values of a stage kept beside the first
EVERY = 10  # machine is solved with a finer model too
WELL_BELOW = 0.5  # of the error allowed
SAVED = 0.25  # of the time of a machine, by the compiled solver of bearings


@dataclass
class Neighbours:
    """``memo``: stages of machines solved so far; ``unchecked``: how many more are solved before
    errors are looked for again; ``quickest``: seconds of the quickest after the first, which
    imports."""

    memo: Memo = field(default_factory=Memo)
    unchecked: int = 0
    quickest: float = math.inf

    @property
    def none(self) -> bool:
        """True before the first machine."""
        return not self.memo.values

    def solve(
        self, case: Case, *, checked: bool = False, further: int = 0
    ) -> tuple[Answers, float | None]:
        """The answers to a case, and their largest error over what the accuracy allows, None where
        it was not looked for; ``checked``: it is in any case. ``further``: how many are to come.

        Raises
        ------
        NoSolution : no speed has one
        """
        checks = Checks(wanted=checked or not self.unchecked)
        first, begin = self.none, time.perf_counter()
        try:
            answers = solve(case, memo=self.memo, checks=checks)
        finally:
            for values in self.memo.values.values():
                del values[1:-LATEST]
        if not first:
            self.quickest = min(self.quickest, time.perf_counter() - begin)
            self._expect(case, further)
        if not checks.wanted:
            self.unchecked -= 1
            return answers, None
        self.unchecked = EVERY - 1 if checks.worst <= WELL_BELOW else 0
        return answers, checks.worst

    def _expect(self, case: Case, further: int) -> None:
        seats = case.spindle.seats if case.spindle else ()
        for grooves in {seat.bearing.grooves for seat in seats}:
            expect(SAVED * self.quickest * further, geometry(grooves))
