"""Steady forced responses of an undamped machine."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from rotordyn.analyses.registry import analysis
from rotordyn.machine.plausibility import undamped
from rotordyn.machine.spindle import Spindle
from rotordyn.results.severity import Severity, of_severity


@of_severity(Severity.INVALID)
def unlimited(spindle: Spindle, analyses: Mapping[str, Any]) -> Iterator[str]:
    """A sentence where ``analyses`` ask for steady forced responses without any damping."""
    records = [(analysis(name), spec) for name, spec in analyses.items()]
    forced = [
        record.name for record, spec in records if record.forced and not record.over_time(spec)
    ]
    if forced and undamped(spindle):
        keys = "damping.rotor, " + "damping.bearings, " * bool(spindle.seats)
        yield (
            f"{' and '.join(forced)}: the machine is undamped, so that responses are unbounded at "
            f"its modes and their peaks mean nothing: give {keys}or damping of supports"
        )
