"""Tangents of a solved state beside the complete one: by frozen dynamics and by differences."""

from __future__ import annotations

import numpy as np

from bearings.arguments import checked
from bearings.arrays import Array
from bearings.ball.law import check_name
from bearings.ring.assembly import full_assembly
from bearings.ring.linearised import linearise, tangent
from bearings.ring.problem import Problem, turns
from bearings.ring.request import solved
from bearings.ring.state import BearingState

METHODS = ("complete", "frozen", "difference")
STEP = 1e-8  # m, of the central differences

QUARTER_TURN = np.array(  # of (x, y, z, θy, θz) about x
    [[1, 0, 0, 0, 0], [0, 0, 1, 0, 0], [0, -1, 0, 0, 0], [0, 0, 0, 0, 1], [0, 0, 0, -1, 0]]
)
COUPLED = np.array(  # x alone, y with θz, z with θy
    [[1, 0, 0, 0, 0], [0, 1, 0, 0, 1], [0, 0, 1, 1, 0], [0, 0, 1, 1, 0], [0, 1, 0, 0, 1]]
)


@checked
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
    operation = state.operation
    radius = operation.geometry.centre_radius
    step = STEP * np.diag([1.0, 1.0, 1.0, 1.0 / radius, 1.0 / radius])
    known = state.outcome == ""
    middle = np.where(known[..., None], state.displacement, 0.0)
    moved = [middle[..., None, :] + k * step for k in (1.0, -1.0, 2.0, -2.0)]
    load = solved(operation.at(np.stack(moved))).load
    slope = (8.0 * (load[0] - load[1]) - (load[2] - load[3])) / (12.0 * np.diag(step)[:, None])
    return alike(state, np.where(known[..., None, None], slope.swapaxes(-1, -2), np.nan))


def frozen_stiffness(state: BearingState) -> Array:
    """Tangent with centrifugal force and gyroscopic moment kept as they are (…, 5, 5).

    Cao & Altintas, J. Mech. Des. 126 (2004) 1089. At rest, and with the ``dynamics`` of that name,
    it is the complete one.
    """
    operation = state.operation
    speed = state.speed.reshape(-1)
    good = turns(operation.geometry, speed) & (state.outcome.reshape(-1) == "")
    turning = np.flatnonzero(good)
    if not turning.size or operation.law.dynamics == "frozen":
        return state.complete_stiffness
    part = Problem.of(operation, full_assembly).take(turning)
    d = state.displacement.reshape(-1, 5)[turning]
    x = state.ball_centre.reshape(2, len(speed), -1)[:, turning]
    frozen = linearise(part, d, x, np.ones(turning.size), vary=0.0)
    stiffness = state.complete_stiffness.reshape(-1, 5, 5).copy()
    stiffness[turning] = tangent(part, frozen.balls)
    return alike(state, stiffness.reshape(state.complete_stiffness.shape))


def alike(state: BearingState, stiffness: Array) -> Array:
    """Rounding removed where a state is axial: its planes answer alike and do not couple."""
    axial = ((state.load == 0.0) & (state.displacement == 0.0))[..., 1:].all(axis=-1)
    turned = QUARTER_TURN @ stiffness @ QUARTER_TURN.T
    exact = np.where(COUPLED, 0.5 * (stiffness + turned), 0.0)
    return np.where(axial[..., None, None], exact, stiffness)
