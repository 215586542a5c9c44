"""A ring that few balls hold can move without any change of load, until another ball takes part.

Two loaded balls hold four of the five freedoms. Where the load of a third fades while a state is
followed, nothing resists the fifth: all positions up to where the next ball is touched, or this one
from its other side, balance the same load, and the path goes on from there.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearings.ball.balance import Balance
from bearings.geometry import Geometry
from bearings.ring.problem import Problem

Array = NDArray[np.float64]
FADING = 1e-2  # of the largest inner load: less will be gone at the next stride
TOUCHING = 1e-3  # of the largest inner load: what the ball that takes over is pressed with
HELD = 1e-9  # of the largest singular value: less is no hold


def beyond(problem: Problem, d: Array, x: Array, balance: Balance) -> Array | None:
    """d (5,) of one state moved to where the next ball takes part; None where the ring is held.

    ``d`` (5,), ``x`` (2, n); ``balance`` of that state alone.
    """
    if not problem.geometry.single:  # a groove off the middle moves with the tilt, too
        return None
    load = balance.inner_load[0]
    carrying = load > FADING * load.max(initial=0.0)
    way = _unheld(problem, carrying)
    if way is None:
        return None
    c, a = problem.geometry, problem.centres(d[None])[:2, 0]
    moving = problem.ring.moved(way[None])[:2, 0]
    fading = np.flatnonzero((load > 0.0) & ~carrying)
    if fading.size:
        gap = a[:, fading] - x[:, fading]
        if float((gap * moving[:, fading]).sum()) > 0.0:
            way, moving = -way, -moving
    idle = np.flatnonzero(~carrying)  # what fades may be met again, from the other side
    pressed = (TOUCHING * load.max() / c.inner.stiffness) ** (2.0 / 3.0)
    travel = _touch(c, a[:, idle] - x[:, idle], moving[:, idle], pressed)
    if not np.isfinite(travel).any():
        return None
    return np.asarray(d + travel.min() * way)


def _unheld(problem: Problem, carrying: NDArray[np.bool_]) -> Array | None:
    """The one direction (5,) in which the carrying balls do not move; None if there is none."""
    scale = problem.scale[problem.free]
    if not scale.size:
        return None
    rows = problem.ring.spread[:2, problem.free][..., carrying] / scale[:, None]
    rows = rows.transpose(0, 2, 1).reshape(-1, len(scale))
    _, size, right = np.linalg.svd(np.vstack([rows, np.zeros((1, len(scale)))]))
    if len(size) < len(scale):
        return None
    unheld = size <= HELD * size[0]
    if unheld.sum() != 1:
        return None
    way = np.zeros(5)
    way[problem.free] = right[-1] / scale
    return way


def _touch(c: Geometry, gap: Array, moving: Array, pressed: float) -> Array:
    """Way (k,) after which idle balls are pressed in by ``pressed``; infinite if never.

    ``gap`` (2, k) from the ball centre to the inner groove centre, ``moving`` its change.
    """
    square = (moving * moving).sum(axis=0)
    line = (gap * moving).sum(axis=0)
    short = (c.inner_reach + pressed) ** 2 - (gap * gap).sum(axis=0)
    root = line * line + square * short
    possible = (root > 0.0) & (square > 0.0) & (short > 0.0)
    way = (np.sqrt(np.maximum(root, 0.0)) - line) / np.where(square > 0.0, square, 1.0)
    return np.where(possible, way, np.inf)
