"""Cases at few of their speeds: every question is still asked, and everything drawn."""

from __future__ import annotations

import rotordyn
from rotordyn.case.case import Case

SPEEDS = 3
OF_A_CHART = 16  # of stability lobes


def at_few_speeds(case: Case) -> Case:
    """Evenly from the first to the last."""
    changes = {"speeds": _few(case.speeds, SPEEDS)}
    for name, spec in case.analyses.items():
        if own := getattr(spec, "speeds", ()):
            changes[f"analyses.{name}.speeds"] = _few(own, OF_A_CHART)
    return rotordyn.vary(case, changes)


def _few(values: tuple[float, ...], most: int) -> tuple[float, ...]:
    if len(values) <= most:
        return values
    return tuple(values[round(k * (len(values) - 1) / (most - 1))] for k in range(most))
