"""Tangents of a solved state by any method; by differences, which solve the bearing anew."""

from __future__ import annotations

import numpy as np

from bearings.arguments import checked
from bearings.arrays import Array
from bearings.ring.assembly import alike
from bearings.ring.request import solved
from bearings.ring.state import BearingState

STEP = 1e-8  # m, of the central differences
SAME = 1e-6  # relative difference of loads up to which two states are one


@checked
def stiffness(state: BearingState, method: str = "complete") -> Array:
    """Tangent K = ∂load/∂displacement of a state (…, 5, 5) by one of three methods.

    ``"complete"`` and ``"frozen"`` as in ``BearingState.stiffness``; ``"difference"``: five-point
    differences of the whole displacement solve, the check of the others; NaN where that solve
    leads to another state than this one (docs/theory/solving.md).

    Raises
    ------
    InvalidBearing : an unknown method
    """
    return _difference(state) if method == "difference" else state.stiffness(method)


def _difference(state: BearingState) -> Array:
    """Tangent by five-point differences of the displacement solve (…, 5, 5)."""
    operation = state.operation
    radius = operation.geometry.centre_radius
    step = STEP * np.diag([1.0, 1.0, 1.0, 1.0 / radius, 1.0 / radius])
    exists = state.outcome == ""
    middle = np.where(exists[..., None], state.displacement, 0.0)
    displaced = [middle[..., None, :] + k * step for k in (0.0, 1.0, -1.0, 2.0, -2.0)]
    load = solved(operation.at(np.stack(displaced))).load
    size = np.abs(state.load).max(axis=-1, keepdims=True)
    same = (np.abs(load[0, ..., 0, :] - state.load) <= SAME * size).all(axis=-1)
    slope = (8.0 * (load[1] - load[2]) - (load[3] - load[4])) / (12.0 * np.diag(step)[:, None])
    slope = np.where((exists & same)[..., None, None], slope.swapaxes(-1, -2), np.nan)
    return alike(state.load, state.displacement, slope)
