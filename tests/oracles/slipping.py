"""A ball whose races hold only so much friction, balanced without a word of the product's code.

The moment is what the weaker race holds; the tangent of the axis' inclination falls in the same
ratio from where the hypothesis puts it; then forces are summed.
"""

from __future__ import annotations

import math
from typing import Any

from tests.oracles.ball_bearing import BallBearingOracle, rolling


def moment(oracle: BallBearingOracle, speed: float, ai: float, ao: float, beta: float) -> float:
    """Mg of a ball that turns about an axis inclined by β, rolling at both contacts."""
    bearing, g = oracle.bearing, oracle.g
    outer = g * math.cos(ao - beta) / (1.0 + g * math.cos(ao))
    inner = g * math.cos(ai - beta) / (1.0 - g * math.cos(ai))
    spin = 1.0 / (outer + inner)
    inertia = bearing.ball_material.density * math.pi * bearing.ball_diameter**5 / 60.0
    return inertia * speed**2 * outer * spin * spin * math.sin(beta)


def axis(
    oracle: BallBearingOracle, speed: float, state: Any, ball: int, friction: float, share: float
) -> tuple[float, float]:
    """β to which the ball yields, and Mg/D that its races hold."""
    qi, qo = state.inner_load[ball], state.outer_load[ball]
    ai, ao = state.inner_angle[ball], state.outer_angle[ball]
    weight = (qi / qo) ** (4 / 3) * (oracle.inner.a1 * oracle.inner.e)
    weight /= oracle.outer.a1 * oracle.outer.e
    wanted = float(rolling(ai, ao, oracle.g, weight, oracle.kinematics)[2])
    need = abs(moment(oracle, speed, ai, ao, wanted)) / oracle.d
    held = min(
        1.0,
        friction * qi / (share * need) if share else 1.0,
        friction * qo / ((2.0 - share) * need) if share < 2.0 else 1.0,
    )
    return math.atan(held * math.tan(wanted)), held * need


def imbalance(
    oracle: BallBearingOracle, speed: float, state: Any, ball: int, friction: float, share: float
) -> float:
    """Sum of forces on a loaded ball over its outer load."""
    beta, force = axis(oracle, speed, state, ball, friction, share)
    ai, ao = state.inner_angle[ball], state.outer_angle[ball]
    qi, qo, bearing, g = state.inner_load[ball], state.outer_load[ball], oracle.bearing, oracle.g
    outer = g * math.cos(ao - beta) / (1.0 + g * math.cos(ao))
    inner = g * math.cos(ai - beta) / (1.0 - g * math.cos(ai))
    orbit = outer / (outer + inner)
    mass = bearing.ball_material.density * math.pi * bearing.ball_diameter**3 / 6.0
    push = 0.5 * mass * bearing.pitch_diameter * (orbit * speed) ** 2
    ti, to = share * force, (2.0 - share) * force
    axial = qi * math.sin(ai) - qo * math.sin(ao) + ti * math.cos(ai) - to * math.cos(ao)
    radial = qi * math.cos(ai) - qo * math.cos(ao) - ti * math.sin(ai) + to * math.sin(ao) + push
    return max(abs(axial), abs(radial)) / qo
