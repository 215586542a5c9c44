"""Temperatures of all bearings of a spindle from the heat they make, with the preload that follows.

Every bearing has three nodes (``bearings.heat.temperature``); the preload joins them, since growth
of one ring loads all. Preload and temperatures are found in turn: at the state of each turn the
temperatures that its contacts and the thinning of the oil lead to, at these the next state. Where
a turn changes temperatures by more than half of what the last one did, as close to the limit, they
are extrapolated by the last two (D. G. Anderson, J. ACM 12 (1965) 547, with a depth of one).
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
MOST = 80
SLOW = 0.5  # of the step before, above which turns are extrapolated


class Flow(NamedTuple):
    """How bearings are lubricated and cooled; ``friction``, ``oil_factor``: of their losses."""

    lubricant: Lubricant
    conductances: Conductances
    surroundings: Surroundings
    friction: float
    oil_factor: float


class HeatBalance(NamedTuple):
    """``temperatures`` over speed, and per speed an ``outcome``: empty, or why there is no
    balance (those of the last turn then)."""

    temperatures: Temperatures
    outcome: tuple[str, ...]


def heat_balance(solve: Solve, speed: Array, spindle: Spindle, flow: Flow) -> HeatBalance:
    """Temperatures of the bearings of ``spindle`` at every ``speed`` [rad/s], ascending.

    ``solve`` gives the preload state at temperatures.
    """
    names = tuple(seat.name for seat in spindle.seats)
    pitches = np.array([seat.bearing.pitch_diameter for seat in spindle.seats])
    here = np.broadcast_to(cold(flow), (len(speed), len(names), 3)).copy()
    damping, before = np.ones(len(speed)), np.full(len(speed), np.inf)
    last, moved = np.zeros_like(here), np.zeros_like(here)
    words = np.full(len(speed), "", dtype=object)
    active = np.ones(len(speed), dtype=bool)
    for _ in range(MOST):
        state = solve(tables(here, speed, names, flow))
        contacts, known = contact_heat(state, flow)
        for row in np.flatnonzero(active & ~known):
            hottest = float(here[row].max(initial=MEASURED))
            words[row] = f"at temperatures up to {hottest:.0f} °C {state.outcome[row]}"
        active &= known
        step = _reached(contacts, pitches, speed, flow) - here
        size = np.abs(np.where(active[:, None, None], step, 0.0)).max(axis=(1, 2))
        onward = _along(step, last) > 0.0
        swings = (size > before) & ~onward
        damping = np.where(swings, np.maximum(0.5 * damping, 0.1), damping)
        slow = onward & (size < before) & (size > SLOW * before)
        held = damping[:, None, None]
        ahead = _ahead(step, step - last, moved + held * (step - last))
        move = held * step + np.where(slow[:, None, None], ahead, 0.0)
        moved = np.clip(move, -LONGEST, LONGEST)
        last, here = step, np.where(active[:, None, None], here + moved, here)
        before = np.where(active, size, before)
        over = active & (here.max(axis=(1, 2)) > HOTTEST)
        for row in np.flatnonzero(over):
            words[row] = run_away(here[row], names)
        active &= ~over & (size >= TOLERANCE)
        if not active.any():
            break
    words[active] = "temperatures do not settle, cool more, lower the preload or take springs"
    said = tuple(
        f"bearings at {rpm:.0f} rpm: {word}" if word else ""
        for word, rpm in zip(words, speed * 30.0 / np.pi, strict=True)
    )
    return HeatBalance(tables(here, speed, names, flow), said)


def cold(flow: Flow) -> Array:
    """Temperatures of balls, inner and outer ring without any heat (3,) [°C]."""
    found = balanced(lambda t: 0.0 * t, flow.conductances, flow.surroundings)
    return np.stack(found[:3], axis=-1)


def _along(a: Array, b: Array) -> Array:
    """Products of steps (speeds, bearings, 3) at every speed."""
    return np.asarray((a * b).sum(axis=(1, 2)))


def _ahead(step: Array, change: Array, further: Array) -> Array:
    """How far the next turns lead beyond this one if ``step`` goes on to change as by the last
    turn, ``change``, which moved temperatures by ``further``."""
    share = _along(change, step) / np.maximum(_along(change, change), 1e-300)
    return -share[:, None, None] * further


def run_away(here: Array, names: tuple[str, ...]) -> str:
    hot = [name for name, values in zip(names, here, strict=True) if values.max() > HOTTEST]
    return (
        f"temperatures run away at bearing{'s' * (len(hot) > 1)} {', '.join(hot)}, "
        f"{here.max():.0f} °C and rising; lower speed or preload, take a thinner oil or cool more"
    )


def tables(here: Array, speed: Array, names: tuple[str, ...], flow: Flow) -> Temperatures:
    """Temperatures (speeds, bearings, 3) of balls, inner and outer rings as files give them."""
    by_name = {
        name: BearingTemperatures(
            inner_ring=tuple(here[:, k, 1].tolist()),
            outer_ring=tuple(here[:, k, 2].tolist()),
            balls=tuple(here[:, k, 0].tolist()),
        )
        for k, name in enumerate(names)
    }
    around = flow.surroundings
    return Temperatures(
        shaft=around.shaft, housing=around.housing, bearings=by_name, speeds=tuple(speed.tolist())
    )


def contact_heat(state: PreloadState, flow: Flow) -> tuple[Array, Flags]:
    """Heat of inner and outer contacts (speeds, bearings, 2) [W], and where there is a state."""
    heat = np.zeros((len(state.speed), len(state.spindle.seats), 2))
    done: dict[int, Array] = {}
    for k, (balls, column) in enumerate(state.seat_states()):
        if id(balls) not in done:
            split = len(balls.operation.grooves.inner_offsets)
            power = bearings.heat.sliding(balls, flow.friction).power.sum(axis=-2)
            done[id(balls)] = np.stack(
                [power[..., :split].sum(axis=-1), power[..., split:].sum(axis=-1)], axis=-1
            )
        heat[:, k] = done[id(balls)][:, column]
    known = np.array([word == "" for word in state.outcome])
    return np.where(known[:, None, None], np.nan_to_num(heat), 0.0), known


def _reached(contacts: Array, pitches: Array, speed: Array, flow: Flow) -> Array:
    """Temperatures that given heat of contacts leads to, the oil thinning (speeds, bearings, 3)."""

    def heat(temperature: Array) -> Array:
        return with_oil(contacts, temperature, pitches, speed, flow)

    found = balanced(heat, flow.conductances, flow.surroundings, contacts.shape[:2])
    return np.stack(found[:3], axis=-1)


def with_oil(
    contacts: Array, temperature: Array, pitches: Array, speed: Array, flow: Flow
) -> Array:
    """Heat of inner contacts, outer contacts and oil (…, speeds, bearings, 3) [W], of ``contacts``
    (speeds, bearings, 2) and of the oil at ``temperature`` (…, speeds, bearings, 3) [°C]."""
    viscosity = flow.lubricant.kinematic(temperature[..., 0])
    oil = bearings.heat.viscous_moment(pitches, viscosity, speed[:, None], flow.oil_factor)
    given = np.broadcast_to(contacts, (*temperature.shape[:-1], 2))
    return np.concatenate([given, (oil * speed[:, None])[..., None]], axis=-1)
