"""Frequencies of bearing defects, per revolution of the inner ring, with the outer ring at rest.

From the true orbital speed ωm and rotation ωR of the balls of a state, or nominal ones.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bearings.arguments import checked
from bearings.arrays import Array
from bearings.life.rating import nominal_angle
from bearings.ring.motion import ball_motion

if TYPE_CHECKING:
    from bearings.bearing import BallBearing
    from bearings.ring.state import BearingState


class Frequencies(NamedTuple):
    """Defect frequencies per revolution of the inner ring, shape (…); times ω/2π in [Hz].

    ``cage``: FTF, ωm/ω; ``outer`` and ``inner``: BPFO and BPFI, balls past a point of the ring;
    ``ball``: BSF, turns of a ball against the cage, whose defect strikes twice (some print that);
    ``spread``: largest less smallest ωm/ω of the balls, which differ under a radial load.
    """

    cage: Array
    outer: Array
    inner: Array
    ball: Array
    spread: Array


@checked
def frequencies(state: BearingState) -> Frequencies:
    """Defect frequencies of a state, means over the balls weighted by their inner loads; NaN where
    the inner race drives none."""
    motion, driven, load = ball_motion(state), state.driven, np.asarray(state.inner_load)
    count, total_load = driven.sum(axis=-1), load.sum(axis=-1)

    def mean(values: Array) -> Array:
        total = np.where(load > 0.0, load * values, 0.0).sum(axis=-1)
        return np.asarray(np.where(count > 0, total / np.where(count > 0, total_load, 1.0), np.nan))

    cage, balls = mean(motion.orbit), state.operation.grooves.balls
    high = np.where(driven, motion.orbit, -np.inf).max(axis=-1)
    low = np.where(driven, motion.orbit, np.inf).min(axis=-1)
    with np.errstate(invalid="ignore"):
        spread = np.where(count > 0, high - low, np.nan)
    return Frequencies(cage, balls * cage, balls * (1.0 - cage), mean(motion.rotation), spread)


@checked
def nominal_frequencies(bearing: BallBearing, contact_angle: float | None = None) -> Frequencies:
    """Defect frequencies for equal angles on both races, the nominal or ``contact_angle`` [rad]."""
    alpha = nominal_angle(bearing.grooves) if contact_angle is None else contact_angle
    ratio = bearing.ball_diameter / bearing.pitch_diameter
    gamma = ratio * math.cos(alpha)
    values = (
        0.5 * (1.0 - gamma),
        0.5 * bearing.balls * (1.0 - gamma),
        0.5 * bearing.balls * (1.0 + gamma),
        (1.0 - gamma**2) / (2.0 * ratio),
        0.0,
    )
    return Frequencies(*(np.asarray(value) for value in values))
