"""The tangent with centrifugal force and gyroscopic moment kept as they are."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearings.ball.balance import settled, turning_balance
from bearings.ring.data import StateData
from bearings.ring.linearised import tangent
from bearings.ring.problem import Problem, turns
from bearings.ring.sums import full_ring

Array = NDArray[np.float64]
QUARTER_TURN = np.array(  # of (x, y, z, θy, θz) about x
    [[1, 0, 0, 0, 0], [0, 0, 1, 0, 0], [0, -1, 0, 0, 0], [0, 0, 0, 0, 1], [0, 0, 0, -1, 0]]
)
COUPLED = np.array(  # x alone, y with θz, z with θy
    [[1, 0, 0, 0, 0], [0, 1, 0, 0, 1], [0, 0, 1, 1, 0], [0, 0, 1, 1, 0], [0, 1, 0, 0, 1]]
)


def frozen_stiffness(state: StateData) -> Array:
    """Tangent with centrifugal force and gyroscopic moment kept as they are (…, 5, 5).

    Cao & Altintas, J. Mech. Des. 126 (2004) 1089. At rest, and with the ``dynamics`` of that name,
    it is the complete one.
    """
    cause = state.cause
    speed = state.speed.reshape(-1)
    good = turns(cause.geometry, speed) & (state.outcome.reshape(-1) == "")
    turning = np.flatnonzero(good)
    if not turning.size or cause.law.dynamics == "frozen":
        return state.complete_stiffness
    part = Problem.of(cause, full_ring).take(turning)
    a = part.centres(state.displacement.reshape(-1, 5)[turning])
    x = state.ball_centre.reshape(2, len(speed), -1)[:, turning]
    squared = part.speed[:, None] ** 2
    centre, ball = tuple(a), (x[0], x[1])
    balance = turning_balance(cause.geometry, cause.law.numbers, centre, ball, squared, 1.0, 0.0)
    stiffness = state.complete_stiffness.reshape(-1, 5, 5).copy()
    stiffness[turning] = tangent(part, settled(balance))
    return alike(state, stiffness.reshape(state.complete_stiffness.shape))


def alike(state: StateData, stiffness: Array) -> Array:
    """Rounding removed where a state is axial: its planes answer alike and do not couple."""
    axial = ((state.load == 0.0) & (state.displacement == 0.0))[..., 1:].all(axis=-1)
    turned = QUARTER_TURN @ stiffness @ QUARTER_TURN.T
    exact = np.where(COUPLED, 0.5 * (stiffness + turned), 0.0)
    return np.where(axial[..., None, None], exact, stiffness)
