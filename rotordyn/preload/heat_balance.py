"""Temperatures of the bearings of a spindle from their heat, with the preload that results.

Every bearing has three nodes (``bearings.heat.temperature``); the preload couples bearings, since
growth of one ring loads all. Preload and temperatures are iterated in turn: the heat of contacts at
one state and of the oil, thinner as it warms, gives temperatures, these give the next state. Where
an iteration changes temperatures by more than half as much as the last one, as close to the limit,
they are extrapolated from both (D. G. Anderson, J. ACM 12 (1965) 547, with a depth of one).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

import bearings
from bearings.heat.temperature import HOTTEST, LONGEST, balanced
from rotordyn.arrays import Array, Flags
from rotordyn.machine.temperatures import MEASURED, BearingTemperatures, Temperatures

if TYPE_CHECKING:
    from bearings.heat.temperature import Conductances, Surroundings
    from bearings.lubricant import Lubricant
    from rotordyn.machine.spindle import Spindle
    from rotordyn.preload.state import PreloadState

Solve = Callable[[Temperatures], "PreloadState"]
TOLERANCE = 1e-3  # K
MOST = 80  # iterations
SLOW = 0.5  # of the previous step: larger ones are extrapolated


class Flow(NamedTuple):
    """Lubrication and cooling of bearings; ``friction``, ``oil_factor``: of their losses;
    ``housing_expansion`` along the axis [1/K], None where it is that of the fits."""

    lubricant: Lubricant
    conductances: Conductances
    surroundings: Surroundings
    friction: float
    oil_factor: float
    housing_expansion: float | None = None


class HeatBalance(NamedTuple):
    """Temperatures over speed, and an ``outcome`` per speed: empty, or why there is no balance
    (temperatures of the last iteration then); ``values`` of balls, inner and outer rings
    (speeds, bearings, 3) [°C]."""

    temperatures: Temperatures
    outcome: tuple[str, ...]
    values: Array


def heat_balance(
    solve: Solve, speed: Array, spindle: Spindle, flow: Flow, start: Array | None = None
) -> HeatBalance:
    """Return the temperatures of the bearings of ``spindle`` at every ``speed`` [rad/s], ascending.

    ``solve`` returns the preload state at given temperatures; they are iterated from ``start``
    (speeds, bearings, 3) [°C], by default those without any heat.
    """
    names = tuple(seat.name for seat in spindle.seats)
    pitches = np.array([seat.bearing.pitch_diameter for seat in spindle.seats])
    start = cold(flow) if start is None else start
    t = np.broadcast_to(start, (len(speed), len(names), 3)).copy()
    damping, last_size = np.ones(len(speed)), np.full(len(speed), np.inf)
    last_step, last_move = np.zeros_like(t), np.zeros_like(t)
    failures = np.full(len(speed), "", dtype=object)
    active = np.ones(len(speed), dtype=bool)
    for _ in range(MOST):
        state = solve(tables(t, speed, names, flow))
        contacts, usable = contact_heat(state, flow)
        for row in np.flatnonzero(active & ~usable):
            hottest = float(t[row].max(initial=MEASURED))
            failures[row] = f"at temperatures up to {hottest:.0f} °C {state.outcome[row]}"
        active &= usable
        step = _temperatures(contacts, pitches, speed, flow) - t
        size = np.abs(np.where(active[:, None, None], step, 0.0)).max(axis=(1, 2))
        continues = _dot(step, last_step) > 0.0
        oscillates = (size > last_size) & ~continues
        damping = np.where(oscillates, np.maximum(0.5 * damping, 0.1), damping)
        slow = continues & (size < last_size) & (size > SLOW * last_size)
        factor = damping[:, None, None]
        correction = _anderson(step, step - last_step, last_move + factor * (step - last_step))
        move = factor * step + np.where(slow[:, None, None], correction, 0.0)
        last_move = np.clip(move, -LONGEST, LONGEST)
        last_step, t = step, np.where(active[:, None, None], t + last_move, t)
        last_size = np.where(active, size, last_size)
        over = active & (t.max(axis=(1, 2)) > HOTTEST)
        for row in np.flatnonzero(over):
            failures[row] = run_away(t[row], names)
        active &= ~over & (size >= TOLERANCE)
        if not active.any():
            break
    failures[active] = "temperatures do not converge: cool more, lower the preload or use springs"
    outcome = tuple(
        f"bearings at {rpm:.0f} rpm: {failure}" if failure else ""
        for failure, rpm in zip(failures, speed * 30.0 / np.pi, strict=True)
    )
    return HeatBalance(tables(t, speed, names, flow), outcome, t)


def cold(flow: Flow) -> Array:
    """Return the temperatures of balls, inner and outer ring without any heat (3,) [°C]."""
    balance = balanced(lambda t: 0.0 * t, flow.conductances, flow.surroundings)
    return np.stack(balance[:3], axis=-1)


def _dot(a: Array, b: Array) -> Array:
    """Return the scalar products of steps (speeds, bearings, 3) at every speed."""
    return np.asarray((a * b).sum(axis=(1, 2)))


def _anderson(step: Array, change: Array, further: Array) -> Array:
    """Return Anderson's correction of the damped ``step`` f: ``change`` Δf since the last one,
    ``further`` Δx + β Δf, where Δx is the last move of temperatures and β the damping."""
    share = _dot(change, step) / np.maximum(_dot(change, change), 1e-300)
    return -share[:, None, None] * further


def run_away(values: Array, names: tuple[str, ...]) -> str:
    hot = [name for name, row in zip(names, values, strict=True) if row.max() > HOTTEST]
    return (
        f"temperatures run away at bearing{'s' * (len(hot) > 1)} {', '.join(hot)}, "
        f"{values.max():.0f} °C and rising; lower speed or preload, use a thinner oil or cool more"
    )


def tables(temperature: Array, speed: Array, names: tuple[str, ...], flow: Flow) -> Temperatures:
    """Return temperatures (speeds, bearings, 3) of balls, inner and outer rings as in files."""
    by_name = {
        name: BearingTemperatures(
            inner_ring=tuple(temperature[:, k, 1].tolist()),
            outer_ring=tuple(temperature[:, k, 2].tolist()),
            balls=tuple(temperature[:, k, 0].tolist()),
        )
        for k, name in enumerate(names)
    }
    around = flow.surroundings
    return Temperatures(
        shaft=around.shaft,
        housing=around.housing,
        bearings=by_name,
        speeds=tuple(speed.tolist()),
        housing_expansion=flow.housing_expansion,
    )


def contact_heat(state: PreloadState, flow: Flow) -> tuple[Array, Flags]:
    """Return heat of inner and outer contacts (speeds, bearings, 2) [W], and which states exist."""
    heat = np.zeros((len(state.speed), len(state.spindle.seats), 2))
    by_batch: dict[int, Array] = {}
    for k, (balls, column) in enumerate(state.seat_states()):
        if id(balls) not in by_batch:
            inner, outer = balls.operation.geometry.races
            power = bearings.heat.sliding(balls, flow.friction).power.sum(axis=-2)
            by_batch[id(balls)] = np.stack(
                [power[..., inner].sum(axis=-1), power[..., outer].sum(axis=-1)], axis=-1
            )
        heat[:, k] = by_batch[id(balls)][:, column]
    usable = np.array([outcome == "" for outcome in state.outcome])
    return np.where(usable[:, None, None], np.nan_to_num(heat), 0.0), usable


def spindle_heat(state: PreloadState, flow: Flow) -> Array:
    """Return the heat of contacts and oil of every bearing at the temperatures of a state
    (speeds, bearings) [W]."""
    seats, speed, temperatures = state.spindle.seats, state.speed, state.temperatures
    celsius = np.full((len(speed), len(seats), 3), MEASURED)
    if temperatures is not None:
        for k, seat in enumerate(seats):
            celsius[:, k, 0] = temperatures.reference + temperatures.rises(seat.name, speed).balls
    pitches = np.array([seat.bearing.pitch_diameter for seat in seats])
    contacts, _ = contact_heat(state, flow)
    return with_oil(contacts, celsius, pitches, speed, flow).sum(axis=-1)


def _temperatures(contacts: Array, pitches: Array, speed: Array, flow: Flow) -> Array:
    """Return temperatures in balance with the heat of contacts and oil (speeds, bearings, 3)."""

    def heat(temperature: Array) -> Array:
        return with_oil(contacts, temperature, pitches, speed, flow)

    balance = balanced(heat, flow.conductances, flow.surroundings, contacts.shape[:2])
    return np.stack(balance[:3], axis=-1)


def with_oil(
    contacts: Array, temperature: Array, pitches: Array, speed: Array, flow: Flow
) -> Array:
    """Return heat of inner contacts, outer contacts and oil (…, speeds, bearings, 3) [W];
    ``contacts`` (speeds, bearings, 2) [W], oil at ``temperature`` (…, speeds, bearings, 3) [°C]."""
    viscosity = flow.lubricant.kinematic(temperature[..., 0])
    oil = bearings.heat.viscous_moment(pitches, viscosity, speed[:, None], flow.oil_factor)
    repeated = np.broadcast_to(contacts, (*temperature.shape[:-1], 2))
    return np.concatenate([repeated, (oil * speed[:, None])[..., None]], axis=-1)
