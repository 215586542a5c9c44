"""A ball eliminated from the balance of its ring (static condensation): a ring on springs.

A is the centre of the inner groove, X that of the ball, as in ``bearings.ball.balance``. Plain
expressions of floats or arrays, which compile as they are.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from bearings.ball.plane import (
    Block,
    Motion,
    Pair,
    Triple,
    combined,
    determinant,
    dot,
    inverse,
    plus,
)

Rows = tuple[Motion, Motion, Motion]


class Forces(NamedTuple):
    """Sum of forces on a ball and its action on the ring, at given A and X, linearised.

    ``residual`` [N]: sum of forces on the ball. ``action`` of the shaft on the ring through this
    ball: axial force, radial force [N], and the moment [N·m] that turns the ring at the ball about
    the middle of its groove. ``…_by_ball``, ``…_by_centre``: derivatives by X and by A, row by row.
    """

    residual: Pair
    residual_by_ball: Block
    residual_by_centre: tuple[Motion, Motion]
    action: Triple
    action_by_ball: tuple[Pair, Pair, Pair]
    action_by_centre: Rows


class Condensed(NamedTuple):
    """Load and tangent of the ring at a ball that follows its motion.

    ``fold``: determinant of the balance by X, positive on the physical branch. X moves by
    ``still`` + ``follow`` · ΔA; the action there is ``action`` + ``tangent`` · ΔA.
    """

    fold: Any
    still: Pair
    follow: tuple[Motion, Motion]
    action: Triple
    tangent: Rows


def condensed(f: Forces) -> Condensed:
    """Eliminate the ball from the linearised forces."""
    (p, q), (r, s) = inverse(f.residual_by_ball)
    (level, rise), (first, second) = f.residual, f.residual_by_centre
    still = (-p * level - q * rise, -r * level - s * rise)
    follow = (combined(-p, first, -q, second), combined(-r, first, -s, second))
    x, y, z = f.action_by_ball
    return Condensed(
        fold=determinant(f.residual_by_ball),
        still=still,
        follow=follow,
        action=(
            f.action[0] + dot(x, still),
            f.action[1] + dot(y, still),
            f.action[2] + dot(z, still),
        ),
        tangent=(
            plus(f.action_by_centre[0], combined(x[0], follow[0], x[1], follow[1])),
            plus(f.action_by_centre[1], combined(y[0], follow[0], y[1], follow[1])),
            plus(f.action_by_centre[2], combined(z[0], follow[0], z[1], follow[1])),
        ),
    )
