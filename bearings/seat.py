"""Many balls settled at once under a fixed push: the inner stage of the convex problem."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearings.constants import BallConstants
from bearings.convex import first_seat, improves, seat_step, riding_radius
from bearings.plane import direction

Array = NDArray[np.float64]
ITERATIONS = 80
HALVINGS = 50


def seat(c: BallConstants, centre: Array, push: Array, start: Array | None = None) -> Array:
    """Ball centre X (2, …) of least potential under ``push`` Fc > 0 (…) [N].

    ``start``: a ball centre for a nearby A. A ball that the inner race does not reach rides the
    outer race.
    """
    shape = centre.shape
    a, fc = centre.reshape(2, -1), np.broadcast_to(push, shape[1:]).reshape(-1)
    riding = riding_radius(c, fc)
    free = direction((a[0], a[1] - riding))[2] <= c.inner_reach
    first = np.stack(first_seat(c, (a[0], a[1]), fc))
    x = first if start is None else start.reshape(2, -1).copy()
    x = np.where(np.hypot(*x) > c.outer_reach, x, first)
    x[:, free] = 0.0
    x[1, free] = riding[free]
    todo = np.flatnonzero(~free)
    for _ in range(ITERATIONS):
        if not todo.size:
            break
        x[:, todo], moving = _improved(c, a[:, todo], fc[todo], x[:, todo])
        todo = todo[moving]
    return x.reshape(shape)


def _improved(
    c: BallConstants, a: Array, fc: Array, x: Array
) -> tuple[Array, NDArray[np.bool_]]:
    """One Newton step, each ball with its own length; also which balls are still moving."""
    centre = (a[0], a[1])
    now = seat_step(c, centre, (x[0], x[1]), fc)
    step, moving = np.stack(now.step), now.moving
    length = np.ones_like(fc)
    for _ in range(HALVINGS):
        trial = x + length * step
        good = improves(c, centre, (trial[0], trial[1]), fc, now) | ~moving
        if good.all():
            break
        length = np.where(good, length, 0.5 * length)
    return np.where(moving, trial, x), moving
