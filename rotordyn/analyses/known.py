"""Published and measured values beside computed ones."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from rotordyn.analyses.registry import analysis
from rotordyn.arrays import Array
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle
from rotordyn.results.known import Match


def matches(
    references: Sequence[Reference], results: Mapping[str, Any], spindle: Spindle | None
) -> list[Match]:
    """References with computed values beside them, at the speeds at which there are any."""
    matched = []
    for reference in dict.fromkeys(references):
        values = _computed(reference, results, spindle)
        if values is None or not np.isfinite(values).any():
            continue
        finite = np.flatnonzero(np.isfinite(values))
        compared = replace(
            reference,
            speeds=tuple(reference.speeds[k] for k in finite),
            values=tuple(reference.values[k] for k in finite),
        )
        matched.append(Match(compared, tuple(float(values[k]) for k in finite)))
    return matched


def _computed(
    reference: Reference, results: Mapping[str, Any], spindle: Spindle | None
) -> Array | None:
    """Computed value for every value of a reference, NaN at speeds without one; None for none."""
    for name, result in results.items():
        known = analysis(name).known
        values: Array | None = None if known is None else known(reference, result, spindle)
        if values is not None:
            return values
    return None
