"""What may be compared of the preload state."""

from __future__ import annotations

import numpy as np

from rotordyn.analyses.preload.result import PreloadResult
from rotordyn.machine.spindle import Spindle
from rotordyn.results.kinds import Array


def preload_sum(result: PreloadResult, spindle: Spindle) -> Array:
    """Axial load [N] that the sleeves carry together, shape (speed,).

    Without sleeves: half the sum over all bearings, which is the load of either direction.
    """
    carried = {name for sleeve in spindle.sleeves for name in sleeve.bearings}
    if not carried:
        return np.asarray(np.abs(result.axial_load).sum(axis=1) / 2.0)
    chosen = [result.bearing.index(name) for name in result.bearing if name in carried]
    return np.asarray(result.axial_load[:, chosen].sum(axis=1))
