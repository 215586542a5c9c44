"""Preload states of similar machines, solved together as rows of one batch.

To solve sixteen machines, or one under four laws, takes hardly longer than to solve one. Later
requests to a state are solved for its whole batch, and kept. A single machine is a batch of one.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple, TypeVar

import numpy as np

from bearings.ball.law import Law
from rotordyn.arrays import Array, Indices
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import Temperatures
from rotordyn.preload.arrangement import Arrangement, Push, apart, arrangement
from rotordyn.preload.as_assembled import limits, mounted, springs
from rotordyn.preload.bearing_iterates import Solved
from rotordyn.preload.equilibrium import confirmed
from rotordyn.preload.network import Network
from rotordyn.preload.on_films import Films
from rotordyn.preload.outcome import UNASKED, outcomes
from rotordyn.preload.state import PreloadState
from rotordyn.preload.stops import meeting_speeds, with_stops

T = TypeVar("T")


class Asked(NamedTuple):
    """Machine at ``speed`` (speeds,) [rad/s]: ``law`` of balls where a seat has none of its own,
    external ``force`` along the axis [N]."""

    spindle: Spindle
    speed: Array
    law: Law
    force: float = 0.0
    temperatures: Temperatures | None = None
    films: Films | None = None


def dynamic_preload(
    spindle: Spindle,
    speed: Array,
    law: Law,
    axial_force: float = 0.0,
    temperatures: Temperatures | None = None,
    films: Films | None = None,
) -> PreloadState:
    """Solve the axial arrangement of ``spindle`` at every ``speed`` [rad/s]; as
    ``dynamic_preloads``."""
    return dynamic_preloads([Asked(spindle, speed, law, axial_force, temperatures, films)])[0]


def dynamic_preloads(machines: Sequence[Asked]) -> list[PreloadState]:
    """Solve the axial arrangements of machines, those of one structure together.

    The convention at rest: each spring carries exactly its stated preload, without external force;
    from there springs act with their stiffness and stops are at their travel.
    """
    joined = [_arrangement(machine, machine.speed) for machine in machines]
    groups: dict[tuple[Any, ...], list[int]] = {}
    for k, arranged in enumerate(joined):
        groups.setdefault(arranged.structure, []).append(k)
    by_machine: dict[int, PreloadState] = {}
    for group in groups.values():
        states = _solved([machines[k] for k in group], [joined[k] for k in group])
        by_machine.update(zip(group, states, strict=True))
    return [by_machine[k] for k in range(len(machines))]


def _solved(machines: Sequence[Asked], joined: Sequence[Arrangement]) -> list[PreloadState]:
    """Return the preload states of machines of one structure."""
    initial = [
        PreloadState(
            spindle=machine.spindle,
            force=machine.force,
            law=machine.law,
            network=Network(arranged, springs(machine.spindle, arranged, at_rest.position)),
            mounted=at_rest,
            limit=limits(arranged, at_rest.position[0]),
            net=at_rest,  # until ``settled`` replaces it
            outcome=(),
            temperatures=machine.temperatures,
            films=machine.films,
        )
        for machine, arranged, at_rest in zip(machines, joined, mounted(joined), strict=True)
    ]
    return settled(initial)


def _arrangement(machine: Asked | PreloadState, speed: Array) -> Arrangement:
    """Return the axial arrangement of a machine at any speeds."""
    conditions = machine.force, machine.law, machine.temperatures, machine.films
    return arrangement(machine.spindle, speed, *conditions)


def at_temperatures(state: PreloadState, temperatures: Temperatures) -> PreloadState:
    """Return the state at other ``temperatures``, iterated from this one; the machine was assembled
    independently of them."""
    other = replace(state, temperatures=temperatures, place=None)
    joined = _arrangement(other, state.speed)
    if joined.structure != state.network.arrangement.structure:
        # bearings are solved as one only while their temperatures are equal
        conditions = state.law, state.force, temperatures, state.films
        return replace(dynamic_preload(state.spindle, state.speed, *conditions), past=state.past)
    network = Network(joined, springs(state.spindle, joined, state.mounted.position))
    start = np.where(state.net.converged[:, None], state.net.position, state.rest)
    return settled([replace(other, network=network)], [start])[0]


def settled(begun: Sequence[PreloadState], start: Sequence[Array] = ()) -> list[PreloadState]:
    """Return states in balance under their networks, from rest or from ``start`` (speeds, bodies)
    of each; stops are at the travels of these networks."""
    limit = [limits(state.network.arrangement, state.rest) for state in begun]
    rows = [len(state.speed) for state in begun]
    start = start or [np.tile(state.rest, (n, 1)) for state, n in zip(begun, rows, strict=True)]
    network = Network.side_by_side([state.network for state in begun])
    ends = np.stack(limit) if len(begun) == 1 else np.repeat(limit, rows, axis=0)
    net = confirmed(network, with_stops(network, ends, np.concatenate(start)))
    states = []
    for state, end, part in zip(begun, limit, net.parts(rows), strict=True):
        warm = state.temperatures is not None
        machine = state.spindle, state.network, state.mounted
        outcome = outcomes(*machine, part, state.rest_loads, warm=warm)
        states.append(replace(state, limit=end, net=part, outcome=outcome))
    return Together.of(states)


@dataclass(frozen=True, eq=False, slots=True)
class Together:
    """States that are solved together, each without its ``place``."""

    states: tuple[PreloadState, ...]
    _kept: dict[Any, Any] = field(default_factory=dict)

    @classmethod
    def of(cls, states: Sequence[PreloadState]) -> list[PreloadState]:
        """Return the states, each with its place among them."""
        plain = tuple(replace(state, place=None) for state in states)
        together = cls(plain)
        return [replace(state, place=Place(together, k)) for k, state in enumerate(plain)]

    def once(self, key: Any, work: Callable[[], T]) -> T:
        """Return what ``work`` computes, once for each key."""
        if key not in self._kept:
            self._kept[key] = work()
        result: T = self._kept[key]
        return result


@dataclass(frozen=True, eq=False, slots=True)
class Place:
    """Place of a state among those it is solved with, ``among``."""

    among: Together
    number: int

    def stop_speeds(self) -> Array:
        """See ``PreloadState.stop_speeds``."""
        return self.among.once("stops", lambda: _stop_speeds(self.among.states))[self.number]

    def with_travels(self, travel: Mapping[str, float], index: Indices) -> PreloadState:
        """See ``PreloadState.with_travels``."""
        states = self.among.states
        if len(states) == 1:
            return _with_travels(states, travel, [index])[0]
        all_rows = [np.arange(len(state.speed)) for state in states]
        key = "travels", *sorted(travel.items())
        changed = self.among.once(key, lambda: _with_travels(states, travel, all_rows))
        return changed[self.number].rows(index)

    def under_rest_loads(self, bearings: Sequence[int]) -> list[Solved]:
        """See ``PreloadState.under_rest_loads``."""
        key = "rest loads", *bearings
        loaded = self.among.once(key, lambda: _under_rest_loads(self.among.states, bearings))
        return loaded[self.number]


def _with_travels(
    states: Sequence[PreloadState], travel: Mapping[str, float], rows: Sequence[Indices]
) -> list[PreloadState]:
    changed = []
    for state, index in zip(states, rows, strict=True):
        sleeves = tuple(
            replace(sleeve, stop_travel=travel.get(sleeve.name, sleeve.stop_travel))
            for sleeve in state.spindle.sleeves
        )
        network = state.network.at(index)
        pushes = tuple(
            replace(push, travel=sleeve.stop_travel)
            for push, sleeve in zip(network.arrangement.pushes, sleeves, strict=True)
        )
        network = replace(network, arrangement=replace(network.arrangement, pushes=pushes))
        spindle = replace(state.spindle, sleeves=sleeves)
        changed.append(replace(state, spindle=spindle, network=network, lateral=None))
    start = [state.net.position[index] for state, index in zip(states, rows, strict=True)]
    return settled(changed, start)


def _under_rest_loads(
    states: Sequence[PreloadState], bearings: Sequence[int]
) -> list[list[Solved]]:
    network = Network.side_by_side([state.network for state in states])
    rows = [len(state.speed) for state in states]
    load = np.zeros((sum(rows), len(bearings), 5))
    rest = [state.rest_loads()[list(bearings)] for state in states]
    loaded = np.isfinite(rest) & ((np.array(rest) > 0.0) | network.both_ways[list(bearings)])
    load[..., 0] = np.repeat(np.where(loaded, rest, UNASKED), rows, axis=0)
    all_bearings = len(states) == 1 and len(bearings) == len(network.arrangement.bearings)
    start = states[0].net.response.states if all_bearings else None
    solved = network.solve_bearings(bearings, start, load=load).values()
    end = np.cumsum(rows)
    parts = [np.arange(last - count, last) for last, count in zip(end, rows, strict=True)]
    return [[Solved(batch.places, batch.state.rows(part)) for batch in solved] for part in parts]


def _stop_speeds(states: Sequence[PreloadState]) -> Array:
    """Return the speed at which each sleeve meets its stop (states, sleeves)."""
    speeds = [_meeting(states, push) for push in states[0].network.arrangement.pushes]
    return np.stack(speeds, axis=1) if speeds else np.empty((len(states), 0))


def _meeting(states: Sequence[PreloadState], push: Push) -> Array:
    """Return the speed at which a sleeve meets its stop (states,); NaN where it does not."""
    speeds = np.full(len(states), np.nan)
    held = [state.net.held[:, push.body] for state in states]
    met = [k for k, flags in enumerate(held) if flags.any()]
    if not met:
        return speeds
    between, near = [], []
    for k in met:
        state, row = states[k], int(held[k].argmax())
        position = np.where(state.net.converged[:, None], state.net.position, state.rest)
        previous = (state.speed[row - 1], position[row - 1]) if row else (0.0, state.rest)
        between.append([previous[0], state.speed[row]])
        near.append([previous[1], position[row]])

    def at(speed: Array, which: Indices) -> Network:
        needed = {k: states[met[k]] for k in np.unique(which).tolist()}
        joined = {k: _arrangement(state, speed[which == k]) for k, state in needed.items()}
        if len({a.structure for a in joined.values()}) > 1:  # tandem sets in some machines only
            joined = {k: apart(a) for k, a in joined.items()}
        networks = [
            Network(joined[k], springs(state.spindle, joined[k], state.mounted.position))
            for k, state in needed.items()
        ]
        return Network.side_by_side(networks)

    limit = np.stack([states[k].limit for k in met])
    speeds[met] = meeting_speeds(at, limit, push, np.array(between), np.array(near))
    return speeds
