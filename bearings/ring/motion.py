"""Orbit, rolling and spin of the balls of a solved state."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bearings.arrays import Array
from bearings.ball.kinematics import orbit_and_spin

if TYPE_CHECKING:
    from bearings.ring.state import BearingState


class BallMotion(NamedTuple):
    """Motion of each ball (…, balls) over the speed ω of the inner ring, independent of ω.

    ``orbit`` ωm/ω; ``rotation`` |ωR/ω| of the ball against the cage; ``attitude`` β of its axis
    [rad], beyond π/2 where the ball turns backward about the axis of the bearing.
    """

    orbit: Array
    rotation: Array
    attitude: Array


class ContactMotion(NamedTuple):
    """Motion at each contact (…, balls, contacts) over ω; signs for a positive rotation.

    ``roll`` and ``spin``: relative rotation of ball and race along the tangent of the contact and
    along its normal; ``slide`` [m]: relative velocity at the middle of the contact over ω, 0 where
    a race has one contact; ``entrainment`` [m]: mean velocity of both surfaces past the contact
    over ω.
    """

    roll: Array
    spin: Array
    slide: Array
    entrainment: Array


def ball_motion(state: BearingState) -> BallMotion:
    """Compute orbit and rotation of the balls from the angles of the resultants on their races."""
    a = state.angles
    t = state.tan_beta
    orbit = np.asarray(orbit_and_spin(a, t)[0].value)
    total = (a.cos_o + t * a.sin_o) / (1.0 + a.gamma * a.cos_o)
    total = total + (a.cos_i + t * a.sin_i) / (1.0 - a.gamma * a.cos_i)
    rotation = np.sqrt(1.0 + t * t) / (a.gamma * np.abs(total))
    sign = np.sign(total)
    return BallMotion(orbit, np.asarray(rotation), np.arctan2(sign * t, sign))


def contact_motion(state: BearingState) -> ContactMotion:
    """Compute rolling, spin and sliding of every contact, at its own angle; NaN without load.

    In the frame of the cage the ball turns by ωR about (cos β, −sin β), axial and radial, the inner
    race by ω − ωm and the outer one by −ωm about the axis, both with their sign reversed.
    """
    g = state.operation.geometry
    motion = ball_motion(state)
    orbit, rotation = motion.orbit[..., None], motion.rotation[..., None]
    beta = motion.attitude[..., None]
    alpha = np.asarray(state.contact_angle) * g.sides  # as β: positive towards +x
    race = g.by_contact(1.0 - orbit, -orbit)  # about the axis, against the ball's rotation
    side = g.by_contact(-1.0, 1.0)
    sin, cos = np.sin(alpha), np.cos(alpha)
    half = 0.5 * g.ball_diameter
    ball_speed = rotation * np.cos(alpha - beta) * half
    race_speed = np.abs(race) * (0.5 * g.pitch_diameter + side * half * cos)
    single = g.by_contact(len(g.inner_grooves) == 1, len(g.outer_grooves) == 1)
    return ContactMotion(
        roll=rotation * np.cos(alpha - beta) + race * cos,
        spin=rotation * np.sin(alpha - beta) + race * sin,
        slide=np.where(single, 0.0, side * (ball_speed - race_speed)),
        entrainment=0.5 * np.abs(ball_speed + race_speed),
    )
