"""Machines that differ little, solved one after another in one process.

What the last ones have in common with the next is not solved again. Their errors are the same to a
few percent: a finer model looks for them at every tenth machine, and at the next one again where
they are not well below what the accuracy allows.

Theory: docs/theory/refinement.md.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from rotordyn.analyses.solving import Answers
from rotordyn.case.case import Case
from rotordyn.job.solving import solve
from rotordyn.scene.checks import Checks
from rotordyn.scene.stage import Memo

LATEST = 2  # values of a stage kept beside the first
EVERY = 10  # machine is solved with a finer model too
WELL_BELOW = 0.5  # of the error allowed


@dataclass
class Neighbours:
    """``memo``: stages of machines solved so far; ``unchecked``: how many more are solved before
    errors are looked for again."""

    memo: Memo = field(default_factory=Memo)
    unchecked: int = 0

    @property
    def none(self) -> bool:
        """True before the first machine."""
        return not self.memo.values

    def solve(self, case: Case, *, checked: bool = False) -> tuple[Answers, float | None]:
        """The answers to a case, and their largest error over what the accuracy allows, None where
        it was not looked for; ``checked``: it is in any case.

        Raises
        ------
        NoSolution : no speed has one
        """
        checks = Checks(wanted=checked or not self.unchecked)
        try:
            answers = solve(case, memo=self.memo, checks=checks)
        finally:
            for values in self.memo.values.values():
                del values[1:-LATEST]
        if not checks.wanted:
            self.unchecked -= 1
            return answers, None
        self.unchecked = EVERY - 1 if checks.worst <= WELL_BELOW else 0
        return answers, checks.worst
