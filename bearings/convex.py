"""The convex core of the ball problem: two Hertzian contacts and a fixed centrifugal push.

Σ 0.4 k δ₊^2.5 − Fc X₂ has one minimum over the ball centre X for every inner groove centre A, and
what is left is convex in A: a bearing assembled from it has one equilibrium, reachable from
anywhere. At rest (no push) X is eliminated in closed form. Arrays are component-first as in
``bearings.ball``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearings.geometry import Geometry

Array = NDArray[np.float64]
ITERATIONS = 80
TOLERANCE = 1e-12  # of the ball's own loads
EPS = float(np.finfo(float).eps)


class Reaction(NamedTuple):
    """What a settled ball does to the inner ring at A: potential, force (2, …), slope (2, 2, …)."""

    energy: Array
    force: Array
    slope: Array


def seat(g: Geometry, centre: Array, push: Array, start: Array | None = None) -> Array:
    """Ball centre X (2, …) of least potential under ``push`` Fc > 0 (…) [N].

    ``start``: a ball centre for a nearby A. A ball that the inner race does not reach rides the
    outer race.
    """
    shape = centre.shape
    a, fc = centre.reshape(2, -1), np.broadcast_to(push, shape[1:]).reshape(-1)
    riding = np.stack([np.zeros_like(fc), g.outer_reach + (fc / g.outer.stiffness) ** (2.0 / 3.0)])
    free = np.hypot(*(a - riding)) <= g.inner_reach
    x = np.where(free, riding, _first(g, a, riding) if start is None else start.reshape(2, -1))
    x = np.where(np.hypot(*x) > g.outer_reach, x, _first(g, a, riding))
    todo = np.flatnonzero(~free)
    for _ in range(ITERATIONS):
        if not todo.size:
            break
        x[:, todo], moving = _improved(g, a[:, todo], fc[todo], x[:, todo])
        todo = todo[moving]
    return x.reshape(shape)


def reaction(g: Geometry, centre: Array, ball: Array, push: Array) -> Reaction:
    """Force and tangent of a ball that sits at its seat."""
    inner, outer = _contact(g.inner.stiffness, g.inner_reach, centre - ball), _outer(g, ball)
    both = inner.slope + outer.slope
    inverse = _inverse(both)
    follow = np.einsum("ab...,bc...->ac...", inverse, inner.slope)
    slope = inner.slope - np.einsum("ab...,bc...->ac...", inner.slope, follow)
    return Reaction(_energy(g, centre, ball, push), inner.force, slope)


def resting_seat(g: Geometry, centre: Array) -> Array:
    """Ball centre at rest: on the line of the groove centres; without load, on the outer race."""
    length = np.hypot(centre[0], centre[1])
    load = g.series_stiffness * np.maximum(length - g.free_distance, 0.0) ** 1.5
    return centre / length * (g.outer_reach + (load / g.outer.stiffness) ** (2.0 / 3.0))


def resting_reaction(g: Geometry, centre: Array) -> Reaction:
    """Force and tangent of a ball at rest: Q = kn (|A| − BD)₊^1.5 along A."""
    return _contact(g.series_stiffness, g.free_distance, centre)


def _contact(stiffness: float, reach: float, vector: Array) -> Reaction:
    """A spring k δ₊^1.5 along ``vector``, free up to the length ``reach``."""
    length = np.hypot(vector[0], vector[1])
    unit = vector / length
    approach = np.maximum(length - reach, 0.0)
    root = np.sqrt(approach)
    load, along = stiffness * approach * root, 1.5 * stiffness * root
    across = load / length
    outer = unit[:, None] * unit[None, :]
    slope = (along - across) * outer
    slope[0, 0] += across
    slope[1, 1] += across
    return Reaction(0.4 * load * approach, load * unit, slope)


def _outer(g: Geometry, ball: Array) -> Reaction:
    return _contact(g.outer.stiffness, g.outer_reach, ball)


def _energy(g: Geometry, centre: Array, ball: Array, push: Array) -> Array:
    """Potential of one ball; the push counts from the free outer race."""
    inner = np.maximum(np.hypot(*(centre - ball)) - g.inner_reach, 0.0)
    outer = np.maximum(np.hypot(*ball) - g.outer_reach, 0.0)
    springs = 0.4 * (g.inner.stiffness * inner**2.5 + g.outer.stiffness * outer**2.5)
    return np.asarray(springs - push * (ball[1] - g.outer_reach))


def _first(g: Geometry, centre: Array, riding: Array) -> Array:
    """As at rest where the grooves press the ball, else where it rides the outer race."""
    pressed = np.hypot(centre[0], centre[1]) > g.free_distance
    return np.where(pressed, resting_seat(g, centre), riding)


def _improved(g: Geometry, a: Array, fc: Array, x: Array) -> tuple[Array, NDArray[np.bool_]]:
    """One Newton step, each ball with its own length; also which balls are still moving."""
    inner, outer = _contact(g.inner.stiffness, g.inner_reach, a - x), _outer(g, x)
    gradient = outer.force - inner.force
    gradient[1] -= fc
    step = -np.einsum("ab...,b...->a...", _inverse(inner.slope + outer.slope), gradient)
    size = np.hypot(*inner.force) + np.hypot(*outer.force) + fc
    both = inner.slope + outer.slope
    noise = 4.0 * EPS * (g.inner_reach + g.outer_reach) * (both[0, 0] + both[1, 1])
    moving = np.hypot(*gradient) > TOLERANCE * size + noise
    before, room = _energy(g, a, x, fc), np.hypot(*x) - g.outer_reach
    slack = 4.0 * EPS * (np.abs(before) + inner.energy + outer.energy)
    slack += 4.0 * EPS * (g.inner_reach + g.outer_reach) * size  # rounding of the lengths
    length = np.ones_like(fc)
    for _ in range(50):
        trial = x + length * step
        good = _energy(g, a, trial, fc) <= before + slack
        good &= np.hypot(*trial) - g.outer_reach > 0.1 * room
        if (good | ~moving).all():
            break
        length = np.where(good, length, 0.5 * length)
    return np.where(moving, trial, x), moving


def _inverse(matrix: Array) -> Array:
    """Inverse of symmetric 2×2 matrices, component first; zero where singular."""
    a, b, d = matrix[0, 0], matrix[0, 1], matrix[1, 1]
    determinant = a * d - b * b
    safe = np.where(determinant > 0.0, determinant, np.inf)
    return np.array([[d, -b], [-b, a]]) / safe
