"""Warnings about a case that follow from its description, without solving anything."""

from __future__ import annotations

from collections.abc import Iterator

from rotordyn.analyses.unlimited import unlimited
from rotordyn.case.case import Case
from rotordyn.machine.plausibility import estimates, implausible, unopposed
from rotordyn.results.by_variant import by_variant


def doubts(case: Case) -> Iterator[str]:
    """Yield warnings and reasons of failure that a run would report, preceded by the variants."""
    yield from by_variant(
        {name: [*_of_one(each)] for name, each in (case.variants or {"": case}).items()}
    )


def _of_one(case: Case) -> Iterator[str]:
    if case.bearing is not None:
        yield from estimates({"": case.bearing})
    if case.spindle is None:
        return
    turning = case.conditions.bearings != "static"
    yield from implausible(case.spindle, case.speeds[-1] if turning else 0.0)
    if not _pushed(case) and (alone := unopposed(case.spindle)):
        yield alone
    yield from unlimited(case.spindle, case.analyses)


def _pushed(case: Case) -> bool:
    """Whether something other than bearings may carry the thrust."""
    given, spindle = case.conditions, case.spindle
    assert spindle is not None
    along = given.axial_force or given.loads or given.gravity[1:] == "x"
    return bool(along or given.history or spindle.supports or spindle.rotors)
