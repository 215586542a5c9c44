"""A ball at rest: both contacts act in series, the ball centre is eliminated in closed form."""

from __future__ import annotations

import numpy as np

from bearings.ball.balance import Balance, Settled
from bearings.ball.constants import BallConstants
from bearings.ball.plane import Pair, direction
from bearings.ball.potential import resting_reaction


def resting_balance(c: BallConstants, centre: Pair) -> tuple[Balance, Settled]:
    """Balance of balls at rest, and the same with the balls eliminated; no ball unknown is left."""
    answer = resting_reaction(c, centre)
    sin, cos, _ = direction(centre)
    load = np.hypot(*answer.force)
    zero = np.zeros_like(load)
    nothing = (zero, zero)
    axial, radial = answer.force
    by_axial, by_radial = answer.slope
    action = (axial, radial, c.centre_radius * axial)
    tangent = (by_axial, by_radial, (c.centre_radius * by_axial[0], c.centre_radius * by_axial[1]))
    balance = Balance(
        residual=nothing,
        residual_by_ball=((zero + 1.0, zero), (zero, zero + 1.0)),
        residual_by_centre=(nothing, nothing),
        action=action,
        action_by_ball=(nothing, nothing, nothing),
        action_by_centre=tangent,
        inner_load=load,
        outer_load=load,
        inner_direction=(sin, cos),
        outer_direction=(sin, cos),
        centrifugal_force=zero,
        gyroscopic_moment=zero,
        inner_share=zero + 1.0,
    )
    return balance, Settled(zero + 1.0, nothing, (nothing, nothing), action, tangent)
