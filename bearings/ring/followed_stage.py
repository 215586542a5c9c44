"""Second stage: the state followed from the convex problem to the full one.

The real angle dependence and the gyroscopic moment are switched on by a blend t = 0 … 1. A path
that ends before t = 1 (a fold, a jump of a contact, a ball lifted off) has no physical end.

A ring restrained by few balls can move without any change of load until another ball makes contact:
two loaded balls restrain four of the five DOF. Where the load of a third vanishes while a state is
followed, all positions up to contact with the next ball, or with this one from its other side,
balance the same load, and the path continues from there.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearings.arrays import Array, Flags, Index
from bearings.ball.balance import Balance
from bearings.ball.plane import turned_far
from bearings.geometry import Geometry
from bearings.ring import tolerances as tol
from bearings.ring.linearised import Linear, linearise, newton_step, reduced
from bearings.ring.problem import Problem


def followed(
    problem: Problem, d: Array, x: Array, done: Flags
) -> tuple[Array, Array, Flags, Flags]:
    """Follow the states that are ``done`` at blend 0 to the full problem.

    Returns (d, X), success, and whether a path was given up because it needs too many strides: a
    ring with little restraint, as that of a thrust bearing across its axis, moves far.
    """
    if problem.full == 0.0:
        d, x, passed, _, _ = corrected(problem, d, x, np.zeros(len(d)))
        return d, x, done & passed, np.zeros(len(d), dtype=bool)
    blend, stride = np.zeros(len(d)), np.full(len(d), tol.FIRST_BLEND)
    freed, strides = np.zeros(len(d), dtype=int), np.zeros(len(d), dtype=int)
    while True:
        allowed = (stride >= tol.SHORTEST_BLEND) & (strides < tol.MOST_STRIDES)
        todo = np.flatnonzero(done & (blend < 1.0) & allowed)
        if not todo.size:
            unfinished = done & (blend < 1.0) & (strides < tol.MOST_STRIDES)
            stuck = np.flatnonzero(unfinished & (freed < tol.MOST_FREE_MOTIONS))
            freed[stuck] += 1
            if not _free(problem, d, x, blend, stride, stuck):
                break
            continue
        strides[todo] += 1
        target = np.minimum(1.0, blend[todo] + stride[todo])
        new_d, new_x, passed, _, used = corrected(problem.take(todo), d[todo], x[:, todo], target)
        ahead = todo[passed]
        d[ahead], x[:, ahead], blend[ahead] = new_d[passed], new_x[:, passed], target[passed]
        stride[ahead] *= np.where(used[passed] <= tol.QUICK_STEPS, 2.0, 1.0)
        stride[todo[~passed]] *= 0.25
    return d, x, done & (blend >= 1.0), done & (blend < 1.0) & (strides >= tol.MOST_STRIDES)


def _free(problem: Problem, d: Array, x: Array, blend: Array, stride: Array, stuck: Index) -> bool:
    """Move unrestrained rings to the next contact; return whether any path continues."""
    continued = False
    for k in stuck:
        part = problem.take(np.array([k]))
        linear = linearise(part, d[k : k + 1], x[:, k : k + 1], blend[k : k + 1])
        position = _beyond(part, d[k], x[:, k], linear.balance)
        if position is None:
            continue
        target = np.minimum(1.0, blend[k : k + 1] + tol.FIRST_FREE)
        new_d, new_x, accepted = corrected(part, position[None], x[:, k : k + 1], target)[:3]
        if accepted[0]:
            d[k], x[:, k], blend[k], stride[k] = new_d[0], new_x[:, 0], target[0], tol.FIRST_FREE
            continued = True
    return continued


@np.errstate(all="ignore")  # a diverging step ends as a NaN error
def corrected(
    problem: Problem, d: Array, x: Array, blend: Array
) -> tuple[Array, Array, Flags, Linear, NDArray[np.int_]]:
    """Newton's method without line search at ``blend`` from a nearby point.

    Returns new (d, X), success, the linearisation there, and the iterations used. Success means:
    converged, no angle turned far, every ball on the outer race, no fold and no jump passed.
    """
    directions = problem.faced(d, x)
    d, x = d.copy(), x.copy()
    used = np.zeros(len(d), dtype=int)
    needed = np.where(blend < problem.full, tol.ON_THE_WAY, tol.TOLERANCE)
    linear = linearise(problem, d, x, blend)
    first, active = linear.balance, linear.error >= needed
    for _ in range(tol.NEWTON_STEPS):
        if not active.any():
            break
        used += active
        dd, dx = newton_step(problem, linear)
        d += np.where(active[:, None], dd, 0.0)
        x += np.where(active[:, None], dx, 0.0)
        linear = linearise(problem, d, x, blend)
        active = linear.error >= needed
    accepted = linear.error < needed
    if not problem.turning:
        return d, x, accepted, linear, used
    accepted &= linear.fold > 0.0
    for then, now in zip(directions, problem.faced(d, x), strict=True):
        accepted &= ~turned_far(then, now, tol.LONGEST_TURN).any(axis=-1)
    accepted &= (linear.balance.outer_load > 0.0).all(axis=-1)
    if not np.all(one_branch := problem.law.one_branch):
        jumped = _jumped(problem.geometry.ball_diameter, first, linear.balance)
        accepted &= ~jumped.any(axis=-1) | one_branch
    if problem.free.any():
        accepted &= _restrained(problem, linear)
    return d, x, accepted, linear, used


def _restrained(problem: Problem, linear: Linear) -> Flags:
    """Whether no motion of the ring has passed a fold; it may be neutral if ``problem.loose``."""
    k = reduced(problem, linear.stiffness)
    k = k / (np.abs(k).max(axis=(1, 2), keepdims=True) + 1e-300)
    restrained = np.linalg.det(k) > 0.0
    if problem.loose:
        finite = np.isfinite(k.sum(axis=(1, 2)))
        sizes = np.linalg.svd(np.where(finite[:, None, None], k, 0.0), compute_uv=False)
        restrained |= finite & (sizes[:, -1] < tol.NEUTRAL)
    return np.asarray(restrained)


def _jumped(diameter: float, before: Balance, now: Balance) -> Flags:
    """Whether an inner contact (s, n) has opened or closed while its moment did not vanish."""
    changed = (before.inner_load > 0.0) != (now.inner_load > 0.0)
    moment = np.maximum(np.abs(before.gyroscopic_moment), np.abs(now.gyroscopic_moment))
    largest = np.maximum(now.outer_load, now.inner_load).max(axis=-1, keepdims=True)
    return changed & (2.0 * moment > tol.JUMP * diameter * largest)


def _beyond(problem: Problem, d: Array, x: Array, balance: Balance) -> Array | None:
    """Displacement (5,) of one state at its next contact; None where the ring is restrained.

    ``d`` (5,), ``x`` (2, n); ``balance`` of that state alone.
    """
    if not problem.geometry.single:  # a groove off the middle also moves by the tilt
        return None
    load = balance.inner_load[0]
    carrying = load > tol.FADING * load.max(initial=0.0)
    free_motion = _free_motion(problem, carrying)
    if free_motion is None:
        return None
    c, a = problem.geometry, problem.centres(d[None], x[:, None])[:2, 0]
    groove_motion = problem.assembly.moved(free_motion[None])[:2, 0]
    fading = np.flatnonzero((load > 0.0) & ~carrying)
    if fading.size:
        gap = a[:, fading] - x[:2, fading]
        if float((gap * groove_motion[:, fading]).sum()) > 0.0:
            free_motion, groove_motion = -free_motion, -groove_motion
    idle = np.flatnonzero(~carrying)  # a fading ball may be touched again from the other side
    pressed = (tol.TOUCHING * load.max() / c.inner.stiffness) ** (2.0 / 3.0)
    travel = _touch(c, a[:, idle] - x[:2, idle], groove_motion[:, idle], pressed)
    if not np.isfinite(travel).any():
        return None
    return np.asarray(d + travel.min() * free_motion)


def _free_motion(problem: Problem, carrying: Flags) -> Array | None:
    """Direction (5,) in which the loaded balls do not move; None unless there is exactly one."""
    scale = problem.scale[problem.free]
    if not scale.size:
        return None
    rows = problem.assembly.spread[:2, problem.free][..., carrying] / scale[:, None]
    rows = rows.transpose(0, 2, 1).reshape(-1, len(scale))
    _, size, right = np.linalg.svd(np.vstack([rows, np.zeros((1, len(scale)))]))
    if len(size) < len(scale):
        return None
    free = size <= tol.HELD * size[0]
    if free.sum() != 1:
        return None
    motion = np.zeros(5)
    motion[problem.free] = right[-1] / scale
    return motion


def _touch(c: Geometry, gap: Array, moving: Array, pressed: float) -> Array:
    """Travel (k,) after which idle balls are compressed by ``pressed``; infinite if never.

    ``gap`` (2, k) from the ball centre to the inner groove centre, ``moving`` its rate.
    """
    square = (moving * moving).sum(axis=0)
    line = (gap * moving).sum(axis=0)
    short = (c.inner_centre_distance + pressed) ** 2 - (gap * gap).sum(axis=0)
    root = line * line + square * short
    possible = (root > 0.0) & (square > 0.0) & (short > 0.0)
    travel = (np.sqrt(np.maximum(root, 0.0)) - line) / np.where(square > 0.0, square, 1.0)
    return np.where(possible, travel, np.inf)
