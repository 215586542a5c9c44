"""Temperatures of balls and rings where heat flows through given conductances.

Three nodes. The heat of a contact goes half to the balls and half to the ring, that of the oil to
the balls, which it bathes. The temperatures change viscosity, growth and preload, and these the
heat: the balance is iterated; without one the temperatures run away.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from bearings.arguments import checked
from bearings.arrays import Array, Flags, Words
from bearings.errors import InvalidBearing

if TYPE_CHECKING:
    from bearings.bearing import BallBearing
    from bearings.heat.total import Losses

Heat = Callable[[Array], Any]
HOTTEST = 250.0  # °C, beyond which temperatures count as running away
TOLERANCE = 1e-5  # K
MOST = 150  # iterations
LONGEST = 20.0  # K, of one step: cold oil heats more than the bearing ever will
_NUDGE = 0.02  # K, of finite differences: unchanged, then each node warmer
_MOVES = np.concatenate([np.zeros((1, 3)), _NUDGE * np.eye(3)])
_STABLE = 1e-3  # K/K, least decay of a small warming at which Newton's step is taken
_LEAST = 1.0  # K, of other steps: near an unstable balance smaller ones would stall
REFERENCE = 20.0  # °C, at which bearings are measured


class Conductances(NamedTuple):
    """Thermal conductances [W/K]: inner ring to shaft, outer ring to housing, balls to oil, and
    balls to either ring through contacts and film, where 1 is a guess."""

    inner_shaft: float
    outer_housing: float
    balls_oil: float = 0.0
    balls_inner: float = 1.0
    balls_outer: float = 1.0


class Surroundings(NamedTuple):
    """Fixed temperatures of the surroundings [°C]."""

    shaft: float
    housing: float
    oil: float


class Temperatures(NamedTuple):
    """Temperatures of balls, inner and outer ring (…) [°C], with the ``heat`` (…, 3) [W] of inner
    contacts, outer contacts and oil; ``outcome`` (…): ``""``, or why there is no balance (values of
    the last iteration)."""

    balls: Array
    inner: Array
    outer: Array
    heat: Array
    outcome: Words


def balanced(
    heat: Heat,
    conductances: Conductances,
    surroundings: Surroundings,
    shape: tuple[int, ...] = (),
    tolerance: float = TOLERANCE,
) -> Temperatures:
    """Solve the temperatures at which heat balances, of bearings that do not interact.

    Parameters
    ----------
    heat : function of the temperatures of balls, inner and outer ring (4, …, 3) [°C], the current
        ones and each node warmer by ``_NUDGE``, to the heat of inner contacts, outer contacts and
        oil (4, …, 3) [W]; NaN where no state exists
    shape : leading shape (…)
    tolerance : largest change of a temperature at the end [K]

    Raises
    ------
    InvalidBearing : conductances below 0, or nothing through which heat leaves
    """
    matrix, outside = network(conductances, surroundings)

    def gap(temperature: Array) -> tuple[Array, Array]:
        power = np.broadcast_to(np.asarray(heat(temperature), float), temperature.shape)
        warmed = np.linalg.solve(matrix, (outside + sources(power))[..., None])[..., 0]
        return warmed - temperature, power

    temperatures = np.broadcast_to(np.linalg.solve(matrix, outside), (*shape, 3)).copy()
    size, power = np.full(shape, np.inf), np.zeros((*shape, 3))
    active, stateless = np.ones(shape, dtype=bool), np.zeros(shape, dtype=bool)
    for _ in range(MOST):
        gaps, powers = gap(temperatures + _MOVES.reshape(4, *[1] * len(shape), 3))
        temperatures, size, power = (
            np.where(active.reshape(active.shape + (1,) * (new.ndim - active.ndim)), new, old)
            for new, old in (
                (temperatures + _step(gaps), temperatures),
                (np.abs(gaps[0]).max(axis=-1), size),
                (powers[0], power),
            )
        )
        stateless |= active & ~np.isfinite(gaps).all(axis=(0, -1))
        active &= ~stateless & (size >= tolerance) & (temperatures.max(axis=-1) <= HOTTEST)
        if not active.any():
            break
    words = _words(temperatures, size, stateless, tolerance)
    return Temperatures(
        temperatures[..., 0], temperatures[..., 1], temperatures[..., 2], power, words
    )


def _step(gaps: Array) -> Array:
    """Step of the temperatures towards those that their heat leads to (…, 3) [K].

    ``gaps`` (4, …, 3): differences of both, at the current temperatures and with each node warmer
    by ``_NUDGE``. It is Newton's where a small warming decays (negative eigenvalues), as below the
    balance that a cold bearing reaches first; elsewhere it is the gap itself, ``_LEAST`` at least,
    as the bearing would warm or cool in time. NaN gaps give no step.
    """
    residual = np.nan_to_num(gaps[0])
    slope = np.nan_to_num(np.moveaxis(gaps[1:] - gaps[0], 0, -1)) / _NUDGE  # (…, to, of)
    stable = np.linalg.eigvals(slope).real.max(axis=-1) < -_STABLE
    safe = np.where(stable[..., None, None], slope, -np.eye(3))
    newton = -np.linalg.solve(safe, residual[..., None])[..., 0]
    largest = np.abs(residual).max(axis=-1, keepdims=True)
    decay_step = residual * np.maximum(1.0, _LEAST / np.maximum(largest, 1e-300))
    step = np.where(stable[..., None], newton, decay_step)
    size = np.abs(step).max(axis=-1, keepdims=True)
    return np.asarray(step * np.minimum(1.0, LONGEST / np.maximum(size, 1e-300)))


def network(c: Conductances, t: Surroundings) -> tuple[Array, Array]:
    """Conductance matrix of the nodes balls, inner and outer ring (3, 3) [W/K], and the heat from
    the surroundings into them at 0 °C (3,) [W]."""
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
    if abs(np.linalg.det(matrix)) <= 1e-12 * np.prod(np.abs(np.diag(matrix)) + 1e-300):
        raise InvalidBearing(f"heat of a ring or of the balls cannot leave: got {c}")
    outside = np.array([c.balls_oil * t.oil, c.inner_shaft * t.shaft, c.outer_housing * t.housing])
    return matrix, outside


def sources(power: Array) -> Array:
    """Heat that enters the nodes (…, 3) [W]."""
    inner, outer, oil = np.moveaxis(power, -1, 0)
    return np.stack([0.5 * (inner + outer) + oil, 0.5 * inner, 0.5 * outer], axis=-1)


def _words(temperatures: Array, size: Array, stateless: Flags, tolerance: float) -> Words:
    """Outcome of ``temperatures`` (…, 3), ``size`` (…) [K] off their balance."""
    hottest = temperatures.max(axis=-1)
    outcomes = np.full(stateless.shape, "", dtype=object)
    for at in np.ndindex(stateless.shape):
        if stateless[at]:
            outcomes[at] = f"no state at the temperatures reached, {hottest[at]:.0f} °C"
        elif hottest[at] > HOTTEST:
            outcomes[at] = (
                f"temperatures run away: {hottest[at]:.0f} °C and rising; lower speed or preload, "
                "take a thinner oil or cool more"
            )
        elif size[at] >= tolerance:
            outcomes[at] = f"temperatures do not converge, {size[at]:.2g} K off"
    return outcomes.astype(str)


def parts(lost: Losses) -> Array:
    """Heat of inner contacts, outer contacts and oil (…, 3) [W]."""
    return np.stack([lost.inner, lost.outer, lost.viscous], axis=-1)


@checked
def thermal_growth(bearing: BallBearing, temperature: Array) -> tuple[Array, Array]:
    """Growth of the inner against the outer groove, on the radius, and its shift in the direction
    that loads the bearing, both (…) [m], of rings that expand freely at ``temperature`` (…, 3) of
    balls, inner and outer ring [°C].

    It is exact to first order in the rises above 20 °C: a bearing of one material that warms
    uniformly keeps its angle and its load.
    """
    balls, inner, outer = np.moveaxis(np.asarray(temperature, float), -1, 0) - REFERENCE
    races = inner * bearing.inner_raceway_radius - outer * bearing.outer_raceway_radius
    radial, axial = ball_expansion(bearing, balls, inner, outer)
    return bearing.ring_material.expansion * races + radial, axial


def ball_expansion(
    bearing: BallBearing, balls: Array, inner: Array, outer: Array
) -> tuple[Array, Array]:
    """Contribution of the expansion of the balls to radial growth and axial shift [m].

    ``balls``, ``inner``, ``outer``: rises of temperature [K]. Between contacts at the free angle α0
    balls grow by D αb Tb, the adjacent parts of the rings by ½ D α (Ti + To): the groove centres
    approach by the difference e along the contact line, hence by e sin α0 along the axis. A
    bearing that takes thrust in both directions has no such side: there a radial growth of
    e/cos α0 reduces the play as much.
    """
    sine, cosine = math.sin(bearing.free_angle), math.cos(bearing.free_angle)
    ball_growth = bearing.ball_diameter * bearing.ball_material.expansion * balls
    ring_growth = 0.5 * bearing.ball_diameter * bearing.ring_material.expansion
    closer = ball_growth - ring_growth * (inner + outer)
    if bearing.both_ways:
        return ball_growth * cosine + closer * sine**2 / cosine, 0.0 * closer
    return ball_growth * cosine, closer * sine
