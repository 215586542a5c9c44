"""One ball settled under a fixed push: the inner stage of the convex problem."""

from __future__ import annotations

from bearings.ball.plane import Motion, Pair
from bearings.ball.potential import (
    contacts,
    depth,
    first_seat,
    improves,
    riding_radius,
    seat_step,
)
from bearings.geometry import Geometry
from bearings.ring.seat import ITERATIONS


def seat(c: Geometry, centre: Motion, push: float, start: Pair) -> Pair:
    """X of least potential, see ``bearings.ring.seat``."""
    riding = riding_radius(c, push)
    if len(c.outer_grooves) == 1 and contacts(c, centre, (0.0, riding))[0].energy == 0.0:
        return 0.0, riding
    first = first_seat(c, centre, push)
    x = (first[0] + 0.0, first[1] + 0.0)
    now, length = seat_step(c, centre, x, push), 1.0
    if depth(c.outer_grooves, start) > 0.0:
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
