"""Every tangent of a solved state, the one that solves anew among them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearings.ball.law import check_name
from bearings.ring.data import Cause
from bearings.ring.frozen import alike
from bearings.ring.request import solved
from bearings.ring.state import BearingState

Array = NDArray[np.float64]
METHODS = ("complete", "frozen", "difference")
STEP = 1e-8  # m, of the central differences


def stiffness(state: BearingState, method: str = "complete") -> Array:
    """Tangent K = ∂load/∂displacement of a state (…, 5, 5) by one of three methods.

    ``"complete"`` and ``"frozen"`` as in ``BearingState.stiffness``; ``"difference"``: five-point
    differences of the whole displacement solve, the check of the others.

    Raises
    ------
    InvalidBearing : an unknown method
    """
    check_name("stiffness method", method, METHODS)
    return _difference(state) if method == "difference" else state.stiffness(method)


def _difference(state: BearingState) -> Array:
    """Tangent by five-point differences of the displacement solve (…, 5, 5)."""
    cause = state.cause
    radius = cause.geometry.centre_radius
    step = STEP * np.diag([1.0, 1.0, 1.0, 1.0 / radius, 1.0 / radius])
    known = state.outcome == ""
    middle = np.where(known[..., None], state.displacement, 0.0)
    moved = [middle[..., None, :] + k * step for k in (1.0, -1.0, 2.0, -2.0)]
    asked = cause.question.at(np.stack(moved))
    load = solved(Cause(cause.grooves, cause.law, asked)).load
    slope = (8.0 * (load[0] - load[1]) - (load[2] - load[3])) / (12.0 * np.diag(step)[:, None])
    return alike(state, np.where(known[..., None, None], slope.swapaxes(-1, -2), np.nan))
