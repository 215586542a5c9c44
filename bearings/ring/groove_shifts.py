"""Shifts of the grooves of rings that deform: unknowns in addition to the ball centres.

With rigid rings every ball depends on the motion of its ring alone. Rings that deform couple the
balls: at each, a groove follows the motion of its ring and is shifted by all contact loads
(``bearings.flexible_rings.compliance``). Once balls are eliminated, that is one linear
equation for the shifts of all balls of a state, and balls and shifts act on the ring as springs.

Between one groove a ring, only the shift of the inner groove against the outer one matters to a
ball: two unknowns. Where a ring has two, each groove has its own, in the order of the contacts:
eight unknowns, or six with a shim in one ring alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from bearings.arrays import Array
from bearings.ball.balance import Balance, by_grooves
from bearings.ball.condensed import Condensed
from bearings.ball.plane import Motion, inverse
from bearings.ball.potential import both_grooves
from bearings.ball.race import against, hertz, vector_to
from bearings.geometry import Geometry
from bearings.ring.problem import Problem


@dataclass(frozen=True, eq=False, slots=True)
class ShiftStep:
    """The u shifts of the grooves at every ball, linearised with the balls.

    ``still`` (u, s, n) [m]: their Newton step at a fixed ring; ``follow`` (u, s, n, 5): their
    derivatives by the ring's displacement. ``error`` (s,): their residual, as a force. ``ball_by``
    (2, u, s, n), ``action_by`` (3, u, s, n): derivatives of ball centre and action by the shifts.
    ``across`` (3, m, s, 1), of one ball that represents all: contribution of the shifts to its
    action by the motion of its groove where the ring moves across the axis; else None.
    """

    still: Array
    follow: Array
    error: Array
    ball_by: Array
    action_by: Array
    across: Array | None


class CentreToBall(NamedTuple):
    """Vectors ``way`` (s, n, c, 2) [m] from the centre of every groove to its ball, linearised.

    ``still`` (s, n, 2c): their Newton step at fixed ring and shifts; ``by_shift`` (s, n, 2c, u),
    ``by_motion`` (s, n, 2c, m): derivatives by shifts, and by motions of the inner ring there.
    ``joined`` (u, 2c): the unknowns of a ball from the shifts of all its grooves.
    """

    way: Array
    still: Array
    by_shift: Array
    by_motion: Array
    joined: Array


def linearised_shifts(
    problem: Problem,
    c: Geometry,
    centre: Motion,
    x: Array,
    balance: Balance,
    balls: Condensed,
    blend: Array,
    motion: tuple[Any, float],
) -> ShiftStep:
    """Linearise the shifts at groove places ``centre`` and unknowns ``x``, whose rows from 2 on
    they are.

    ``c``: with shifted grooves; ``blend`` (s,): share of the compliance that acts; ``motion``:
    blend and ``vary`` of Fc and Mg, as for ``turning_balance``.
    """
    if c.single:
        ball_by, action_by = _rows(balls.follow, 2), _rows(balls.tangent, 2)
        ways = _between_one(problem, centre, x, balls)
    else:
        ball_by, action_by = _by_grooves(problem, c, centre, x, balance, motion)
        ways = _between_two(problem, c, centre, x, balls, ball_by)
    shift, slopes = _pressed(problem, c, ways.way, blend)
    by_ring = ways.by_motion @ np.moveaxis(problem.assembly.spread, -1, 0)
    current = np.moveaxis(x[2:], 0, 2)
    residual = shift @ ways.joined.T - current
    still, follow = _solved(ways, slopes[0], residual, by_ring)
    across = None
    if len(slopes) > 1:
        response = _solved(ways, slopes[1], residual, ways.by_motion)[1]
        across = np.einsum("ausn,usnm->amsn", action_by, response)
    stiffest = np.abs(np.asarray(balls.tangent[:2])).max(axis=(0, 1, 3))
    error = np.abs(residual).max(axis=(1, 2)) * stiffest
    return ShiftStep(still, follow, error, ball_by, action_by, across)


def _solved(ways: CentreToBall, slope: Array, residual: Array, by: Array) -> tuple[Array, Array]:
    """Solve the shifts of all balls: their Newton step (u, s, n), and their derivatives by motions
    (u, s, n, k) that change the ways by ``by`` (s, n, 2c, k). ``slope`` (s, n, 2c, n, 2c)."""
    # With e the shifts, y the ways and J = ``joined``: e = J E(y), so that
    # (I − J E' ∂y/∂e) de = J E − e + J E' (dy of the balls, and of the given motions).
    states, n, ends = ways.still.shape
    u = len(ways.joined)
    gradient = ways.joined @ slope.reshape(states, n, ends, n * ends)
    gradient = gradient.reshape(states, n * u, n, ends)
    tangent = gradient.swapaxes(1, 2) @ ways.by_shift  # (s, n, n·u, u), ball by ball
    tangent = tangent.swapaxes(1, 2).reshape(states, n * u, n * u)
    moves = np.concatenate([ways.still[..., None], by], axis=-1).reshape(states, n * ends, -1)
    right = gradient.reshape(states, n * u, n * ends) @ moves
    right[..., 0] += residual.reshape(states, -1)
    shifts = np.linalg.solve(np.eye(n * u) - tangent, right).reshape(states, n, u, -1)
    shifts = np.moveaxis(shifts, 2, 0)
    return shifts[..., 0], shifts[..., 1:]


def _between_one(problem: Problem, centre: Motion, x: Array, balls: Condensed) -> CentreToBall:
    """Ways with one groove a ring: X is relative to the outer groove, A leads from there to the
    inner one. At rest both contacts are in series, and the ball centre is no unknown."""
    eye, still = np.eye(2)[:, :, None, None], np.zeros_like(x[:2])
    by: Any = (-eye, eye)
    if problem.placed:
        follow: Any = np.asarray(balls.follow)
        still = np.stack(balls.still)
        by = (follow - eye, follow)
    by_shift = _last(np.concatenate(np.broadcast_arrays(*by)), x)
    return CentreToBall(
        way=_way(problem, problem.geometry, centre, x),
        still=np.moveaxis(np.concatenate([still, still]), 0, 2),
        by_shift=by_shift,
        by_motion=by_shift,
        joined=np.hstack([np.eye(2), -np.eye(2)]),
    )


def _between_two(
    problem: Problem, c: Geometry, centre: Motion, x: Array, balls: Condensed, ball_by: Array
) -> CentreToBall:
    """Ways with two grooves a ring, each with its own shift."""
    way, follow = _way(problem, c, centre, x), _rows(balls.follow, len(centre))
    still, count = np.stack(balls.still), way.shape[2]
    by_motion = np.tile(follow, (count, 1, 1, 1))  # (2c, m, s, n)
    for k, groove in enumerate(c.inner_grooves):
        by_motion[2 * k, 0] -= 1.0
        by_motion[2 * k + 1, 1] -= 1.0
        if len(centre) > 2:
            by_motion[2 * k + 1, 2] -= groove.offset
    by_shift = np.tile(ball_by, (count, 1, 1, 1)) - np.eye(2 * count)[:, :, None, None]
    return CentreToBall(
        way=way,
        still=np.moveaxis(np.tile(still, (count, 1, 1)), 0, 2),
        by_shift=_last(by_shift, x),
        by_motion=_last(by_motion, x),
        joined=np.eye(2 * count),
    )


def _way(problem: Problem, c: Geometry, centre: Motion, x: Array) -> Array:
    """Vectors from the centre of every groove to its ball (s, n, c, 2); for balls at rest between
    one groove a ring, to the other groove."""
    place = (x[0], x[1])
    if not c.single:
        inner = [vector_to(groove, against(centre, place), 1.0) for groove in c.inner_grooves]
        outer = [vector_to(groove, place, -1.0) for groove in c.outer_grooves]
        ways = np.array([*((-axial, -radial) for axial, radial in inner), *outer])
    elif problem.placed:
        ways = np.stack([x[:2] - np.stack(centre[:2]), x[:2]])
    else:
        ways = np.stack([-np.stack(centre[:2]), np.stack(centre[:2])])
    return np.moveaxis(ways, (0, 1), (2, 3))


def groove_shifts(problem: Problem, d: Array, x: Array) -> tuple[Array, Array]:
    """Ways from the grooves to the balls of solved states, and the shifts of the groove centres by
    the loads there (s, n, c, 2) [m]."""
    c, centre = problem.shifted(x), tuple(problem.centres(d, x))
    way = _way(problem, c, centre, x)
    return way, _pressed(problem, c, way, np.ones(len(d)))[0].reshape(way.shape)


def _by_grooves(
    problem: Problem,
    c: Geometry,
    centre: Motion,
    x: Array,
    balance: Balance,
    motion: tuple[Any, float],
) -> tuple[Array, Array]:
    """Derivatives of a ball (2, u, s, n) and of its action (3, u, s, n) by its groove shifts."""
    law, squared = problem.law.numbers, problem.squared[:, None]
    derivatives = by_grooves(c, law, centre, (x[0], x[1]), squared, *motion)
    forces, action = (
        np.concatenate([_rows(part[k], 2) for part in derivatives], axis=1) for k in range(2)
    )
    back: Any = np.asarray(inverse(balance.forces.residual_by_ball))
    ball_by = -np.einsum("xysn,yusn->xusn", back, forces)
    by_ball = _rows(balance.forces.action_by_ball, 2)
    return ball_by, action + np.einsum("axsn,xusn->ausn", by_ball, ball_by)


def _pressed(
    problem: Problem, c: Geometry, way: Array, blend: Array
) -> tuple[Array, tuple[Array, ...]]:
    """Shifts of all grooves (s, n, 2c), and their derivatives by the ways (s, n, 2c, n, 2c): for
    the motion solved for, and, where one ball represents all, for motion across it."""
    states, n, contacts = way.shape[:3]
    axial = problem.assembly.balls < problem.geometry.balls
    assert problem.compliances is not None
    shift = np.zeros((states, n, contacts, 2))
    slopes = [np.zeros((states, n, contacts, 2, n, contacts, 2)) for _ in range(2 if axial else 1)]
    grooves_of = c.inner_grooves, c.outer_grooves
    for ring, grooves, part in zip(problem.compliances, grooves_of, c.rings, strict=True):
        if ring is None:
            continue
        groove = grooves[0] if problem.placed else both_grooves(c)
        vector = way[:, :, part].copy()
        if groove.walls:  # straight beyond 90°
            vector[..., 1] = ring.outward * np.maximum(ring.outward * vector[..., 1], 0.0)
        length = np.sqrt((vector * vector).sum(axis=-1))
        k: Any = np.asarray(groove.stiffness)
        distance = np.asarray(groove.centre_distance)
        if k.ndim:  # films in series with the contacts make them differ from ball to ball
            k, distance = k[..., None], distance[..., None]
        load, stiffness = hertz(k, np.maximum(length - distance, 0.0))
        acting, others = (
            (ring.for_equal_loads(0), [ring.for_equal_loads(1)]) if axial else (ring, [])
        )
        of_ring, slopes_of_ring = acting.shifts(vector, load, stiffness, others)
        shift[:, :, part] = of_ring * blend[:, None, None, None]
        for total, slope in zip(slopes, slopes_of_ring, strict=True):
            total[:, :, part, :, :, part] = slope * blend[:, None, None, None, None, None, None]
    flat = (states, n, 2 * contacts, n, 2 * contacts)
    return shift.reshape(states, n, 2 * contacts), (*(slope.reshape(flat) for slope in slopes),)


def _rows(rows: Any, columns: int) -> Array:
    """Stack the first ``columns`` entries (s, n) of every row to (rows, columns, s, n)."""
    return np.array([row[:columns] for row in rows])


def _last(block: Array, x: Array) -> Array:
    """Broadcast (k, l, s, n) and move its axes to (s, n, k, l)."""
    full = np.broadcast_to(block, (*block.shape[:2], *x.shape[1:]))
    return np.moveaxis(full, (0, 1), (2, 3))
