"""Shifts of the grooves of rings that deform: more unknowns beside the ball centres.

With rigid rings every ball depends on the motion of its ring alone. Rings that deform couple the
balls: at each, a groove is where the ring's motion carries it, and shifted, which all contact loads
bring about (``bearings.flexible_rings.compliance``). Once balls are eliminated, that is one linear
equation for the shifts of all balls of a state, and the ring sees balls and shifts as springs.

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

    ``still`` (u, s, n) [m]: what they still change by with the ring where it is; ``follow``
    (u, s, n, 5): with the ring's displacement. ``error`` (s,): what they miss, as a force.
    ``ball_by`` (2, u, s, n), ``action_by`` (3, u, s, n): what a ball and its action do with them.
    ``across`` (3, m, s, 1), of one ball that stands for all: what shifts add to its action by the
    motion of its groove where the ring moves across the axis; else None.
    """

    still: Array
    follow: Array
    error: Array
    ball_by: Array
    action_by: Array
    across: Array | None


class CentreToBall(NamedTuple):
    """From the centre of every groove to its ball, ``way`` (s, n, c, 2) [m], and how ways move.

    ``still`` (s, n, 2c): as balls come into balance, with ring and shifts where they are;
    ``by_shift`` (s, n, 2c, u), ``by_motion`` (s, n, 2c, m): by shifts, and by motions of the inner
    ring there. ``joined`` (u, 2c): the unknowns of a ball from the shifts of all its grooves.
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
    """Shifts where grooves stand at ``centre`` and balls at ``x``, whose later rows they are.

    ``c``: with grooves as shifted; ``blend`` (s,): share of the compliance that acts; ``motion``:
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
    here = np.moveaxis(x[2:], 0, 2)
    missing = shift @ ways.joined.T - here
    still, follow = _solved(ways, slopes[0], missing, by_ring)
    across = None
    if len(slopes) > 1:
        answer = _solved(ways, slopes[1], missing, ways.by_motion)[1]
        across = np.einsum("ausn,usnm->amsn", action_by, answer)
    stiffest = np.abs(np.asarray(balls.tangent[:2])).max(axis=(0, 1, 3))
    error = np.abs(missing).max(axis=(1, 2)) * stiffest
    return ShiftStep(still, follow, error, ball_by, action_by, across)


def _solved(ways: CentreToBall, slope: Array, missing: Array, by: Array) -> tuple[Array, Array]:
    """Shifts of all balls: where they come to rest (u, s, n), and by given motions (u, s, n, k),
    of which ``by`` (s, n, 2c, k) says what they do with the ways. ``slope`` (s, n, 2c, n, 2c)."""
    # With e the shifts, y the ways and J = ``joined``: e = J E(y), so that
    # (I − J E' ∂y/∂e) de = J E − e + J E' (dy of the balls, and of the given motions).
    states, n, ends = ways.still.shape
    u = len(ways.joined)
    turned = ways.joined @ slope.reshape(states, n, ends, n * ends)
    turned = turned.reshape(states, n * u, n, ends)
    tangent = turned.swapaxes(1, 2) @ ways.by_shift  # (s, n, n·u, u), ball by ball
    tangent = tangent.swapaxes(1, 2).reshape(states, n * u, n * u)
    moves = np.concatenate([ways.still[..., None], by], axis=-1).reshape(states, n * ends, -1)
    right = turned.reshape(states, n * u, n * ends) @ moves
    right[..., 0] += missing.reshape(states, -1)
    found = np.linalg.solve(np.eye(n * u) - tangent, right).reshape(states, n, u, -1)
    found = np.moveaxis(found, 2, 0)
    return found[..., 0], found[..., 1:]


def _between_one(problem: Problem, centre: Motion, x: Array, balls: Condensed) -> CentreToBall:
    """One groove a ring: X counts from the outer groove, A from there to the inner one. At rest
    both contacts are in series, and the ball takes no place."""
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
    """Two grooves a ring: every one with its own shift."""
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
    """From the centre of every groove to its ball (s, n, c, 2); of balls at rest between one groove
    a ring, to the other groove."""
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
    """Of solved states: ways from the grooves to the balls, and the shifts of the groove centres by
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
    """What a ball does with the shifts of its grooves (2, u, s, n), and its action (3, u, s, n)."""
    law, squared = problem.law.numbers, problem.squared[:, None]
    each = by_grooves(c, law, centre, (x[0], x[1]), squared, *motion)
    forces, action = (
        np.concatenate([_rows(part[k], 2) for part in each], axis=1) for k in range(2)
    )
    back: Any = np.asarray(inverse(balance.forces.residual_by_ball))
    ball_by = -np.einsum("xysn,yusn->xusn", back, forces)
    by_ball = _rows(balance.forces.action_by_ball, 2)
    return ball_by, action + np.einsum("axsn,xusn->ausn", by_ball, ball_by)


def _pressed(
    problem: Problem, c: Geometry, way: Array, blend: Array
) -> tuple[Array, tuple[Array, ...]]:
    """Shifts of all grooves (s, n, 2c), and what they change by with the ways of the balls
    (s, n, 2c, n, 2c): in the motion solved for, and where one ball stands for all across it."""
    states, n, contacts = way.shape[:3]
    split, rings = len(c.inner_grooves), problem.compliances
    alone = problem.assembly.balls < problem.geometry.balls
    assert rings is not None
    shift = np.zeros((states, n, contacts, 2))
    slopes = [np.zeros((states, n, contacts, 2, n, contacts, 2)) for _ in range(2 if alone else 1)]
    ends = (
        (rings.inner, c.inner_grooves, -1.0, slice(split)),
        (rings.outer, c.outer_grooves, 1.0, slice(split, None)),
    )
    for ring, grooves, outward, part in ends:
        if ring is None:
            continue
        groove = grooves[0] if problem.placed else both_grooves(c)
        there = way[:, :, part].copy()
        if groove.walls:  # straight beyond 90°
            there[..., 1] = outward * np.maximum(outward * there[..., 1], 0.0)
        length = np.sqrt((there * there).sum(axis=-1))
        k: Any = np.asarray(groove.stiffness)
        distance = np.asarray(groove.centre_distance)
        if k.ndim:  # films in series with the contacts make them differ from ball to ball
            k, distance = k[..., None], distance[..., None]
        load, stiffness = hertz(k, np.maximum(length - distance, 0.0))
        known, others = (
            (ring.for_equal_loads(0), [ring.for_equal_loads(1)]) if alone else (ring, [])
        )
        each = known.shifts(there, load, stiffness, others)
        shift[:, :, part] = each.shift * blend[:, None, None, None]
        for whole, slope in zip(slopes, each.slopes, strict=True):
            whole[:, :, part, :, :, part] = slope * blend[:, None, None, None, None, None, None]
    flat = (states, n, 2 * contacts, n, 2 * contacts)
    return shift.reshape(states, n, 2 * contacts), (*(each.reshape(flat) for each in slopes),)


def _rows(rows: Any, columns: int) -> Array:
    """Rows of which the first ``columns`` are taken, each (s, n), as (rows, columns, s, n)."""
    return np.array([row[:columns] for row in rows])


def _last(block: Array, x: Array) -> Array:
    """(k, l, s, n) as (s, n, k, l)."""
    whole = np.broadcast_to(block, (*block.shape[:2], *x.shape[1:]))
    return np.moveaxis(whole, (0, 1), (2, 3))
