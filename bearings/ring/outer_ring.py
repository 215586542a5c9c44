"""What the balls of a solved state put on the outer ring."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearings.ball.kinematics import SHARINGS
from bearings.geometry import geometry
from bearings.ring.contact_motion import race_weight
from bearings.ring.state import BearingState
from bearings.ring.sums import full_ring

Array = NDArray[np.float64]


def outer_ring_load(state: BearingState) -> Array:
    """(Fx, Fy, Fz, My, Mz) of the balls on the outer ring (…, 5) [N, N·m].

    Per ball fa = Qo sin αo + λo (Mg/D) cos αo, fr = Qo cos αo − λo (Mg/D) sin αo and
    m = Ro fa + λo fo Mg about the centre of the circle of outer groove centres, of radius
    Ro = dm/2 − (fo − ½) D cos α.
    """
    g = geometry(state.cause.grooves)
    share = 2.0 - SHARINGS[state.cause.law.moment_sharing](race_weight(state))[0]
    moment = share * state.gyroscopic_moment
    along, across = state.outer_load, moment / g.ball_diameter
    sin, cos = np.sin(state.outer_angle), np.cos(state.outer_angle)
    axial, radial = along * sin + across * cos, along * cos - across * sin
    tilting = g.outer_centre_radius * axial + g.outer_conformity * moment
    action = np.stack([axial, radial, tilting]).reshape(3, -1, g.balls)
    return full_ring(g).load(action).reshape(*state.outcome.shape, 5)
