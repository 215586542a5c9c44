"""Warnings and notes on a case that follow from its description, without solving anything."""

from __future__ import annotations

from collections.abc import Iterator

from rotordyn.analyses.unlimited import unlimited
from rotordyn.case.case import Case
from rotordyn.machine.plausibility import RPM, estimates, implausible, unopposed
from rotordyn.results.by_variant import by_variant
from rotordyn.scene.conditions import HYPOTHESES, Conditions

# [mm/min] n·dm. At 1.08 million the radial stiffness of the grinding spindle is 110 to 209 N/µm by
# the choice of moment sharing; the gyroscopic moment goes with the square of the speed.
SPREADING = 0.5e6


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


def unstated_hypotheses(case: Case) -> str:
    """Return a note on hypotheses on the balls that the case leaves to their defaults, although its
    results depend on them; empty if there are none.

    In Python a hypothesis of new Conditions that equals its default counts as not stated."""
    given, usual = case.conditions, Conditions()
    spindle, top = case.spindle, case.speeds[-1]
    if spindle is None or given.bearings == "static" or given.dynamics == "frozen":
        return ""
    factors = {s.name: top * RPM * s.bearing.pitch_diameter * 1e3 for s in spindle.seats}
    fast = [seat for seat in spindle.seats if factors[seat.name] > SPREADING]
    taken = {
        key: getattr(given, key)
        for key in HYPOTHESES
        if key not in given.stated
        and getattr(given, key) == getattr(usual, key)
        and any(getattr(seat, key) is None for seat in fast)
        and not (key == "moment_sharing" and given.dynamics == "centrifugal")
        and not _varied(case, key)
    }
    if not taken:
        return ""
    several = len(taken) > 1
    return (
        f"{' and '.join(f'conditions.{key}' for key in taken)} {'are' if several else 'is'} not "
        f"stated: the default{'s' * several} {' and '.join(taken.values())} "
        f"{'are' if several else 'is'} taken, on which preload and stiffness depend at n·dm of "
        f"{max(factors.values()) / 1e6:.2g} million mm/min; state {'them' if several else 'it'}, "
        "or see the ranges by rotordyn run --interval"
    )


def _varied(case: Case, key: str) -> bool:
    """Whether a hypothesis is one of the uncertain values of the case."""
    uncertain = case.uncertain
    if uncertain is None:
        return False
    return uncertain.as_usual or any(n.rpartition(".")[2] == key for n in uncertain.hypotheses)


def _pushed(case: Case) -> bool:
    """Whether something other than bearings may carry the thrust."""
    given, spindle = case.conditions, case.spindle
    assert spindle is not None
    along = given.axial_force or given.loads or given.gravity[1:] == "x"
    return bool(along or given.history or spindle.supports or spindle.rotors)
