"""Transient temperatures of all bearings of a spindle after its start, with the preload.

Every bearing has the three nodes of its heat balance, each with a heat capacity C: C Ṫ = heat of
the state at T + heat from the surroundings − G T. Instants lie closer together at the start. At
each one preload state gives the heat of the contacts, which is extrapolated linearly; with it, and
with the oil that thins, temperatures are integrated to the next instant by a Rosenbrock method of
second order, whose step fast balls do not limit (J. G. Verwer et al., SIAM J. Sci. Comput. 20
(1999) 1456: ROS2).

Theory: docs/theory/life.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bearings.heat.temperature import HOTTEST, Surroundings, network, sources
from rotordyn.arrays import Array, Flags, Indices
from rotordyn.preload.heat_balance import Flow, Solve, contact_heat, run_away, tables, with_oil

if TYPE_CHECKING:
    from rotordyn.machine.spindle import Spindle

PARTS = 16  # steps of temperatures between two instants
GAMMA = 1.0 + math.sqrt(0.5)  # of ROS2, L-stable: no growth or oscillation at long steps
NUDGE = 0.02  # K: difference for the slope of the heat of the oil


class Warming(NamedTuple):
    """Transient over ``time`` (t,) [s]: ``temperature`` (speeds, t, bearings, 3) of balls, inner
    and outer ring [°C], ``heat`` (speeds, t, bearings) [W], axial ``load`` (speeds, t, bearings)
    [N]; NaN after the instant ``last`` (speeds,); ``ending`` per speed: empty, or why it ends."""

    time: Array
    temperature: Array
    heat: Array
    load: Array
    last: Indices
    ending: tuple[str, ...]


SurroundingsAt = Callable[[float], Surroundings]  # of a time from the start [s]


class Begin(NamedTuple):
    """Initial ``temperature`` [°C] and heat ``capacity`` [J/K] of balls, inner and outer ring, each
    (bearings, 3)."""

    temperature: Array
    capacity: Array


def warming(
    solve: Solve,
    speed: Array,
    spindle: Spindle,
    flow: Flow,
    begin: Begin,
    surroundings_at: SurroundingsAt,
    duration: float,
    steps: int,
    watch: Callable[[int], None],
) -> Warming:
    """Integrate temperatures over a ``duration`` [s] from the start, at every ``speed`` [rad/s].

    ``solve`` returns the preload state at temperatures; ``surroundings_at``: those over time, of
    which the ``flow`` has the end; ``watch`` is called before every step.
    """
    names = tuple(seat.name for seat in spindle.seats)
    pitches = np.array([seat.bearing.pitch_diameter for seat in spindle.seats])
    time = duration * np.linspace(0.0, 1.0, steps + 1) ** 3
    oiled = _Oiled(pitches, speed, flow, begin.capacity, surroundings_at)
    current = np.broadcast_to(begin.temperature, (len(speed), *begin.temperature.shape)).copy()
    shape = len(speed), steps + 1, len(names)
    temperature = np.full((*shape, 3), np.nan)
    heat, load = np.full((2, *shape), np.nan)
    endings, last = np.full(len(speed), "", dtype=object), np.full(len(speed), steps)
    active, last_contacts = np.ones(len(speed), dtype=bool), np.zeros((*current.shape[:2], 2))

    def end(rows: Flags, k: int) -> None:
        """End the transient where there is no state, or one too hot, at the instant k."""
        for row in np.flatnonzero(active & rows):
            hottest = current[row].max()
            when = f"{time[k] / 60.0:.3g} min after the start" if k else "at the start"
            endings[row] = (
                run_away(current[row], names)
                if hottest > HOTTEST
                else f"no axial state {when}, at temperatures up to {hottest:.0f} °C: raise the "
                "preload, or cool more"
            )
            last[row] = max(k - 1, 0)
        active[rows] = False

    for k in range(steps + 1):
        watch(k)
        now = flow._replace(surroundings=surroundings_at(float(time[k])))
        state = solve(tables(np.minimum(current, HOTTEST), speed, names, now))  # hotter ones end
        contacts, usable = contact_heat(state, flow)
        end(~usable | (current.max(axis=(1, 2)) > HOTTEST), k)
        if not active.any():
            break
        temperature[active, k], load[active, k] = current[active], state.seat_load()[active]
        heat[active, k] = oiled.heat(contacts, current).sum(axis=-1)[active]
        if k == steps:
            break
        slope = (contacts - last_contacts) / (time[k] - time[k - 1]) if k else 0.0 * contacts
        advanced = oiled.onward(current, contacts, slope, (float(time[k]), float(time[k + 1])))
        current, last_contacts = np.where(active[:, None, None], advanced, current), contacts
    return Warming(time, temperature, heat, load, last, tuple(endings))


class _Oiled(NamedTuple):
    """Bearings of ``pitches`` (bearings,) [m] at every ``speed``, lubricated and cooled by a
    ``flow`` to surroundings over time, with ``capacity`` (bearings, 3) [J/K]."""

    pitches: Array
    speed: Array
    flow: Flow
    capacity: Array
    surroundings_at: SurroundingsAt

    def heat(self, contacts: Array, at: Array) -> Array:
        """Return the heat of inner contacts, outer contacts and oil (speeds, bearings, 3) [W]."""
        return with_oil(contacts, at, self.pitches, self.speed, self.flow)

    def onward(
        self, at: Array, contacts: Array, slope: Array, between: tuple[float, float]
    ) -> Array:
        """Integrate temperatures ``at`` (speeds, bearings, 3) ``between`` two times [s], while the
        heat of the ``contacts`` (speeds, bearings, 2) changes by ``slope`` [W/s]."""
        times, h = np.linspace(*between, PARTS + 1), (between[1] - between[0]) / PARTS
        conductances = self.flow.conductances
        ambient = [network(conductances, self.surroundings_at(t))[1] for t in times.tolist()]
        matrix, _ = network(conductances, self.flow.surroundings)
        cooling = matrix / self.capacity[:, :, None]
        change = sources(np.concatenate([slope, 0.0 * slope[..., :1]], axis=-1))

        def rate(part: int, temperature: Array) -> Array:
            power = sources(self.heat(contacts + part * h * slope, temperature)) + ambient[part]
            return power / self.capacity - np.einsum("bij,sbj->sbi", cooling, temperature)

        def oil(temperature: Array) -> Array:
            return self.heat(contacts, temperature)[..., 2]

        for part in range(PARTS):
            warmer = (oil(at + NUDGE) - oil(at)) / NUDGE
            jacobian = np.broadcast_to(-cooling, (*at.shape, 3)).copy()
            jacobian[..., 0, 0] += warmer / self.capacity[:, 0]
            operator = np.eye(3) - GAMMA * h * jacobian
            drift = (change * h + ambient[part + 1] - ambient[part]) / self.capacity
            k1 = _solved(operator, rate(part, at) + GAMMA * drift)
            k2 = _solved(operator, rate(part + 1, at + h * k1) - 2.0 * k1 - GAMMA * drift)
            at = at + h * (1.5 * k1 + 0.5 * k2)
        return at


def _solved(left: Array, right: Array) -> Array:
    return np.asarray(np.linalg.solve(left, right[..., None])[..., 0])
