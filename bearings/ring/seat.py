"""Many balls settled at once under a fixed push: the inner stage of the convex problem."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings.ball.potential import (
    SeatStep,
    contacts,
    depth,
    first_seat,
    improves,
    potential,
    riding_radius,
    seat_step,
)
from bearings.geometry import Geometry

Array = NDArray[np.float64]
Index = NDArray[np.intp]
ITERATIONS = 200


def seat(c: Geometry, centre: Array, push: Array, start: Array | None = None) -> Array:
    """Ball centre X (2, …) of least potential under ``push`` Fc ≥ 0 (…) [N], at A (m, …).

    ``start``: a ball centre for a nearby A. A ball that the inner race does not reach rides the
    outer race. Every ball takes Newton steps of its own length, halved where the potential rises.
    """
    shape = centre.shape[1:]
    a, fc = centre.reshape(len(centre), -1), np.broadcast_to(push, shape).reshape(-1)
    x, free = _first(c, a, fc, start), np.zeros(a.shape[1], dtype=bool)
    if len(c.outer_grooves) == 1:
        riding = riding_radius(c, fc)
        free = contacts(c, tuple(a), (0.0 * riding, riding))[0].energy == 0.0
        x[:, free] = 0.0
        x[1, free] = riding[free]
    now = _step(c, a, fc, x)
    todo = np.flatnonzero(now.moving & ~free)
    now, length = _some(now, todo), np.ones(todo.size)
    for _ in range(ITERATIONS):
        if not todo.size:
            break
        trial = x[:, todo] + length * np.stack(now.step)
        then = _step(c, a[:, todo], fc[todo], trial)
        good = improves(now, then)
        x[:, todo[good]] = trial[:, good]
        length = np.where(good, 1.0, 0.5 * length)
        if not good.all():
            then = _either(good, then, now)
        going = np.flatnonzero(then.moving)
        todo, now, length = todo[going], _some(then, going), length[going]
    return x.reshape(2, *shape)


def _first(c: Geometry, a: Array, fc: Array, start: Array | None) -> Array:
    """Ball centres to start from, pressed into the outer race."""
    first = np.stack(first_seat(c, tuple(a), fc))
    if start is None:
        return first
    given = start.reshape(2, -1)
    better = _energy(c, a, fc, given) < _energy(c, a, fc, first)
    return np.where(better & (depth(c.outer_grooves, (given[0], given[1])) > 0.0), given, first)


def _step(c: Geometry, a: Array, fc: Array, x: Array) -> SeatStep:
    return seat_step(c, tuple(a), (x[0], x[1]), fc)


def _energy(c: Geometry, a: Array, fc: Array, x: Array) -> Array:
    ball = (x[0], x[1])
    return np.asarray(potential(c, *contacts(c, tuple(a), ball), ball, fc))


def _some(steps: SeatStep, index: Index) -> SeatStep:
    """The steps of some balls."""
    parts: Any = (np.asarray(part)[..., index] for part in steps)
    return SeatStep(*parts)


def _either(choice: NDArray[np.bool_], yes: SeatStep, no: SeatStep) -> SeatStep:
    """The steps of some balls from one set, of the others from another."""
    parts: Any = (np.where(choice, *pair) for pair in zip(yes, no, strict=True))
    return SeatStep(*parts)
