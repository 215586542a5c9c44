"""Required diameters for comparison with references."""

from __future__ import annotations

import numpy as np

from rotordyn.analyses.section_forces.result import SectionForcesResult
from rotordyn.arrays import Array
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle
from rotordyn.results.known import column


def known(reference: Reference, result: SectionForcesResult, _: Spindle | None) -> Array | None:
    """Computed values at the speeds of a reference, NaN without one; None for other quantities."""
    if reference.quantity != "required_diameter":
        return None
    speeds = np.asarray(reference.speeds, float)
    return column(speeds, result, "required_diameter", "twist_limit", reference.subject)
