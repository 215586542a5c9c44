"""The two stages of ``bearings.ring.equilibrium`` for one state.

What is solved and when a stride is taken back is the same there; motions that no ball holds are
left to it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearings.ball.plane import EPS, turned_far
from bearings.ring.compiled.dense import solve
from bearings.ring.compiled.one_state import (
    Evaluation,
    One,
    Work,
    centre_of,
    evaluate,
    evaluate_convex,
    followed,
    moved,
)
from bearings.ring.tolerances import (
    CONVEX_STEPS,
    FIRST_BLEND,
    HALVINGS,
    JUMP,
    LONGEST_STEP,
    LONGEST_TURN,
    NEWTON_STEPS,
    ON_THE_WAY,
    QUICK_STEPS,
    ROUNDING,
    SETTLED,
    SHORTEST_BLEND,
    SOFT,
    SOFTEST,
    TOLERANCE,
)

Array = NDArray[np.float64]


def find(p: One, d: Array, x: Array, near: bool, w: Work) -> bool:
    """The physical state: d (5,) and X (n, 2) written anew from a start, and whether there is one.

    ``near``: the start is a state close by, which is tried first.
    """
    blend, stride, direct = 0.0, FIRST_BLEND, near and p.turning
    if not direct and not convex(p, d, x, w):
        return False
    if not p.placed:
        evaluate(p, d, x, 1.0, w)
        return True
    if p.full == 0.0 and not direct:
        return _tried(p, d, x, 0.0, w)[0]
    while blend < 1.0 and stride >= SHORTEST_BLEND:  # one call of _tried: it compiles only once
        target = 1.0 if direct else min(1.0, blend + stride)
        good, used = _tried(p, d, x, p.full * target, w)
        if good:
            blend, stride = target, stride * (2.0 if used <= QUICK_STEPS else 1.0)
        elif not direct:
            stride *= 0.25
        elif not convex(p, d, x, w):
            return False
        direct = False
    return blend >= 1.0


def _tried(p: One, d: Array, x: Array, blend: float, w: Work) -> tuple[bool, int]:
    """``correct``, taken back where it fails."""
    w.d[:], w.x[:] = d, x
    good, used = correct(p, d, x, blend, w)
    if not good:
        d[:], x[:] = w.d, w.x
    return good, used


def correct(p: One, d: Array, x: Array, blend: float, w: Work) -> tuple[bool, int]:
    """Plain Newton at ``blend`` from a point close by, kept: success, and the iterations used."""
    needed, used = (ON_THE_WAY if blend < p.full else TOLERANCE), 0
    found = evaluate(p, d, x, blend, w)
    w.first_grip[:] = w.grip
    while error(p, found, w) >= needed and used < NEWTON_STEPS:
        used += 1
        _newton(p, d, x, w)
        found = evaluate(p, d, x, blend, w)
    if not p.turning:
        return error(p, found, w) < needed, used
    good = error(p, found, w) < needed and found.fold > 0.0 and found.pressed
    good = good and _turned_little(p, w.d, w.x, d, x) and not _jumped(p, found.largest, w)
    return good and (len(p.free) == 0 or _missing(p, w.action, w)[1] > 0.0), used


def convex(p: One, d: Array, x: Array, w: Work) -> bool:
    """(d, X) of the convex stage, written anew; whether it was reached."""
    found = evaluate_convex(p, d, x, w)
    if len(p.free) == 0:
        return True
    soft = SOFT * p.geometry.balls * p.geometry.series_stiffness
    soft *= np.sqrt(1e-3 * (p.geometry.inner_reach + p.geometry.outer_reach))
    for _ in range(CONVEX_STEPS):
        if _settled(p, found, w):
            return True
        step = _missing_step(p, soft, w)
        found = _searched(p, d, x, step, found, w)
    return _settled(p, found, w)


def error(p: One, found: Evaluation, w: Work) -> float:
    """Scaled residual of balls and ring; rounding of the lengths is not counted."""
    c = p.geometry
    reach = c.inner_reach + c.outer_reach
    largest = max(found.largest, 1e-300)
    noise = (
        ROUNDING * EPS * reach * 1.5 * (c.inner.stiffness**2 * largest) ** (1.0 / 3.0) / TOLERANCE
    )
    worst = found.imbalance / (largest + noise)
    size = p.load_size + p.geometry.balls * (1e-3 * found.largest + noise) + 1e-300
    for j in p.free:
        worst = max(worst, abs(w.action[j] - p.load[j]) / p.scale[j] / size)
    return worst


def _newton(p: One, d: Array, x: Array, w: Work) -> None:
    """A Newton step of balls and ring together."""
    step = np.zeros(5)
    if len(p.free):
        part = _missing(p, w.settled, w)[0]
        for i, j in enumerate(p.free):
            step[j] = part[i] / p.scale[j]
            d[j] += step[j]
    for ball in range(len(x)):
        axial, radial = followed(w.follow[ball], moved(p, step, ball))
        x[ball, 0] += w.still[ball, 0] + axial
        x[ball, 1] += w.still[ball, 1] + radial


def _reduced(p: One, carried: Array, w: Work) -> tuple[Array, Array]:
    """Tangent and missing load of the free freedoms, as lengths."""
    size = len(p.free)
    k, gap = np.empty((size, size)), np.empty(size)
    for i, row in enumerate(p.free):
        gap[i] = (p.load[row] - carried[row]) / p.scale[row]
        for j, column in enumerate(p.free):
            k[i, j] = w.stiffness[row, column] / p.scale[row] / p.scale[column]
    return k, gap


def _missing(p: One, carried: Array, w: Work) -> tuple[Array, float]:
    """What moves the ring to its load, as lengths, and the determinant of the tangent."""
    k, gap = _reduced(p, carried, w)
    return solve(k, gap)


def _missing_step(p: One, soft: float, w: Work) -> Array:
    """Step of the convex stage (5,), its length bounded."""
    k, gap = _reduced(p, w.action, w)
    soft += SOFTEST * np.abs(k).max()
    for i in range(len(gap)):
        k[i, i] += soft
    part, step = solve(k, gap)[0], np.zeros(5)
    longest = LONGEST_STEP * (p.geometry.inner_reach + p.geometry.outer_reach)
    shrink = min(1.0, longest / max(np.abs(part).max(), 1e-300))
    for i, j in enumerate(p.free):
        step[j] = shrink * part[i] / p.scale[j]
    return step


def _settled(p: One, found: Evaluation, w: Work) -> bool:
    """Whether the convex stage carries the load."""
    k, gap = _reduced(p, w.action, w)
    c, size = p.geometry, p.load_size + 1e-3 * p.geometry.balls * found.largest
    noise = ROUNDING * EPS * (c.inner_reach + c.outer_reach) * np.abs(k).max()
    needed = SETTLED if p.turning else 0.1 * TOLERANCE
    return np.abs(gap).max() <= needed * size + noise


def _searched(p: One, d: Array, x: Array, step: Array, found: Evaluation, w: Work) -> Evaluation:
    """A step of the convex stage, halved until the potential falls."""
    reach = p.geometry.inner_reach + p.geometry.outer_reach
    before = found.energy - _work(p, d)
    most = before + 64.0 * EPS * (abs(before) + p.load_size * reach)
    follow, length = w.follow.copy(), 1.0
    w.d[:], w.x[:] = d, x
    for _ in range(HALVINGS):
        for j in range(5):
            d[j] = w.d[j] + length * step[j]
        for ball in range(len(x)):
            axial, radial = followed(follow[ball], moved(p, length * step, ball))
            x[ball, 0], x[ball, 1] = w.x[ball, 0] + axial, w.x[ball, 1] + radial
        found = evaluate_convex(p, d, x, w)
        if found.energy - _work(p, d) <= most:
            break
        length *= 0.5
    return found


def _work(p: One, d: Array) -> float:
    """Work of the load."""
    total = 0.0
    for j in p.free:
        total += p.load[j] * d[j]
    return total


def _turned_little(p: One, there: Array, at: Array, d: Array, x: Array) -> bool:
    """Whether no direction to a groove centre has turned far since (there, at)."""
    for ball in range(len(x)):
        before, now = centre_of(p, there, ball), centre_of(p, d, ball)
        turned = turned_far((at[ball, 0], at[ball, 1]), (x[ball, 0], x[ball, 1]), LONGEST_TURN)
        inner = (before[0] - at[ball, 0], before[1] - at[ball, 1])
        turned |= turned_far(inner, (now[0] - x[ball, 0], now[1] - x[ball, 1]), LONGEST_TURN)
        if turned:
            return False
    return True


def _jumped(p: One, largest: float, w: Work) -> bool:
    """Whether an inner contact has opened or closed with a moment that does not fade."""
    if p.one_branch:
        return False
    for ball in range(len(w.grip)):
        before, now = w.first_grip[ball], w.grip[ball]
        changed = (before[0] > 0.0) != (now[0] > 0.0)
        moment = max(abs(before[1]), abs(now[1]))
        if changed and 2.0 * moment > JUMP * p.geometry.ball_diameter * largest:
            return True
    return False
