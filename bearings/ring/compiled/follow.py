"""The two stages of ``bearings.ring.equilibrium`` for one state.

The equations and the reasons to undo a stride are the same there; motions that no ball restrains
are left to that solver.
"""

from __future__ import annotations

import numpy as np

from bearings.arrays import Array
from bearings.ball.plane import EPS, turned_far
from bearings.ball.potential import rounding_force
from bearings.ball.race import faced
from bearings.geometry import frozen_force
from bearings.ring import tolerances as tol
from bearings.ring.compiled.one_state import (
    Evaluation,
    One,
    Workspace,
    centre_of,
    evaluate,
    evaluate_convex,
    followed_by,
    moved,
    put,
)


def find(p: One, d: Array, x: Array, near: bool, w: Workspace) -> bool:
    """Find the physical state: overwrite the start d (5,) and X (n, 2); return whether it exists.

    ``near``: the start is a nearby state, which is tried first.
    """
    blend, stride, direct = 0.0, tol.FIRST_BLEND, near and p.turning
    if not direct and not convex(p, d, x, w):
        return False
    if not p.placed:
        evaluate(p, d, x, 1.0, w)
        return True
    while blend < 1.0 and stride >= tol.SHORTEST_BLEND:  # one call of ``correct``: it compiles once
        target = 1.0 if direct or p.full == 0.0 else min(1.0, blend + stride)
        accepted, used = correct(p, d, x, p.full * target, w)
        if accepted:
            blend, stride = target, stride * (2.0 if used <= tol.QUICK_STEPS else 1.0)
        elif not direct:
            stride *= 0.25 * p.full  # full at blend 0: the only stride
        elif not convex(p, d, x, w):
            return False
        direct = False
    return blend >= 1.0


def correct(p: One, d: Array, x: Array, blend: float, w: Workspace) -> tuple[bool, int]:
    """Newton's method without line search at ``blend`` from a nearby point, undone where it fails.

    Returns success, and the iterations used.
    """
    put(w.d, d)
    put(w.x, x)
    needed, used = (tol.ON_THE_WAY if blend < p.full else tol.TOLERANCE), 0
    sums = evaluate(p, d, x, blend, w)
    put(w.first_grip, w.grip)
    while error(p, sums, w) >= needed and used < tol.NEWTON_STEPS:
        used += 1
        _newton(p, d, x, w)
        sums = evaluate(p, d, x, blend, w)
    accepted = error(p, sums, w) < needed
    if accepted and p.turning:
        accepted = sums.fold > 0.0 and sums.pressed and _turned_little(p, d, x, w)
        accepted = accepted and not _jumped(p, sums.largest, w)
        accepted = accepted and (len(p.free) == 0 or eliminated(*_reduced(p, w.action, w))[1] > 0.0)
    if not accepted:
        put(d, w.d)
        put(x, w.x)
    return accepted, used


def convex(p: One, d: Array, x: Array, w: Workspace) -> bool:
    """Solve the convex stage: overwrite (d, X); return whether it converged."""
    sums = evaluate_convex(p, d, x, w)
    reach = p.geometry.free_distance
    soft = tol.SOFT * p.geometry.balls * p.geometry.series_stiffness * np.sqrt(1e-3 * reach)
    for _ in range(tol.CONVEX_STEPS if len(p.free) else 0):
        k, gap = _reduced(p, w.action, w)
        largest, residual = np.abs(k).max(), np.abs(gap).max()
        size = p.load_size + 1e-3 * p.geometry.balls * sums.largest
        needed = tol.BALANCED if p.turning else 0.1 * tol.TOLERANCE
        if residual <= needed * size + tol.ROUNDING * EPS * reach * largest:
            return True
        share = residual / (residual + p.load_size + 1e-300)
        for i in range(len(gap)):
            k[i, i] += soft + tol.SOFTEST * max(share, tol.HARDEST) * largest
        part, step = eliminated(k, gap)[0], np.zeros(5)
        shrink = min(1.0, tol.LONGEST_STEP * reach / max(np.abs(part).max(), 1e-300))
        for i, j in enumerate(p.free):
            step[j] = shrink * part[i] / p.scale[j]
        sums = _searched(p, d, x, step, sums, w)
    return len(p.free) == 0


def error(p: One, sums: Evaluation, w: Workspace) -> float:
    """Scaled residual of balls and ring, with a tolerance for rounding of the lengths."""
    c = p.geometry
    noise = tol.ROUNDING * rounding_force(c, sums.largest) / tol.TOLERANCE
    worst = sums.imbalance / (sums.largest + noise + 1e-300)
    size = p.load_size + c.balls * (1e-3 * sums.largest + noise) + 1e-300
    for j in p.free:
        worst = max(worst, abs(w.action[j] - p.load[j]) / p.scale[j] / size)
    return worst


