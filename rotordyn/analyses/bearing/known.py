"""What may be compared of a single bearing."""

from __future__ import annotations

import numpy as np

from rotordyn.analyses.bearing.result import BearingMapResult
from rotordyn.analyses.bearing.solve import tangent_error
from rotordyn.results.kinds import Array
from rotordyn.results.known import at_speeds


def frozen_error(result: BearingMapResult, speeds: Array) -> Array | None:
    """Largest error of Kxx by the frozen tangent over the loads."""
    if not {"complete", "frozen"} <= set(result.tangent):
        return None
    largest = np.fmax.reduce(np.abs(tangent_error(result, "frozen", "x")), axis=1)
    return at_speeds(speeds, result.speed, largest)
