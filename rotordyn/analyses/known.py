"""Published and measured values beside what was computed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from rotordyn.analyses.registry import analysis
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle
from rotordyn.results.kinds import Array
from rotordyn.results.known import Match


def matches(
    references: Sequence[Reference], results: Mapping[str, Any], spindle: Spindle | None
) -> list[Match]:
    """Every reference, at the speeds for which the results hold something to put beside it."""
    matched = []
    for reference in dict.fromkeys(references):
        values = _computed(reference, results, spindle)
        if values is None or not np.isfinite(values).any():
            continue
        kept = np.flatnonzero(np.isfinite(values))
        known = replace(
            reference,
            speeds=tuple(reference.speeds[k] for k in kept),
            values=tuple(reference.values[k] for k in kept),
        )
        matched.append(Match(known, tuple(float(values[k]) for k in kept)))
    return matched


def _computed(
    reference: Reference, results: Mapping[str, Any], spindle: Spindle | None
) -> Array | None:
    """Our value for every value of the reference, NaN outside the speeds computed."""
    for name, result in results.items():
        known = analysis(name).known
        values: Array | None = None if known is None else known(reference, result, spindle)
        if values is not None:
            return values
    return None
