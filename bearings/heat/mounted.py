"""A single bearing that warms up: temperatures, growth and preload together; its speed limit."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from bearings.arrays import Array, Flags, Words
from bearings.ball.law import STANDARD, Law
from bearings.errors import InvalidBearing, shown
from bearings.heat.temperature import (
    Conductances,
    Surroundings,
    Temperatures,
    balanced,
    parts,
    thermal_growth,
)
from bearings.heat.total import MODELS, Losses, losses

if TYPE_CHECKING:
    from bearings.bearing import BallBearing
    from bearings.lubricant import Lubricant
    from bearings.ring.state import BearingState

CLOSE, STILL = 0.005, 1e-6  # tolerances over the speed limit, and over the fastest speed


@dataclass(frozen=True, slots=True)
class Mounting:
    """Cooling, lubrication and axial mounting of a bearing.

    Parameters
    ----------
    lubricant, conductances, surroundings : of its heat
    rigid : the rings keep the axial place that the preload gives them at rest and 20 °C, so that
        growth raises the load; False: a spring keeps the load constant
    friction, oil_factor, model : of ``losses``
    law : hypotheses about the balls
    static_growth : of the inner groove at rest [m]
    """

    lubricant: Lubricant
    conductances: Conductances
    surroundings: Surroundings
    rigid: bool = True
    friction: float = 0.05
    oil_factor: float = 1.0
    model: str = MODELS[0]
    law: Law = STANDARD
    static_growth: float = 0.0


@dataclass(frozen=True, eq=False)
class ThermalState:
    """A bearing at its equilibrium temperatures, of leading shape (…).

    ``growth``, ``axial`` [m]: thermal, of inner against outer groove, on the radius and along the
    axis; ``state``: at these, its displacement that of the inner groove, which includes ``axial``;
    where ``temperatures.outcome`` is not empty they are those of the last iteration.
    """

    temperatures: Temperatures
    growth: Array
    axial: Array
    state: BearingState

    @property
    def outcome(self) -> Words:
        """Empty where temperatures reach a balance, else the reason why not (…)."""
        return self.temperatures.outcome

    @property
    def displacement(self) -> Array:
        """Displacement of the inner ring itself (…, 5) [m, rad]."""
        shifted = self.state.displacement.copy()
        shifted[..., 0] -= self.axial
        return shifted

    @property
    def axial_load(self) -> Array:
        """Axial load at the temperatures reached (…) [N]."""
        return np.asarray(self.state.load[..., 0])


def heated(
    bearing: BallBearing, mounting: Mounting, *, speed: ArrayLike, preload: ArrayLike
) -> ThermalState:
    """Solve the temperatures of a bearing at ``speed`` [rad/s] under an axial ``preload`` [N],
    which broadcast to one dimension or more.

    Raises
    ------
    InvalidBearing : see ``balanced``; a preload that is not positive
    """
    arguments = (np.atleast_1d(np.asarray(value, float)) for value in (speed, preload))
    omega, force = np.broadcast_arrays(*arguments)
    if not (force > 0.0).all():
        raise InvalidBearing(f"preload must be positive, got {shown(preload)}")
    state_at = _state_function(bearing, mounting, force)
    last: BearingState | None = None

    def heat(temperature: Array) -> Array:
        nonlocal last
        last = state_at(omega, *thermal_growth(bearing, temperature), last)
        return parts(_lost(last, mounting, temperature[..., 0]))

    reached = balanced(heat, mounting.conductances, mounting.surroundings, omega.shape)
    growth, axial = thermal_growth(bearing, np.stack(reached[:3], axis=-1))
    return ThermalState(reached, growth, axial, state_at(omega, growth, axial, None))


def speed_limit(
    bearing: BallBearing,
    mounting: Mounting,
    *,
    preload: ArrayLike,
    fastest: ArrayLike,
    slowest: ArrayLike = 0.0,
) -> Array:
    """Speed above which temperatures reach no balance, for every ``preload`` (n,) [N]; ``fastest``
    where they do up to there [rad/s]. Within half a per cent.

    It is computed by bisection between ``slowest``, where there is a balance, and ``fastest``, both
    one or (n,): a balance at still higher speeds, above a gap, is not detected.

    Raises
    ------
    InvalidBearing : as of ``heated``; a fastest speed that is not above the slowest one
    """
    if not (np.asarray(fastest) > np.asarray(slowest)).all():
        raise InvalidBearing(
            f"fastest must be a speed above {shown(slowest)} rad/s, got {shown(fastest)}"
        )
    force = np.atleast_1d(np.asarray(preload, float))

    def settles(speed: Array) -> Flags:
        return heated(bearing, mounting, speed=speed, preload=force).outcome == ""

    low, high, top = (
        np.broadcast_to(np.asarray(value, float), force.shape)
        for value in (slowest, fastest, fastest)
    )
    unlimited = settles(high)
    while not (unlimited | (high - low <= np.maximum(CLOSE * high, STILL * top))).all():
        middle = 0.5 * (low + high)
        balanced_there = settles(middle)
        low, high = np.where(balanced_there, middle, low), np.where(balanced_there, high, middle)
    return np.where(unlimited, top, low)


def _state_function(bearing: BallBearing, mounting: Mounting, force: Array) -> Any:
    """Return the state of the mounted bearing as a function of speed [rad/s] and of thermal growth
    and axial shift [m]."""
    load = np.zeros((*force.shape, 5))
    load[..., 0] = force
    common: dict[str, Any] = {**asdict(mounting.law), "static_growth": mounting.static_growth}
    at_rest = bearing.equilibrium(load=load, **common)
    rest_displacement = np.where((at_rest.outcome == "")[..., None], at_rest.displacement, 0.0)
    axis = np.array([1.0, 0.0, 0.0, 0.0, 0.0])

    def state(
        speed: Array, growth: Array, axial: Array, start: BearingState | None
    ) -> BearingState:
        shifted = {"displacement": rest_displacement + axial[..., None] * axis}
        return bearing.equilibrium(
            **(shifted if mounting.rigid else {"load": load}),
            speed=speed,
            growth=mounting.static_growth + growth,
            start=start,
            **common,
        )

    return state


def _lost(state: BearingState, mounting: Mounting, temperature: Array) -> Losses:
    """Losses with the oil at ``temperature`` (…) [°C]."""
    return losses(
        state,
        mounting.lubricant,
        temperature,
        friction=mounting.friction,
        oil_factor=mounting.oil_factor,
        model=mounting.model,
    )
