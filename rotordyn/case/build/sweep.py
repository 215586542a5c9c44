"""The values of a range or list."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rotordyn.case.schema.sweep import MAX_STEPS, FrequencyRange, SpeedRange


def values(entry: SpeedRange | FrequencyRange | Sequence[float]) -> tuple[float, ...]:
    """Values [SI], both ends met exactly; empty where the entry is incomplete."""
    if not isinstance(entry, SpeedRange | FrequencyRange):
        return tuple(entry)
    intervals = _intervals(entry)
    if intervals < 1:
        return ()
    span = entry.to - entry.start
    return (*(entry.start + span * n / intervals for n in range(intervals)), entry.to)


def _intervals(entry: SpeedRange | FrequencyRange) -> int:
    if entry.count is not None:
        return entry.count - 1
    if entry.step is None or entry.step == 0.0:
        return 0
    ratio = (entry.to - entry.start) / entry.step
    return round(ratio) if math.isfinite(ratio) and ratio <= MAX_STEPS else 0
