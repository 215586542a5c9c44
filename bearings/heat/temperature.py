"""Temperatures of balls and rings where heat flows through given conductances.

Three nodes. The heat of a contact goes half to the balls and half to the ring, that of the oil to
the balls, which it bathes. What the temperatures change (viscosity, growth, preload) changes the
heat: the balance is iterated, and where it settles nowhere the bearing runs away.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearings.errors import InvalidBearing, NoEquilibrium
from bearings.heat.total import losses

if TYPE_CHECKING:
    from bearings.bearing import BallBearing
    from bearings.lubricant import Lubricant
    from bearings.ring.state import BearingState

Array = NDArray[np.float64]
Heat = Callable[[Array], tuple[float, float, float]]
HOTTEST = 250.0  # °C, beyond which no bearing runs
TOLERANCE = 1e-6  # K
MOST = 600
LONGEST = 5.0  # K, of one step: cold oil heats more than the bearing ever will
STEEL_EXPANSION = 11.5e-6  # 1/K
REFERENCE = 20.0  # °C, at which bearings are measured


class Conductances(NamedTuple):
    """Of heat [W/K]: inner ring to shaft, outer ring to housing, balls to oil, and balls to either
    ring through contacts and film."""

    inner_shaft: float
    outer_housing: float
    balls_oil: float = 0.0
    balls_inner: float = 1.0
    balls_outer: float = 1.0


class Surroundings(NamedTuple):
    """Temperatures [°C] that do not change."""

    shaft: float
    housing: float
    oil: float


class Heated(NamedTuple):
    """Where a bearing settles: temperatures [°C] of ``balls``, ``inner`` and ``outer`` ring;
    ``heat`` [W] of inner contacts, outer contacts and oil; ``outcome``: ``""``, or why there is no
    balance (values of the last iteration); ``state``: of the bearing, if one was solved."""

    balls: float
    inner: float
    outer: float
    heat: tuple[float, float, float]
    outcome: str
    state: BearingState | None = None


def settled(heat: Heat, conductances: Conductances, surroundings: Surroundings) -> Heated:
    """Temperatures at which the heat, ``heat(temperatures)`` [W] of balls, inner and outer ring
    [°C], flows off.

    Raises
    ------
    InvalidBearing : conductances below 0, or nothing through which heat leaves
    """
    c, t = conductances, surroundings
    if min(c) < 0.0 or not (c.inner_shaft + c.outer_housing + c.balls_oil) > 0.0:
        raise InvalidBearing(
            f"heat must leave the bearing: conductances from 0 W/K up, one to shaft, housing or "
            f"oil above 0, got {c}"
        )
    matrix = np.array(
        [
            [c.balls_oil + c.balls_inner + c.balls_outer, -c.balls_inner, -c.balls_outer],
            [-c.balls_inner, c.inner_shaft + c.balls_inner, 0.0],
            [-c.balls_outer, 0.0, c.outer_housing + c.balls_outer],
        ]
    )
    outside = np.array([c.balls_oil * t.oil, c.inner_shaft * t.shaft, c.outer_housing * t.housing])
    here, damping, before = np.linalg.solve(matrix, outside), 0.5, np.inf
    power = (0.0, 0.0, 0.0)
    for _ in range(MOST):
        power = heat(here)
        inner, outer, oil = power
        source = np.array([0.5 * (inner + outer) + oil, 0.5 * inner, 0.5 * outer])
        step = np.linalg.solve(matrix, outside + source) - here
        size = float(np.abs(step).max())
        damping = max(0.5 * damping, 0.02) if size > before else min(1.2 * damping, 1.0)
        here, before = here + np.clip(damping * step, -LONGEST, LONGEST), size
        if size < TOLERANCE:
            return Heated(float(here[0]), float(here[1]), float(here[2]), power, "")
        if here.max() > HOTTEST:
            break
    word = (
        f"temperatures run away: {here.max():.0f} °C and rising; lower speed or preload, take a "
        "thinner oil or cool more"
        if here.max() > HOTTEST
        else f"temperatures do not settle, {before:.2g} K off"
    )
    return Heated(float(here[0]), float(here[1]), float(here[2]), power, word)


def heated(  # noqa: PLR0913 - all of it describes one question
    bearing: BallBearing,
    *,
    speed: float,
    preload: float,
    lubricant: Lubricant,
    conductances: Conductances,
    surroundings: Surroundings,
    rigid: bool = True,
    friction: float = 0.05,
    oil_factor: float = 1.0,
    ring_expansion: float = STEEL_EXPANSION,
    ball_expansion: float = STEEL_EXPANSION,
) -> Heated:
    """Temperatures of a bearing at ``speed`` [rad/s] under an axial ``preload`` [N].

    ``rigid``: the rings keep the axial place that the preload gives them at rest and 20 °C, so that
    growth raises it; else a spring holds the load. Expansions [1/K]: 3.2e-6 of silicon nitride.
    The outcome names a run-away, or that the bearing has no state at the temperatures reached.
    """
    alone = [preload, 0.0, 0.0, 0.0, 0.0]
    place = bearing.equilibrium(load=alone).displacement
    held: list[BearingState] = []

    def heat(temperature: Array) -> tuple[float, float, float]:
        growth = thermal_growth(bearing, temperature, ring_expansion, ball_expansion)
        asked = {"displacement": place} if rigid else {"load": alone}
        state = bearing.equilibrium(**asked, speed=speed, growth=growth)
        held[:] = [state]
        lost = losses(state, lubricant, temperature[0], friction=friction, oil_factor=oil_factor)
        return float(lost.inner), float(lost.outer), float(lost.viscous)

    try:
        found = settled(heat, conductances, surroundings)
    except NoEquilibrium as error:
        nothing = (np.nan, np.nan, np.nan)
        return Heated(
            np.nan, np.nan, np.nan, nothing, f"no state at the temperatures reached: {error}"
        )
    return found._replace(state=held[-1])


def thermal_growth(
    bearing: BallBearing, temperature: Array, ring_expansion: float, ball_expansion: float
) -> float:
    """Radial growth of inner against outer groove [m] at ``temperature`` (3,) of balls, inner and
    outer ring [°C], the balls' own in it: a bearing of one material that warms evenly keeps its
    angle."""
    balls, inner, outer = np.asarray(temperature, float) - REFERENCE
    ball = bearing.ball_diameter * np.cos(bearing.free_angle)
    rings = (
        0.5 * ring_expansion * ((inner - outer) * bearing.pitch_diameter - ball * (inner + outer))
    )
    return float(rings + ball_expansion * ball * balls)
