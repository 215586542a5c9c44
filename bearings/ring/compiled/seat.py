"""One ball settled under a fixed push."""

from __future__ import annotations

from bearings.ball.constants import BallConstants
from bearings.ball.plane import Pair, direction
from bearings.ball.potential import first_seat, improves, riding_radius, seat_step

ITERATIONS = 200


def seat(c: BallConstants, centre: Pair, start: Pair, push: float) -> Pair:
    """X of least potential, see ``bearings.ring.seat``."""
    riding = riding_radius(c, push)
    if direction((centre[0], centre[1] - riding))[2] <= c.inner_reach:
        return 0.0, riding
    first = first_seat(c, centre, push)
    x = (first[0] + 0.0, first[1] + 0.0)
    now, length = seat_step(c, centre, x, push), 1.0
    if direction(start)[2] > c.outer_reach:
        given = seat_step(c, centre, start, push)
        if given.energy < now.energy:
            x, now = start, given
    for _ in range(ITERATIONS):
        if not now.moving:
            break
        trial = (x[0] + length * now.step[0], x[1] + length * now.step[1])
        then = seat_step(c, centre, trial, push)
        if improves(now, then):
            x, now, length = trial, then, 1.0
        else:
            length *= 0.5
    return x
