"""The search for the balance of shaft and bearings under loads across the axis: Newton's method."""

from __future__ import annotations

import numpy as np

from rotordyn.allowance import require_time
from rotordyn.arrays import Array, Flags
from rotordyn.machine.limits import HIGHEST_PRESSURE
from rotordyn.preload.balance import FORCES, Balance, Force, Point

LONGEST_STEP = 50e-6  # m, by which a ring moves in one step of the search
LEVEL = 1e-6  # by which the balance may seem worse where it does not change
BEYOND = 0.9  # of the force along a step at its start, that may push back at its end
TOLERANCE = 1e-9  # of the largest force in the balance, and of the largest ball load
TOGETHER = 20  # iterations of shaft and balls
APART = 60  # iterations with every bearing solved by itself
HALVINGS = 8


def balanced(
    balance: Balance, guess: list[Array], near: Point, force: Force, alive: Flags
) -> tuple[Balance, Point, Flags]:
    """Equilibrium under ``force`` from a guess, and where there is one (speeds,).

    Shaft and balls together; where that fails, or balls know two branches, with every bearing
    solved by itself on the way.
    """
    begun = balance.begun(near)
    problem, start = begun, np.where(alive[:, None], guess[0], near.coordinates)
    if balance.network.one_branch:
        first = problem.guessed([start, *guess[1:]], near)
        problem, there, converged = _searched(problem, first, force, alive, together=True)
        converged &= there.bearings.follows(near.bearings)
        if not (alive & ~converged).any():
            return problem, there, converged
        start = np.where(converged[:, None], there.coordinates, start)
        problem = problem.where(converged, begun)
    there = problem.evaluate(problem.placed(start), None)
    return _searched(problem, there, force, alive, together=False)


def _searched(
    problem: Balance, there: Point, force: Force, alive: Flags, *, together: bool
) -> tuple[Balance, Point, Flags]:
    """Newton steps, and where they end well.

    ``together``: balls move along with the shaft, in whole steps; else every bearing is solved by
    itself, and steps are shortened. Only speeds still ``alive`` are sought; where no step helps any
    more the search ends. Stops close and open as they must.
    """
    place = Balance.advance if together else Balance.evaluate
    converged = np.zeros(len(alive), dtype=bool)
    for _ in range(TOGETHER if together else APART):
        require_time("loads", "broken off")
        miss, error = problem.errors(there, force)
        converged = (error < TOLERANCE) & (there.pressure <= HIGHEST_PRESSURE)
        wanted = problem.with_contacts(there)
        changed = converged & wanted.differs(problem)
        if changed.any():
            problem = wanted.where(changed, problem)
            there = place(problem, problem.placed(there.coordinates), there)
            continue
        moving = alive & np.isfinite(error) & ~(error < TOLERANCE)
        if not moving.any():
            break
        there, helped = _moved(problem, there, miss, error, moving, force, together=together)
        alive = alive & helped
    return problem, there, converged


def _moved(
    problem: Balance,
    here: Point,
    miss: Array,
    error: Array,
    moving: Flags,
    force: Force,
    *,
    together: bool,
) -> tuple[Point, Flags]:
    """A Newton step at the speeds still moving, and where it helped, or was not needed.

    With bearings solved by themselves it is shortened where the balance gets worse. Forces then
    have a convex energy: a step helps as well that goes down, or past the least by not too much.
    Where next to nothing holds a motion, as within the play of a bearing, the shortest step counts
    in any case: nothing gets better before balls touch, and the first touch may be hard.
    """
    matrix = np.where(moving[:, None, None], problem.matrix(here), np.eye(miss.shape[1]))
    step = np.linalg.solve(matrix, np.where(moving[:, None], miss, 0.0)[..., None])[..., 0]
    moved = np.abs(problem.bearing_motion(step)[..., :FORCES]).max(axis=(1, 2), initial=0.0)
    length = moving * np.minimum(1.0, LONGEST_STEP / np.maximum(moved, 1e-300))
    if together:
        there = problem.advance(here.coordinates + length[:, None] * step, here)
        return there, ~moving | (problem.error(there, force) < error)
    downhill = (miss * step).sum(axis=1)
    for _ in range(HALVINGS):
        there = problem.evaluate(here.coordinates + length[:, None] * step, here)
        missed, after = problem.errors(there, force)
        beyond = -(missed * step).sum(axis=1)
        helped = ~moving | (after < error * (1.0 + LEVEL))
        helped |= np.isfinite(after) & (beyond < BEYOND * downhill)
        if helped.all():
            break
        length = np.where(helped, length, 0.5 * length)
    return there, helped | ((moved > LONGEST_STEP) & np.isfinite(after))