def _newton(p: One, d: Array, x: Array, w: Workspace) -> None:
    """Take a Newton step of balls and ring together."""
    step = np.zeros(5)
    if len(p.free):
        part = eliminated(*_reduced(p, w.condensed, w))[0]
        for i, j in enumerate(p.free):
            step[j] = part[i] / p.scale[j]
            d[j] += step[j]
    for ball in range(len(x)):
        axial, radial = followed_by(w.follow[ball], moved(p, step, ball))
        x[ball, 0] += w.still[ball, 0] + axial
        x[ball, 1] += w.still[ball, 1] + radial


def _reduced(p: One, carried: Array, w: Workspace) -> tuple[Array, Array]:
    """Tangent and residual load of the free DOF, scaled to lengths."""
    size = len(p.free)
    k, gap = np.empty((size, size)), np.empty(size)
    for i, row in enumerate(p.free):
        gap[i] = (p.load[row] - carried[row]) / p.scale[row]
        for j, column in enumerate(p.free):
            k[i, j] = w.stiffness[row, column] / p.scale[row] / p.scale[column]
    return k, gap


def eliminated(matrix: Array, right: Array) -> tuple[Array, float]:
    """Solve ``matrix`` x = ``right``; also return the determinant of the scaled matrix.

    The matrix is scaled by its largest entry; x = 0 where it is singular to rounding. Elimination
    with pivoting: a library call would cost more than the work.
    """
    largest, determinant = max(np.abs(matrix).max(), 1e-300), 1.0
    a, x = matrix / largest, right / largest
    for k in range(len(x)):
        pivot = k
        for i in range(k + 1, len(x)):
            if abs(a[i, k]) > abs(a[pivot, k]):
                pivot = i
        if pivot != k:
            determinant = -determinant
            x[k], x[pivot] = x[pivot], x[k]
            for j in range(len(x)):
                a[k, j], a[pivot, j] = a[pivot, j], a[k, j]
        determinant *= a[k, k]
        for i in range(k + 1, len(x)):
            factor = a[i, k] / a[k, k] if a[k, k] != 0.0 else 0.0
            x[i] -= factor * x[k]
            for j in range(k + 1, len(x)):
                a[i, j] -= factor * a[k, j]
    regular = abs(determinant) > tol.PLAINLY_REGULAR
    for k in range(len(x) - 1, -1, -1):
        for j in range(k + 1, len(x)):
            x[k] -= a[k, j] * x[j]
        x[k] = x[k] / a[k, k] if regular else 0.0
    return x, determinant


def _searched(
    p: One, d: Array, x: Array, step: Array, sums: Evaluation, w: Workspace
) -> Evaluation:
    """Take a step of the convex stage, halved until the potential falls."""
    g, previous = p.geometry, sums.energy - (p.load * d).sum()
    load = 64.0 * p.load_size + 4.0 * g.balls * frozen_force(g, p.squared)
    limit = previous + EPS * (64.0 * abs(previous) + g.free_distance * load)
    follow, length = w.follow.copy(), 1.0
    put(w.d, d)
    put(w.x, x)
    for _ in range(tol.HALVINGS):
        for j in p.free:
            d[j] = w.d[j] + length * step[j]
        for ball in range(len(x)):
            axial, radial = followed_by(follow[ball], moved(p, length * step, ball))
            x[ball, 0], x[ball, 1] = w.x[ball, 0] + axial, w.x[ball, 1] + radial
        sums = evaluate_convex(p, d, x, w)
        if sums.energy - (p.load * d).sum() <= limit:
            break
        length *= 0.5
    return sums


def _turned_little(p: One, d: Array, x: Array, w: Workspace) -> bool:
    """Whether all directions to groove centres have turned little since the stride began."""
    for ball in range(len(x)):
        before = faced(p.geometry, centre_of(p, w.d, ball), (w.x[ball, 0], w.x[ball, 1]))
        now = faced(p.geometry, centre_of(p, d, ball), (x[ball, 0], x[ball, 1]))
        if turned_far(before[0], now[0], tol.LONGEST_TURN):
            return False
        if turned_far(before[1], now[1], tol.LONGEST_TURN):
            return False
    return True


def _jumped(p: One, largest: float, w: Workspace) -> bool:
    """Whether an inner contact has opened or closed while its moment did not vanish."""
    for ball in range(len(w.grip)):
        before, now = w.first_grip[ball], w.grip[ball]
        changed = (before[0] > 0.0) != (now[0] > 0.0) and not p.one_branch
        moment = max(abs(before[1]), abs(now[1]))
        if changed and 2.0 * moment > tol.JUMP * p.geometry.ball_diameter * largest:
            return True
    return False
