"""Solve a case: one machine, or all its variants."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.allowance import STOPS, Stop, keeps_finished
from rotordyn.analyses.solving import MachineResults, Progress, solve_bearing, solve_spindle
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput, NoSolution

if TYPE_CHECKING:
    from rotordyn.scene.checks import Checks
    from rotordyn.scene.stage import Memo


@dataclass(frozen=True, slots=True)
class VariantResults:
    """Results by variant; ``failed``: reasons of variants without a solution; ``stop``: what ended
    the run early, in the first variant after some of its analyses."""

    machines: dict[str, MachineResults]
    failed: dict[str, str] = field(default_factory=dict)
    stop: Stop | None = None


def solve(
    case: Case,
    progress: Progress = lambda name: None,
    memo: Memo | None = None,
    checks: Checks | None = None,
) -> MachineResults:
    """Solve all analyses of ``case``; its variants are ignored.

    ``memo``: stages of previous cases, reused where they are the same; ``checks``: whether errors
    are estimated by a finer model, as by default.
    """
    if case.spindle is not None:
        arguments = (case.spindle, case.conditions, case.speeds, case.analyses)
        return solve_spindle(*arguments, progress, memo, checks)
    assert case.bearing is not None, "a case has one of the two"
    return solve_bearing(case.bearing, case.conditions, case.speeds, case.analyses, progress)


def solve_variants(case: Case, progress: Progress = lambda name: None) -> VariantResults:
    """Solve all variants of ``case``; common stages are solved once.

    Raises
    ------
    NoSolution : no variant has a physical solution at any speed
    """
    from rotordyn.scene.stage import Memo

    solved = VariantResults({})
    memo = Memo()
    for name, variant in case.variants.items():
        try:
            machine = solve(variant, partial(_part, progress, name), memo)
        except NoSolution as error:
            solved.failed[name] = f"variant {name}: {error}"
            continue
        except STOPS as stop:
            if not (solved.machines and keeps_finished()):
                raise
            return replace(solved, stop=stop)
        if machine.stop is None or not solved.machines:
            solved.machines[name] = machine
        if machine.stop is not None:
            return replace(solved, stop=machine.stop)
    if not solved.machines:
        raise NoSolution("; ".join(solved.failed.values()))
    return solved


def _part(progress: Progress, variant: str, stage: str) -> None:
    progress(f"{variant}: {stage}")


def restricted(case: Case, only: tuple[str, ...]) -> Case:
    """Restrict ``case`` and its variants to some of the analyses.

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
    """Return the variant ``name`` of ``case`` as a case of its own.

    Raises
    ------
    InvalidInput : the case has no such variant
    """
    if name not in case.variants:
        known = ", ".join(case.variants) or "none, this case compares nothing"
        raise InvalidInput(f"--variant {name:.200}: the variants of this case are {known}")
    return replace(case.variants[name], name=f"{case.name}_{name}")


def labelled(case: Case) -> dict[str, Case]:
    """Variants of ``case`` with distinct titles."""
    titles = {name: variant.title.strip() or name for name, variant in case.variants.items()}
    count = Counter(titles.values())
    return {
        name: replace(variant, title=title if count[title] == 1 else f"{title} ({name})")
        for (name, variant), title in zip(case.variants.items(), titles.values(), strict=True)
    }


def unsolved(results: Mapping[str, Any]) -> tuple[str, ...]:
    """Distinct reasons why speeds have no solution, in the order of speed."""
    words = [str(w) for r in results.values() for w in np.ravel(r.outcome) if str(w)]
    return tuple(dict.fromkeys(words))
