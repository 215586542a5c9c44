"""The balls of a state, checked by equations written separately from the solver.

Four equations per ball, in values of the state itself: the equilibrium of the contact loads at the
contact angles with Fc and Mg from both, and the two components of the geometry: the segments from
the outer groove centre by the ball to the inner one close, with the approaches of Hertz's law under
the loads. The forces are scaled by the largest ball load, the gap by the distance of the free
groove centres. Nothing here is a small difference of lengths.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearings.ring.state import BearingState
from tests.oracles.ball_equations import Balls

Array = NDArray[np.float64]
UNEQUAL = 1e-9  # of the largest load: a larger residual is wrong
OPEN = (
    1e-12  # of the groove distance: a few thousand roundings; 1e-9 would hide much of a light load
)


class Judged(NamedTuple):
    """``fault`` (2, …, n) [N], ``gap`` (…, n) over the groove distance, ``action`` (3, …, n)."""

    fault: Array
    gap: Array
    action: Array


def judged(balls: Balls, state: BearingState, good: NDArray[np.intp], centre: Array) -> Judged:
    """The solved states ``good`` (s,) with their inner groove centres (2, s, n)."""
    n, speed = centre.shape[-1], state.speed[good, None]
    qi, qo = state.inner_load[good, :n], state.outer_load[good, :n]
    ai, ao = state.inner_angle[good, :n], state.outer_angle[good, :n]
    di, do = (qi / balls.inner.k) ** (2.0 / 3.0), (qo / balls.outer.k) ** (2.0 / 3.0)
    fault, action = balls.forces(balls.at(ai, ao, di, do, speed))
    ball = (balls.lo + do) * np.array([np.sin(ao), np.cos(ao)])
    rest = centre - ball
    reach = np.where(qi > 0.0, balls.li + di, np.minimum(np.hypot(*rest), balls.li))
    gap = np.hypot(*(rest - reach * np.array([np.sin(ai), np.cos(ai)])))
    moved = np.hypot(*(ball - state.ball_centre[:, good, :n])) * (speed > 0.0)
    idle = (qo == 0.0) & (speed == 0.0)  # has no place
    free = balls.li + balls.lo
    apart = np.where(idle, np.maximum(np.hypot(*centre) - free, 0.0), np.maximum(gap, moved))
    return Judged(np.where(idle, 0.0, fault), apart / free, np.where(idle, 0.0, action))
