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
from rotordyn.machine.plausibility import named
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
LEAST = 1e-9  # N: least force of a closed stop
TOUCHING = 1e-11  # m: a sleeve held by friction this close to its stop is at it
STICKING = 1.0 - 1e-9  # of the limit of friction: a sleeve with less friction sticks
SOFT = 1e8  # N/m: stiffness that turns forces of closed stops into gaps


@dataclass(frozen=True, eq=False, slots=True)
class PreloadState:
    """Axial equilibrium at every speed.

    ``force``: external axial force [N]; ``law``: of balls where a seat has none of its own;
    ``mounted``: the network at rest under its stated preloads; ``limit`` (bodies,): position at
    which a stop ends the travel (NaN without one) [m]; ``net``: the network at every speed;
    ``outcome`` per speed: empty, or why there is no usable state; ``lateral`` (speeds, p):
    coordinates of the rotor under loads across the axis, None without any; ``temperatures``: None
    where all are those of assembly; ``films`` of the balls, or None; ``past``: the history before;
    ``place`` among states that are solved together, or None.
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
        """Return ``count`` coordinates of the rotor across the axis, then positions (speeds, …)."""
        zero = np.zeros((len(self.speed), count))
        lateral = zero if self.lateral is None else self.lateral
        position = np.where(self.net.converged[:, None], self.net.position, self.rest)
        return np.concatenate(
            [lateral, np.where(np.isfinite(position), position, self.rest)], axis=1
        )

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
        return np.array([outcome == "" for outcome in self.outcome])

    @property
    def shift(self) -> Array:
        """Axial shift of every body from its position at rest (speeds, bodies) [m]."""
        return self.net.position - self.rest

    @property
    def spring_force(self) -> Array:
        """Spring forces, positive where they load the bearings (speeds, sleeves) [N].

        A rigid preload carries the force that balances its bearings.
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
        """Return the gap of every end stop (speeds, sleeves) [m]; ``FAR`` where there is no state.

        That of a closed stop is negative: the deflection of a spring ``SOFT`` under the stop's
        force and the reserve of friction. So the gap continues beyond the stop, and the speed at
        which it is met or left is a root. It may touch zero between, where the stop's force ends.
        """
        force = self.stop_force + (self.rubs[SHAFT + 1 :] - np.abs(self.friction_force))
        return np.where(self.stopped, -np.maximum(force, LEAST) / SOFT, self._gap)

    @property
    def stopped(self) -> Flags:
        """Sleeves at their stops (speeds, sleeves): those that press on them, and those that
        friction holds there, with or without a stop force."""
        return self.net.held[:, SHAFT + 1 :] | (self.stuck & (self._gap <= TOUCHING))

    @property
    def stuck(self) -> Flags:
        """Sleeves that friction holds (speeds, sleeves)."""
        return np.asarray(np.abs(self.friction_force) < STICKING * self.rubs[SHAFT + 1 :])

    @property
    def _gap(self) -> Array:
        """Distance of every sleeve from its stop (speeds, sleeves) [m]."""
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
        """Forces carried by stops and rigid preloads (speeds, bodies) [N]."""
        return self.network.forces(self.net.position, self.net.response)

    def seat_states(self) -> list[tuple[BearingState, int]]:
        """Return for every seat the batched state of its bearing model and its column there."""
        arrangement = self.network.arrangement
        by_seat: dict[int, tuple[BearingState, int]] = {}
        for solved in self.net.response.states.values():
            for column, bearing in enumerate(solved.places):
                for seat in arrangement.bearings[bearing].seats:
                    by_seat[seat] = (solved.state, column)
        return [by_seat[seat] for seat in sorted(by_seat)]

    def small_shims(self) -> list[str]:
        """Return a sentence on bearings in which an arc presses beyond its groove's middle."""
        from bearings.ring.truncation import truncation

        first = {}
        for seat, (state, column) in zip(self.spindle.seats, self.seat_states(), strict=True):
            if np.isnan(seat.bearing.grooves.middle_angles).all():
                continue
            across = truncation(state).across_middle[:, column].any(axis=(-1, -2))
            if (rows := np.flatnonzero(across & self.usable)).size:
                first[seat.name] = self.speed[rows[0]] * 30.0 / math.pi
        if not first:
            return []
        return [
            f"{named(first)}: an arc presses beyond the middle of its groove, first at "
            f"{min(first.values()):.0f} rpm; the shim is too small for two arcs, give none or a "
            "larger one"
        ]

    def seat_load(self) -> Array:
        """Return the axial load of every bearing in its own frame (speeds, seats) [N]."""
        columns = [state.load[:, column, 0] for state, column in self.seat_states()]
        return np.stack(columns, axis=1)

    def mounted_load(self) -> Array:
        """Return the axial load of every bearing at rest under stated preloads (seats,) [N]."""
        return self.mounted.response.load[0, self.network.arrangement.bearing_of_seat]

    def seat_stiffness(self, tangent: str = "complete") -> Array:
        """Return a tangent of every bearing in its own frame (speeds, seats, 5, 5); with films the
        complete one, contacts in series with them."""
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
        """Return the radial growth of every inner groove centre (speeds, seats) [m]."""
        joined = self.network.arrangement
        growth = np.stack([bearing.growth for bearing in joined.bearings], axis=1)
        return growth[:, joined.bearing_of_seat]

    def rest_loads(self) -> Array:
        """Return axial bearing loads at rest with the external force (bearings,) [N], or NaN."""
        net = self.mounted
        if self.force:
            at_rest = replace(as_mounted(self.network.arrangement), force=self.force)
            frictionless = Network(at_rest, springs(self.spindle, at_rest, self.mounted.position))
            net = with_stops(frictionless, self.limit[None], self.rest[None])
        return np.where(net.converged[0], net.response.load[0], np.nan)

    def with_travels(self, travel: Mapping[str, float], index: Indices) -> PreloadState:
        """Return the state at speeds ``index``, some sleeves with another stop ``travel`` [m]."""
        return self._solved.with_travels(travel, index)

    def under_rest_loads(self, bearings: Sequence[int]) -> list[Solved]:
        """Return states of some bearings at every speed, each under its axial load at rest."""
        return self._solved.under_rest_loads(bearings)

    def stop_speeds(self) -> Array:
        """Return the speed at which each sleeve meets its stop (sleeves,) [rad/s], without friction
        and loads across the axis; NaN if it does not."""
        return self._solved.stop_speeds()

    @property
    def _solved(self) -> Place:
        assert self.place is not None, "a state that is being solved"
        return self.place

    def rows(self, index: Indices) -> PreloadState:
        """Return the state at the speeds ``index``, without loads across the axis."""
        network, net = self.network.at(index), self.net.rows(index)
        warm = self.temperatures is not None
        outcome = outcomes(self.spindle, network, self.mounted, net, self.rest_loads, warm=warm)
        return replace(self, network=network, net=net, outcome=outcome, place=None)
