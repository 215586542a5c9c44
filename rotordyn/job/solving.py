"""The answers to a case: of one machine, or of variants side by side."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.allowance import STOPS, Stop, keeps_finished
from rotordyn.analyses.solving import Answers, Progress, answer_bearing, answer_spindle
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput, NoSolution

if TYPE_CHECKING:
    from rotordyn.scene.checks import Checks
    from rotordyn.scene.stage import Memo


@dataclass(frozen=True, slots=True)
class VariantAnswers:
    """Answers by the name of the variant; ``failed``: why others have none at any speed; ``stop``:
    what ended the run before all were solved, in the first one after some of its analyses."""

    answers: dict[str, Answers]
    failed: dict[str, str] = field(default_factory=dict)
    stop: Stop | None = None


def solve(
    case: Case,
    progress: Progress = lambda name: None,
    memo: Memo | None = None,
    checks: Checks | None = None,
) -> Answers:
    """Answer every question of ``case`` with frozen results; its variants are left aside.

    ``memo``: stages of cases solved before, for what they have in common; ``checks``: whether
    errors are looked for with a finer model, as they are by default.
    """
    if case.spindle is not None:
        arguments = (case.spindle, case.conditions, case.speeds, case.analyses)
        return answer_spindle(*arguments, progress, memo, checks)
    assert case.bearing is not None, "a case has one of the two"
    return answer_bearing(case.bearing, case.conditions, case.speeds, case.analyses, progress)


def solve_variants(case: Case, progress: Progress = lambda name: None) -> VariantAnswers:
    """Answer the questions of every variant of ``case``; what does not differ is solved once.

    Raises
    ------
    NoSolution : no variant has a physical solution at any speed
    """
    from rotordyn.scene.stage import Memo

    solved = VariantAnswers({})
    memo = Memo()
    for name, variant in case.variants.items():
        try:
            answers = solve(variant, partial(_part, progress, name), memo)
        except NoSolution as error:
            solved.failed[name] = f"variant {name}: {error}"
            continue
        except STOPS as stop:
            if not (solved.answers and keeps_finished()):
                raise
            return replace(solved, stop=stop)
        if answers.stop is None or not solved.answers:
            solved.answers[name] = answers
        if answers.stop is not None:
            return replace(solved, stop=answers.stop)
    if not solved.answers:
        raise NoSolution("; ".join(solved.failed.values()))
    return solved


def _part(progress: Progress, variant: str, stage: str) -> None:
    progress(f"{variant}: {stage}")


def restricted(case: Case, only: tuple[str, ...]) -> Case:
    """``case`` and its variants with only some of the analyses.

    Raises
    ------
    InvalidInput : a name is not among the analyses of the case
    """
    unknown = [name for name in only if name not in case.analyses]
    if unknown:
        known = ", ".join(case.analyses)
        raise InvalidInput(f"--only {','.join(unknown):.200}: this case has the analyses {known}")
    return replace(
        case,
        analyses={n: s for n, s in case.analyses.items() if n in only},
        variants={name: restricted(v, only) for name, v in case.variants.items()},
    )


def one_variant(case: Case, name: str) -> Case:
    """The variant ``name`` of ``case`` as a case of its own.

    Raises
    ------
    InvalidInput : the case has no such variant
    """
    if name not in case.variants:
        known = ", ".join(case.variants) or "none, this case compares nothing"
        raise InvalidInput(f"--variant {name:.200}: the variants of this case are {known}")
    return replace(case.variants[name], name=f"{case.name}_{name}")


def labelled(case: Case) -> dict[str, Case]:
    """The variants of ``case`` with titles that tell them apart."""
    titles = {name: variant.title.strip() or name for name, variant in case.variants.items()}
    count = Counter(titles.values())
    return {
        name: replace(variant, title=title if count[title] == 1 else f"{title} ({name})")
        for (name, variant), title in zip(case.variants.items(), titles.values(), strict=True)
    }


def unsolved(results: Mapping[str, Any]) -> tuple[str, ...]:
    """Why speeds have no solution, each reason once, in order of speed."""
    words = [str(w) for r in results.values() for w in np.ravel(r.outcome) if str(w)]
    return tuple(dict.fromkeys(words))
