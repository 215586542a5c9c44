"""A ball at rest between one groove a ring: contacts in series, its centre eliminated."""

from __future__ import annotations

import numpy as np

from bearings.ball.balance import Balance, Settled
from bearings.ball.plane import Motion, direction
from bearings.ball.potential import resting_reaction
from bearings.geometry import Geometry


def resting_balance(c: Geometry, centre: Motion) -> tuple[Balance, Settled]:
    """Balance of balls at rest, and the same with the balls eliminated; no ball unknown is left."""
    answer = resting_reaction(c, centre)
    sin, cos, _ = direction((centre[0], centre[1]))
    load = np.hypot(answer.action[0], answer.action[1])
    zero = np.zeros_like(load)
    nothing = (zero, zero)
    balance = Balance(
        residual=nothing,
        residual_by_ball=((zero + 1.0, zero), (zero, zero + 1.0)),
        residual_by_centre=(nothing, nothing),
        action=answer.action,
        action_by_ball=(nothing, nothing, nothing),
        action_by_centre=answer.slope,
        inner_load=load,
        outer_load=load,
        inner_direction=(sin, cos),
        outer_direction=(sin, cos),
        centrifugal_force=zero,
        gyroscopic_moment=zero,
        inner_share=zero + 1.0,
    )
    return balance, Settled(zero + 1.0, nothing, (nothing, nothing), answer.action, answer.slope)
