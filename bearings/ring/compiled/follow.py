"""The two stages of ``bearings.ring.equilibrium`` for one state.

What is solved and when a stride is taken back is the same there; motions that no ball holds are
left to it.
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
    """The physical state: d (5,) and X (n, 2) written anew from a start, and whether there is one.

    ``near``: the start is a state close by, which is tried first.
    """
    blend, stride, direct = 0.0, tol.FIRST_BLEND, near and p.turning
    if not direct and not convex(p, d, x, w):
        return False
    if not p.placed:
        evaluate(p, d, x, 1.0, w)
        return True
    while blend < 1.0 and stride >= tol.SHORTEST_BLEND:  # one call of ``correct``: it compiles once
        target = 1.0 if direct or p.full == 0.0 else min(1.0, blend + stride)
        good, used = correct(p, d, x, p.full * target, w)
        if good:
            blend, stride = target, stride * (2.0 if used <= tol.QUICK_STEPS else 1.0)
        elif not direct:
            stride *= 0.25 * p.full  # full at blend 0: the only stride
        elif not convex(p, d, x, w):
            return False
        direct = False
    return blend >= 1.0


def correct(p: One, d: Array, x: Array, blend: float, w: Workspace) -> tuple[bool, int]:
    """Plain Newton at ``blend`` from a point close by, taken back where it fails.

    Returns success, and the iterations used.
    """
    put(w.d, d)
    put(w.x, x)
    needed, used = (tol.ON_THE_WAY if blend < p.full else tol.TOLERANCE), 0
    there = evaluate(p, d, x, blend, w)
    put(w.first_grip, w.grip)
    while error(p, there, w) >= needed and used < tol.NEWTON_STEPS:
        used += 1
        _newton(p, d, x, w)
        there = evaluate(p, d, x, blend, w)
    good = error(p, there, w) < needed
    if good and p.turning:
        good = there.fold > 0.0 and there.pressed and _turned_little(p, d, x, w)
        good = good and not _jumped(p, there.largest, w)
        good = good and (len(p.free) == 0 or eliminated(*_reduced(p, w.action, w))[1] > 0.0)
    if not good:
        put(d, w.d)
        put(x, w.x)
    return good, used


def convex(p: One, d: Array, x: Array, w: Workspace) -> bool:
    """(d, X) of the convex stage, written anew; whether it was reached."""
    there = evaluate_convex(p, d, x, w)
    reach = p.geometry.free_distance
    soft = tol.SOFT * p.geometry.balls * p.geometry.series_stiffness * np.sqrt(1e-3 * reach)
    for _ in range(tol.CONVEX_STEPS if len(p.free) else 0):
        k, gap = _reduced(p, w.action, w)
        largest, missing = np.abs(k).max(), np.abs(gap).max()
        size = p.load_size + 1e-3 * p.geometry.balls * there.largest
        needed = tol.BALANCED if p.turning else 0.1 * tol.TOLERANCE
        if missing <= needed * size + tol.ROUNDING * EPS * reach * largest:
            return True
        share = missing / (missing + p.load_size + 1e-300)
        for i in range(len(gap)):
            k[i, i] += soft + tol.SOFTEST * max(share, tol.HARDEST) * largest
        part, step = eliminated(k, gap)[0], np.zeros(5)
        shrink = min(1.0, tol.LONGEST_STEP * reach / max(np.abs(part).max(), 1e-300))
        for i, j in enumerate(p.free):
            step[j] = shrink * part[i] / p.scale[j]
        there = _searched(p, d, x, step, there, w)
    return len(p.free) == 0


def error(p: One, there: Evaluation, w: Workspace) -> float:
    """Scaled residual of balls and ring; rounding of the lengths is not counted."""
    c = p.geometry
    noise = tol.ROUNDING * rounding_force(c, there.largest) / tol.TOLERANCE
    worst = there.imbalance / (there.largest + noise + 1e-300)
    size = p.load_size + c.balls * (1e-3 * there.largest + noise) + 1e-300
    for j in p.free:
        worst = max(worst, abs(w.action[j] - p.load[j]) / p.scale[j] / size)
    return worst


def _newton(p: One, d: Array, x: Array, w: Workspace) -> None:
    """A Newton step of balls and ring together."""
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
    """Tangent and missing load of the free DOF, as lengths."""
    size = len(p.free)
    k, gap = np.empty((size, size)), np.empty(size)
    for i, row in enumerate(p.free):
        gap[i] = (p.load[row] - carried[row]) / p.scale[row]
        for j, column in enumerate(p.free):
            k[i, j] = w.stiffness[row, column] / p.scale[row] / p.scale[column]
    return k, gap


def eliminated(matrix: Array, right: Array) -> tuple[Array, float]:
    """x of ``matrix`` x = ``right``, and the determinant of the matrix over its largest entry.

    x = 0 where that is singular to rounding. Elimination with pivots: a library call would cost
    more than the work.
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
    p: One, d: Array, x: Array, step: Array, there: Evaluation, w: Workspace
) -> Evaluation:
    """A step of the convex stage, halved until the potential falls."""
    g, before = p.geometry, there.energy - (p.load * d).sum()
    load = 64.0 * p.load_size + 4.0 * g.balls * frozen_force(g, p.squared)
    most = before + EPS * (64.0 * abs(before) + g.free_distance * load)
    follow, length = w.follow.copy(), 1.0
    put(w.d, d)
    put(w.x, x)
    for _ in range(tol.HALVINGS):
        for j in p.free:
            d[j] = w.d[j] + length * step[j]
        for ball in range(len(x)):
            axial, radial = followed_by(follow[ball], moved(p, length * step, ball))
            x[ball, 0], x[ball, 1] = w.x[ball, 0] + axial, w.x[ball, 1] + radial
        there = evaluate_convex(p, d, x, w)
        if there.energy - (p.load * d).sum() <= most:
            break
        length *= 0.5
    return there


def _turned_little(p: One, d: Array, x: Array, w: Workspace) -> bool:
    """Whether no direction to a groove centre has turned far since the stride began."""
    for ball in range(len(x)):
        before = faced(p.geometry, centre_of(p, w.d, ball), (w.x[ball, 0], w.x[ball, 1]))
        now = faced(p.geometry, centre_of(p, d, ball), (x[ball, 0], x[ball, 1]))
        if turned_far(before[0], now[0], tol.LONGEST_TURN):
            return False
        if turned_far(before[1], now[1], tol.LONGEST_TURN):
            return False
    return True


def _jumped(p: One, largest: float, w: Workspace) -> bool:
    """Whether an inner contact has opened or closed with a moment that does not fade."""
    for ball in range(len(w.grip)):
        before, now = w.first_grip[ball], w.grip[ball]
        changed = (before[0] > 0.0) != (now[0] > 0.0) and not p.one_branch
        moment = max(abs(before[1]), abs(now[1]))
        if changed and 2.0 * moment > tol.JUMP * p.geometry.ball_diameter * largest:
            return True
    return False
