"""Published and measured values beside what was computed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from rotordyn.analyses.bearing.known import frozen_error
from rotordyn.analyses.campbell.known import MODES, known_frequencies
from rotordyn.analyses.preload.known import preload_sum
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle
from rotordyn.results.kinds import Array
from rotordyn.results.known import Match, at_speeds, column


def matches(
    references: Sequence[Reference], results: Mapping[str, Any], spindle: Spindle | None
) -> list[Match]:
    """Every reference, at the speeds for which the results hold something to put beside it."""
    found = []
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
        found.append(Match(known, tuple(float(values[k]) for k in kept)))
    return found


def _computed(
    reference: Reference, results: Mapping[str, Any], spindle: Spindle | None
) -> Array | None:
    """Our value for every value of the reference, NaN outside the speeds computed."""
    speeds, subject = np.asarray(reference.speeds, float), reference.subject
    preload = results.get("preload")
    match reference.quantity:
        case quantity if quantity in COLUMNS and COLUMNS[quantity][0] in results:
            analysis, name, dim, usual = COLUMNS[quantity]
            return column(speeds, results[analysis], name, dim, subject or usual)
        case "preload_sum" if preload is not None and spindle is not None:
            return at_speeds(speeds, preload.speed, preload_sum(preload, spindle))
        case quantity if quantity in MODES and "campbell" in results:
            return known_frequencies(results["campbell"], reference)
        case "frozen_error" if "bearing" in results:
            return frozen_error(results["bearing"], speeds)
    return None


# Quantities that are columns of a result: analysis, field, dimension of the subject, usual subject.
COLUMNS = {
    "radial_stiffness": ("stiffness", "tangent", "variant", "nonlinear"),
    "sleeve_displacement": ("preload", "position", "body", ""),
    "required_diameter": ("section_forces", "required_diameter", "twist_limit", ""),
}
