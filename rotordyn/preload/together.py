"""Preload states of machines that are alike, solved together: each is some rows of one batch.

To solve sixteen machines, or one under four laws, takes hardly longer than to solve one. What is
asked of a state afterwards is solved for all it was solved with, and kept. A machine by itself is a
batch of one.
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
    """A machine at ``speed`` (speeds,) [rad/s]: ``law`` of balls where a seat says nothing else,
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
    from there springs act with their stiffness and stops stand at their travel.
    """
    joined = [_arrangement(each, each.speed) for each in machines]
    groups: dict[tuple[Any, ...], list[int]] = {}
    for k, each in enumerate(joined):
        groups.setdefault(each.structure, []).append(k)
    found: dict[int, PreloadState] = {}
    for group in groups.values():
        states = _solved([machines[k] for k in group], [joined[k] for k in group])
        found.update(zip(group, states, strict=True))
    return [found[k] for k in range(len(machines))]


def _solved(machines: Sequence[Asked], joined: Sequence[Arrangement]) -> list[PreloadState]:
    """The same of machines of one structure."""
    begun = [
        PreloadState(
            spindle=asked.spindle,
            force=asked.force,
            law=asked.law,
            network=Network(each, springs(asked.spindle, each, at_rest.position)),
            mounted=at_rest,
            limit=limits(each, at_rest.position[0]),
            net=at_rest,  # until it is settled
            outcome=(),
            temperatures=asked.temperatures,
            films=asked.films,
        )
        for asked, each, at_rest in zip(machines, joined, mounted(joined), strict=True)
    ]
    return settled(begun)


def _arrangement(machine: Asked | PreloadState, speed: Array) -> Arrangement:
    """The axial arrangement of a machine at any speeds."""
    acting = machine.force, machine.law, machine.temperatures, machine.films
    return arrangement(machine.spindle, speed, *acting)


def at_temperatures(state: PreloadState, temperatures: Temperatures) -> PreloadState:
    """The same machine at other ``temperatures``, sought from where it stands; how it was assembled
    does not depend on them."""
    other = replace(state, temperatures=temperatures, place=None)
    joined = _arrangement(other, state.speed)
    if joined.structure != state.network.arrangement.structure:
        # bearings are solved as one only while their temperatures are equal
        acting = state.law, state.force, temperatures, state.films
        return replace(dynamic_preload(state.spindle, state.speed, *acting), past=state.past)
    network = Network(joined, springs(state.spindle, joined, state.mounted.position))
    start = np.where(state.net.converged[:, None], state.net.position, state.rest)
    return settled([replace(other, network=network)], [start])[0]


def settled(begun: Sequence[PreloadState], start: Sequence[Array] = ()) -> list[PreloadState]:
    """States in balance under their networks, sought from rest or from ``start`` (speeds, bodies)
    of each; the stops end the travel of these networks."""
    limit = [limits(each.network.arrangement, each.rest) for each in begun]
    rows = [len(each.speed) for each in begun]
    start = start or [np.tile(each.rest, (n, 1)) for each, n in zip(begun, rows, strict=True)]
    network = Network.side_by_side([each.network for each in begun])
    ends = np.stack(limit) if len(begun) == 1 else np.repeat(limit, rows, axis=0)
    net = confirmed(network, with_stops(network, ends, np.concatenate(start)))
    states = []
    for each, end, part in zip(begun, limit, net.parts(rows), strict=True):
        warm = each.temperatures is not None
        machine = each.spindle, each.network, each.mounted
        words = outcomes(*machine, part, each.rest_loads, warm=warm)
        states.append(replace(each, limit=end, net=part, outcome=words))
    return Together.of(states)


@dataclass(frozen=True, eq=False, slots=True)
class Together:
    """States that are solved together, without their places here."""

    states: tuple[PreloadState, ...]
    _kept: dict[Any, Any] = field(default_factory=dict)

    @classmethod
    def of(cls, states: Sequence[PreloadState]) -> list[PreloadState]:
        """The states, each of which knows its place."""
        plain = tuple(replace(each, place=None) for each in states)
        whole = cls(plain)
        return [replace(each, place=Place(whole, k)) for k, each in enumerate(plain)]

    def once(self, key: Any, work: Callable[[], T]) -> T:
        """What ``work`` gives, which is the same for one key."""
        if key not in self._kept:
            self._kept[key] = work()
        found: T = self._kept[key]
        return found


@dataclass(frozen=True, eq=False, slots=True)
class Place:
    """The place of a state among those it is solved ``among``."""

    among: Together
    number: int

    def stop_speeds(self) -> Array:
        """As of ``PreloadState``."""
        return self.among.once("stops", lambda: _stop_speeds(self.among.states))[self.number]

    def with_travels(self, travel: Mapping[str, float], index: Indices) -> PreloadState:
        """As of ``PreloadState``."""
        states = self.among.states
        if len(states) == 1:
            return _with_travels(states, travel, [index])[0]
        every = [np.arange(len(state.speed)) for state in states]
        key = "travels", *sorted(travel.items())
        found = self.among.once(key, lambda: _with_travels(states, travel, every))
        return found[self.number].rows(index)

    def under_rest_loads(self, bearings: Sequence[int]) -> list[Solved]:
        """As of ``PreloadState``."""
        key = "rest loads", *bearings
        found = self.among.once(key, lambda: _under_rest_loads(self.among.states, bearings))
        return found[self.number]


def _with_travels(
    states: Sequence[PreloadState], travel: Mapping[str, float], rows: Sequence[Indices]
) -> list[PreloadState]:
    begun = []
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
        begun.append(replace(state, spindle=spindle, network=network, lateral=None))
    near = [state.net.position[index] for state, index in zip(states, rows, strict=True)]
    return settled(begun, near)


def _under_rest_loads(
    states: Sequence[PreloadState], bearings: Sequence[int]
) -> list[list[Solved]]:
    network = Network.side_by_side([state.network for state in states])
    rows = [len(state.speed) for state in states]
    load = np.zeros((sum(rows), len(bearings), 5))
    rest = [state.rest_loads()[list(bearings)] for state in states]
    carry = np.isfinite(rest) & ((np.array(rest) > 0.0) | network.both_ways[list(bearings)])
    load[..., 0] = np.repeat(np.where(carry, rest, UNASKED), rows, axis=0)
    whole = len(states) == 1 and len(bearings) == len(network.arrangement.bearings)
    near = states[0].net.response.states if whole else None
    solved = network.solve_bearings(bearings, near, load=load).values()
    end = np.cumsum(rows)
    every = [np.arange(last - count, last) for last, count in zip(end, rows, strict=True)]
    return [[Solved(one.places, one.state.rows(part)) for one in solved] for part in every]


def _stop_speeds(states: Sequence[PreloadState]) -> Array:
    """Of every state, for every sleeve (states, sleeves)."""
    found = [_meeting(states, push) for push in states[0].network.arrangement.pushes]
    return np.stack(found, axis=1) if found else np.empty((len(states), 0))


def _meeting(states: Sequence[PreloadState], push: Push) -> Array:
    """Speed at which a sleeve meets its stop, of every state (states,); NaN where it does not."""
    found = np.full(len(states), np.nan)
    held = [state.net.held[:, push.body] for state in states]
    met = [k for k, each in enumerate(held) if each.any()]
    if not met:
        return found
    between, near = [], []
    for k in met:
        state, row = states[k], int(held[k].argmax())
        known = np.where(state.net.converged[:, None], state.net.position, state.rest)
        before = (state.speed[row - 1], known[row - 1]) if row else (0.0, state.rest)
        between.append([before[0], state.speed[row]])
        near.append([before[1], known[row]])

    def at(speed: Array, which: Indices) -> Network:
        asked = {k: states[met[k]] for k in np.unique(which).tolist()}
        joined = {k: _arrangement(state, speed[which == k]) for k, state in asked.items()}
        if len({one.structure for one in joined.values()}) > 1:  # alike in some machines alone
            joined = {k: apart(one) for k, one in joined.items()}
        parts = [
            Network(joined[k], springs(state.spindle, joined[k], state.mounted.position))
            for k, state in asked.items()
        ]
        return Network.side_by_side(parts)

    limit = np.stack([states[k].limit for k in met])
    found[met] = meeting_speeds(at, limit, push, np.array(between), np.array(near))
    return found
