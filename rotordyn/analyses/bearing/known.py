"""Values of a single bearing to compare with references."""

from __future__ import annotations

import numpy as np

from rotordyn.analyses.bearing.result import BearingMapResult
from rotordyn.analyses.bearing.solve import tangent_error
from rotordyn.arrays import Array
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle
from rotordyn.results.known import at_speeds


def known(reference: Reference, result: BearingMapResult, _: Spindle | None) -> Array | None:
    """Return the largest error of Kxx by the frozen tangent over the loads."""
    speeds = np.asarray(reference.speeds, float)
    if reference.quantity != "frozen_error" or not {"complete", "frozen"} <= set(result.tangent):
        return None
    largest = np.fmax.reduce(np.abs(tangent_error(result, "frozen", "x")), axis=1)
    return at_speeds(speeds, result.speed, largest)
