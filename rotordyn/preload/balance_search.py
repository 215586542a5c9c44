"""Newton's method for the balance of shaft and bearings under loads across the axis."""

from __future__ import annotations

import numpy as np

from rotordyn.allowance import require_time
from rotordyn.arrays import Array, Flags
from rotordyn.machine.limits import HIGHEST_PRESSURE
from rotordyn.preload.balance import FORCES, Balance, Force, Point

LONGEST_STEP = 50e-6  # m, by which a ring moves in one step of the search
LEVEL = 1e-6  # relative increase of the error that counts as none, as rounding may cause
BEYOND = 0.9  # largest opposing force at the end of a step, over the driving force at its start
TOLERANCE = 1e-9  # of the largest force in the balance, and of the largest ball load
TOGETHER = 20  # iterations of shaft and balls together
APART = 60  # iterations with every bearing solved by itself
HALVINGS = 8  # of a step, at most


def balanced(
    balance: Balance, guess: list[Array], near: Point, force: Force, alive: Flags
) -> tuple[Balance, Point, Flags]:
    """Return the equilibrium under ``force`` from a guess, and where there is one (speeds,).

    Shaft and balls are iterated together; where that fails, or if balls may have two branches,
    every bearing is solved by itself at each step.
    """
    initial = balance.begun(near)
    problem, start = initial, np.where(alive[:, None], guess[0], near.coordinates)
    if balance.network.one_branch:
        first = problem.guessed([start, *guess[1:]], near)
        problem, point, converged = _searched(problem, first, force, alive, together=True)
        converged &= point.bearings.follows(near.bearings)
        if not (alive & ~converged).any():
            return problem, point, converged
        start = np.where(converged[:, None], point.coordinates, start)
        problem = problem.where(converged, initial)
    point = problem.evaluate(problem.placed(start), None)
    return _searched(problem, point, force, alive, together=False)


def _searched(
    problem: Balance, point: Point, force: Force, alive: Flags, *, together: bool
) -> tuple[Balance, Point, Flags]:
    """Take Newton steps; also return where they converged (speeds,).

    ``together``: balls move along with the shaft, in whole steps; else every bearing is solved by
    itself, and steps are shortened. Only speeds ``alive`` are sought; a speed at which no step
    helps is given up. Stops close and open as they must.
    """
    move = Balance.advance if together else Balance.evaluate
    converged = np.zeros(len(alive), dtype=bool)
    for _ in range(TOGETHER if together else APART):
        require_time("loads", "broken off")
        residual, error = problem.errors(point, force)
        converged = (error < TOLERANCE) & (point.pressure <= HIGHEST_PRESSURE)
        updated = problem.with_contacts(point)
        changed = converged & updated.differs(problem)
        if changed.any():
            problem = updated.where(changed, problem)
            point = move(problem, problem.placed(point.coordinates), point)
            continue
        moving = alive & np.isfinite(error) & ~(error < TOLERANCE)
        if not moving.any():
            break
        point, helped = _moved(problem, point, residual, error, moving, force, together=together)
        alive = alive & helped
    return problem, point, converged


def _moved(
    problem: Balance,
    point: Point,
    residual: Array,
    error: Array,
    moving: Flags,
    force: Force,
    *,
    together: bool,
) -> tuple[Point, Flags]:
    """Take a Newton step at the ``moving`` speeds; also return where it helped or was not needed.

    With bearings solved by themselves it is shortened where the error grows. Forces then have a
    convex energy: a step also helps if it descends, or passes the minimum by not too much. Where a
    motion has next to no stiffness, as within the play of a bearing, the shortest step is accepted
    in any case: the error cannot fall before balls touch, and may jump at first contact.
    """
    matrix = np.where(moving[:, None, None], problem.matrix(point), np.eye(residual.shape[1]))
    step = np.linalg.solve(matrix, np.where(moving[:, None], residual, 0.0)[..., None])[..., 0]
    ring_step = np.abs(problem.bearing_motion(step)[..., :FORCES]).max(axis=(1, 2), initial=0.0)
    length = moving * np.minimum(1.0, LONGEST_STEP / np.maximum(ring_step, 1e-300))
    if together:
        new_point = problem.advance(point.coordinates + length[:, None] * step, point)
        return new_point, ~moving | (problem.error(new_point, force) < error)
    downhill = (residual * step).sum(axis=1)
    for _ in range(HALVINGS):
        new_point = problem.evaluate(point.coordinates + length[:, None] * step, point)
        new_residual, new_error = problem.errors(new_point, force)
        opposing = -(new_residual * step).sum(axis=1)
        helped = ~moving | (new_error < error * (1.0 + LEVEL))
        helped |= np.isfinite(new_error) & (opposing < BEYOND * downhill)
        if helped.all():
            break
        length = np.where(helped, length, 0.5 * length)
    return new_point, helped | ((ring_step > LONGEST_STEP) & np.isfinite(new_error))
