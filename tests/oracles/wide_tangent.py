"""K of a turning bearing by differences in extended precision, ball by ball.

Where balls carry millinewtons, a difference in double precision may be mostly rounding of lengths.
Where ``numpy.longdouble`` has more digits (``DIGITS``) every ball is solved for again, in the
equations of ``ball_equations``, at inner groove centres moved by a small part of its approach.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tests.oracles.ball_equations import Balls

Array = NDArray[np.float64]
Wide = NDArray[np.longdouble]
DIGITS = np.finfo(np.longdouble).nmant > np.finfo(float).nmant  # whether it has more than double
PART = 1e-2  # of the approach
ROUNDS = 12
SETTLED = 1e3  # roundings of the lengths, as a force
FIVE_POINTS = ((1, 8), (-1, -8), (2, -1), (-2, 1))


def wide_tangent(
    balls: Balls, d: Array, x: Array, speed: float, growth: tuple[float, float]
) -> Array:
    """∂f/∂d (5, 5) at a displacement (5,), from ball centres (2, n) close by.

    ``growth``: static and whole; contacts that are open stay so.

    Raises
    ------
    ArithmeticError : a ball does not settle
    """
    whole = balls.centres(d.astype(np.longdouble), *np.longdouble(growth))
    held = np.hypot(*(whole - x)) > balls.li
    a, x = whole[:, held], x[:, held].astype(np.longdouble)
    h = PART * (np.hypot(*(a - x)) - balls.li)
    slope = np.zeros((3, 2, balls.psi.size))
    for k in range(2):
        way = h * np.eye(2)[:, k : k + 1]
        parts = [w * _action(balls, a + m * way, x, speed) for m, w in FIVE_POINTS]
        slope[:, k, held] = sum(parts) / (12 * h)
    c, s, r = np.cos(balls.psi), np.sin(balls.psi), balls.radius
    one, no = np.ones_like(c), np.zeros_like(c)
    moves = np.array([[one, no], [no, c], [no, s], [r * s, no], [-r * c, no]])
    action = np.einsum("ikn,jkn->ijn", slope, moves)
    return balls.ring_load(action).T


def _action(balls: Balls, a: Wide, x: Wide, speed: float) -> Wide:
    """(fa, fr, m) of every ball, settled."""
    fault = _fault(balls, a, x, speed)
    for _ in range(ROUNDS):
        x = x - _divided(fault, _slope(balls, a, x, speed))
        fault = _fault(balls, a, x, speed)
    b = balls.loads(a, x, speed)
    stiff = 1.5 * (max(balls.inner.k, balls.outer.k) ** 2 * b["qo"]) ** (1 / 3)
    rounding = np.finfo(np.longdouble).eps * (balls.li + balls.lo) * stiff
    if not (np.abs(fault) < SETTLED * rounding).all():
        raise ArithmeticError("a ball does not settle")
    return balls.forces(b)[1]


def _fault(balls: Balls, a: Wide, x: Wide, speed: float) -> Wide:
    return balls.forces(balls.loads(a, x, speed))[0]


def _slope(balls: Balls, a: Wide, x: Wide, speed: float) -> Wide:
    """∂fault/∂X (2, 2, n)."""
    h = 1e-4 * (np.hypot(*(a - x)) - balls.li)
    ways = [h * np.eye(2)[:, k : k + 1] for k in range(2)]
    return np.stack(
        [(_fault(balls, a, x + w, speed) - _fault(balls, a, x - w, speed)) / (2 * h) for w in ways],
        axis=1,
    )


def _divided(v: Wide, m: Wide) -> Wide:
    """m⁻¹ v, ball by ball."""
    size = m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0]
    return np.array([m[1, 1] * v[0] - m[0, 1] * v[1], m[0, 0] * v[1] - m[1, 0] * v[0]]) / size
