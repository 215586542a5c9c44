"""The dynamic preload state: every bearing's load, deflection and tangent at every speed."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bearings.ball.law import Law
from bearings.ring.state import BearingState
from rotordyn.arrays import Array, Flags, Indices
from rotordyn.machine.history import ASSEMBLED, Past
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import Temperatures
from rotordyn.preload.arrangement import SHAFT, as_mounted
from rotordyn.preload.as_assembled import springs
from rotordyn.preload.bearing_iterates import Solved
from rotordyn.preload.network import Network, NetworkState
from rotordyn.preload.on_films import Films
from rotordyn.preload.outcome import outcomes
from rotordyn.preload.stops import with_stops

if TYPE_CHECKING:
    from rotordyn.preload.together import Place

FAR = 1e-3  # m: no gap of a stop is that large
LEAST = 1e-9  # N, of a closed stop
TOUCHING = 1e-11  # m: a sleeve so near its stop, held by friction, stands at it
STICKING = 1.0 - 1e-9  # of the limit of friction: what carries less holds its sleeve
SOFT = 1e8  # N/m


@dataclass(frozen=True, eq=False, slots=True)
class PreloadState:
    """Axial equilibrium at every speed.

    ``force``: external axial force [N]; ``law``: of balls where a seat says nothing else;
    ``mounted``: the network at rest under its stated preloads; ``limit`` (bodies,): where a stop
    ends the travel (NaN without one) [m]; ``net``: the network at every speed; ``outcome`` per
    speed: empty, or why there is no usable state; ``lateral`` (speeds, p): coordinates of the rotor
    under loads across the axis, None without any; ``temperatures``: None where all are those of
    assembly; ``films``: those that balls ride on, or None; ``past``: what came before; ``place``:
    its own among states that are solved together, or None.
    """

    spindle: Spindle
    force: float
    law: Law
    network: Network
    mounted: NetworkState
    limit: Array
    net: NetworkState
    outcome: tuple[str, ...]
    lateral: Array | None = None
    temperatures: Temperatures | None = None
    films: Films | None = None
    past: Past = ASSEMBLED
    place: Place | None = None

    def coordinates(self, count: int) -> Array:
        """Those ``count`` of the rotor across the axis, then the positions (speeds, …)."""
        none = np.zeros((len(self.speed), count))
        lateral = none if self.lateral is None else self.lateral
        known = np.where(self.net.converged[:, None], self.net.position, self.rest)
        return np.concatenate([lateral, np.where(np.isfinite(known), known, self.rest)], axis=1)

    @property
    def rest(self) -> Array:
        """Positions as mounted (bodies,) [m]."""
        return self.mounted.position[0]

    @property
    def speed(self) -> Array:
        """Speeds [rad/s]."""
        return self.network.arrangement.speed

    @property
    def usable(self) -> Flags:
        """Speeds with a physical state (speeds,)."""
        return np.array([word == "" for word in self.outcome])

    @property
    def shift(self) -> Array:
        """Axial shift of every body from its place at rest (speeds, bodies) [m]."""
        return self.net.position - self.rest

    @property
    def spring_force(self) -> Array:
        """Spring forces, positive where they load the bearings (speeds, sleeves) [N].

        A rigid preload carries what its bearings ask for.
        """
        of_bodies = self.network.springs
        elastic = of_bodies.force - of_bodies.stiffness * self.shift
        forces = elastic - of_bodies.fixed * self._unbalanced
        return (self.network.arrangement.direction * forces)[:, SHAFT + 1 :]

    @property
    def stop_force(self) -> Array:
        """Force of each end stop on its sleeve, 0 while open (speeds, sleeves) [N]."""
        return np.where(self.net.held, np.abs(self._unbalanced), 0.0)[:, SHAFT + 1 :]

    def stop_gaps(self) -> Array:
        """Gap of every end stop (speeds, sleeves) [m]; ``FAR`` where there is no state.

        Negative where it is closed, by what its force, and what friction could carry besides, would
        press a spring ``SOFT`` together: so it goes on beyond the stop, and the speed at which that
        is met, or left, is a root. It may touch zero in between, where the force of the stop ends.
        """
        force = self.stop_force + (self.rubs[SHAFT + 1 :] - np.abs(self.friction_force))
        return np.where(self.stopped, -np.maximum(force, LEAST) / SOFT, self._gap)

    @property
    def stopped(self) -> Flags:
        """Sleeves at their stops (speeds, sleeves): those that press on them, and those that
        friction holds there, pressed on or not."""
        return self.net.held[:, SHAFT + 1 :] | (self.stuck & (self._gap <= TOUCHING))

    @property
    def stuck(self) -> Flags:
        """Sleeves that friction holds (speeds, sleeves)."""
        return np.asarray(np.abs(self.friction_force) < STICKING * self.rubs[SHAFT + 1 :])

    @property
    def _gap(self) -> Array:
        """From every sleeve to its stop (speeds, sleeves) [m]."""
        gap = self.network.arrangement.direction * (self.net.position - self.limit)
        return np.where(np.isfinite(gap), gap, FAR)[:, SHAFT + 1 :]

    @property
    def friction_force(self) -> Array:
        """Friction on every sleeve towards +x (speeds, sleeves) [N]."""
        return np.broadcast_to(self.network.friction, self.net.position.shape)[:, SHAFT + 1 :]

    @property
    def rubs(self) -> Array:
        """Limit of the friction on every body (bodies,) [N]."""
        return np.array([0.0, *(sleeve.friction for sleeve in self.spindle.sleeves)])

    @property
    def _unbalanced(self) -> Array:
        """What stops and rigid preloads carry (speeds, bodies) [N]."""
        return self.network.forces(self.net.position, self.net.response)

    def seat_states(self) -> list[tuple[BearingState, int]]:
        """For every seat, its bearing model's batched state and its column there."""
        arrangement = self.network.arrangement
        place: dict[int, tuple[BearingState, int]] = {}
        for solved in self.net.response.states.values():
            for column, bearing in enumerate(solved.places):
                for seat in arrangement.bearings[bearing].seats:
                    place[seat] = (solved.state, column)
        return [place[seat] for seat in sorted(place)]

    def small_shims(self) -> list[str]:
        """A sentence for each bearing an arc of whose grooves presses beyond their middle."""
        from bearings.ring.truncation import truncation

        sentences = []
        for seat, (state, column) in zip(self.spindle.seats, self.seat_states(), strict=True):
            if np.isnan(seat.bearing.grooves.middle_angles).all():
                continue
            across = truncation(state).across_middle[:, column].any(axis=(-1, -2))
            if (rows := np.flatnonzero(across & self.usable)).size:
                sentences.append(
                    f"bearing {seat.name}: an arc presses beyond the middle of its groove, first "
                    f"at {self.speed[rows[0]] * 30.0 / math.pi:.0f} rpm; the shim is too small "
                    "for two arcs, give none or a larger one"
                )
        return sentences

    def seat_load(self) -> Array:
        """Axial load of every bearing in its own frame (speeds, seats) [N]."""
        columns = [state.load[:, column, 0] for state, column in self.seat_states()]
        return np.stack(columns, axis=1)

    def mounted_load(self) -> Array:
        """Axial load of every bearing at rest under the stated preloads, as assembled (seats,)
        [N]."""
        return self.mounted.response.load[0, self.network.arrangement.bearing_of_seat]

    def seat_stiffness(self, tangent: str = "complete") -> Array:
        """A tangent of every bearing in its own frame (speeds, seats, 5, 5); on films the complete
        one, contacts in series with them."""
        from bearings.ring.tangents import stiffness as tangent_of

        seats = self.seat_states()
        states = {state for state, _ in seats}
        if (films := self.films) is not None:
            from bearings.on_film import softened

            stiffness = {state: softened(state, films.of(state)) for state in states}
        else:
            stiffness = {state: tangent_of(state, tangent) for state in states}
        return np.stack([stiffness[state][:, column] for state, column in seats], axis=1)

    def seat_growth(self) -> Array:
        """Total radial growth of every inner groove centre (speeds, seats) [m]."""
        joined = self.network.arrangement
        growth = np.stack([bearing.growth for bearing in joined.bearings], axis=1)
        return growth[:, joined.bearing_of_seat]

    def rest_loads(self) -> Array:
        """Axial load of every bearing at rest, external force included (bearings,) [N], or NaN."""
        net = self.mounted
        if self.force:
            still = replace(as_mounted(self.network.arrangement), force=self.force)
            frictionless = Network(still, springs(self.spindle, still, self.mounted.position))
            net = with_stops(frictionless, self.limit[None], self.rest[None])
        return np.where(net.converged[0], net.response.load[0], np.nan)

    def with_travels(self, travel: Mapping[str, float], index: Indices) -> PreloadState:
        """The state at some of its speeds, stops of some sleeves ending another ``travel`` [m]."""
        return self._solved.with_travels(travel, index)

    def under_rest_loads(self, bearings: Sequence[int]) -> list[Solved]:
        """Some bearings of the arrangement at every speed, each under its axial load at rest."""
        return self._solved.under_rest_loads(bearings)

    def stop_speeds(self) -> Array:
        """Speed at which each sleeve meets its stop (sleeves,) [rad/s], without friction and loads
        across the axis; NaN: it does not."""
        return self._solved.stop_speeds()

    @property
    def _solved(self) -> Place:
        assert self.place is not None, "a state that is being solved"
        return self.place

    def rows(self, index: Indices) -> PreloadState:
        """The state at some of its speeds, without loads across the axis."""
        network, net = self.network.at(index), self.net.rows(index)
        warm = self.temperatures is not None
        words = outcomes(self.spindle, network, self.mounted, net, self.rest_loads, warm=warm)
        return replace(self, network=network, net=net, outcome=words, place=None)
