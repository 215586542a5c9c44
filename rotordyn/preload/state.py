"""The dynamic preload state: every bearing's load, deflection and tangent at every speed."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bearings.ball.law import Law
from bearings.ball.laws import Laws
from bearings.ring.state import BearingState
from rotordyn.machine.history import ASSEMBLED, Past
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import Temperatures
from rotordyn.preload.arrangement import (
    SHAFT,
    Arrangement,
    Push,
    arrangement,
    as_mounted,
    has_stop,
    rigid,
)
from rotordyn.preload.bearing_iterates import Solved
from rotordyn.preload.network import Network, NetworkState, Springs, confirmed, solve
from rotordyn.preload.on_films import Films
from rotordyn.preload.outcome import outcomes
from rotordyn.preload.stops import meeting_speeds, with_stops

if TYPE_CHECKING:
    from rotordyn.preload.family import Family

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
FAR = 1e-3  # m: no gap of a stop is that large
LEAST = 1e-9  # N, of a closed stop
SOFT = 1e8  # N/m
NO_SHARE = 1e-9  # of the largest preload: a bearing that carries less may stand within its play


@dataclass(frozen=True, eq=False, slots=True)
class PreloadState:
    """Axial equilibrium at every speed.

    ``force``: external axial force [N]; ``law``: of balls where a seat says nothing else;
    ``mounted``: the network at rest under its stated preloads; ``limit`` (bodies,): where a stop
    ends the travel (NaN without one) [m]; ``net``: the network at every speed; ``outcome`` per
    speed: empty, or why there is no usable state; ``lateral`` (speeds, p): coordinates of the rotor
    under loads across the axis, None without any; ``temperatures``: None where all are those of
    assembly; ``films``: those that balls ride on, or None; ``past``: what came before; ``family``:
    states under other laws that it was solved with.
    """

    spindle: Spindle
    force: float
    law: Law | Laws
    network: Network
    mounted: NetworkState
    limit: Array
    net: NetworkState
    outcome: tuple[str, ...]
    lateral: Array | None = None
    temperatures: Temperatures | None = None
    films: Films | None = None
    past: Past = ASSEMBLED
    family: Family | None = None

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
        springs = self.network.springs
        elastic = springs.force - springs.stiffness * self.shift
        forces = elastic - springs.fixed * self._unbalanced
        return (self.network.arrangement.direction * forces)[:, SHAFT + 1 :]

    @property
    def stop_force(self) -> Array:
        """Force of each end stop on its sleeve, 0 while open (speeds, sleeves) [N]."""
        return np.where(self.net.held, np.abs(self._unbalanced), 0.0)[:, SHAFT + 1 :]

    def stop_gaps(self) -> Array:
        """Gap of every end stop (speeds, sleeves) [m]; ``FAR`` where there is no state.

        Negative where it is closed, by what its force would press a spring ``SOFT`` together: so it
        goes on beyond the stop, and the speed at which that is met is a root.
        """
        gap = self.network.arrangement.direction * (self.net.position - self.limit)
        gap = np.where(np.isfinite(gap), gap, FAR)[:, SHAFT + 1 :]
        pressed = np.maximum(self.stop_force, LEAST) / SOFT
        return np.where(self.net.held[:, SHAFT + 1 :], -pressed, gap)

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
            net = with_stops(replace(self.network, arrangement=still), self.rest, self.limit)
        return np.where(net.converged[0], net.response.load[0], np.nan)

    def with_travels(self, travel: Mapping[str, float], index: NDArray[np.intp]) -> PreloadState:
        """The state at some of its speeds, stops of some sleeves ending another ``travel`` [m]."""
        if self.family is not None and isinstance(self.law, Law):
            return self.family.with_travels(self.law, travel, index)
        sleeves = tuple(
            replace(sleeve, stop_travel=travel.get(sleeve.name, sleeve.stop_travel))
            for sleeve in self.spindle.sleeves
        )
        part = self.network.at(index)
        pushes = tuple(
            replace(push, travel=sleeve.stop_travel)
            for push, sleeve in zip(part.arrangement.pushes, sleeves, strict=True)
        )
        network = replace(part, arrangement=replace(part.arrangement, pushes=pushes))
        spindle = replace(self.spindle, sleeves=sleeves)
        law = self.law.take(index)
        other = replace(self, spindle=spindle, law=law, lateral=None)
        return settled(other, network, self.net.position[index])

    def under_axial(self, bearings: Sequence[int], load: Array) -> list[Solved]:
        """Some bearings of the arrangement, each under its axial ``load`` (bearings,) [N]."""
        if self.family is not None and isinstance(self.law, Law):
            return self.family.under_axial(self.law, bearings, load)
        asked = np.zeros((len(self.speed), len(bearings), 5))
        asked[..., 0] = load
        whole = len(bearings) == len(self.network.arrangement.bearings)
        near = self.net.response.states if whole else None
        return [*self.network.solve_bearings(bearings, near, load=asked).values()]

    def rows(self, index: NDArray[np.intp]) -> PreloadState:
        """The state at some of its speeds, without loads across the axis."""
        law = self.law.take(index)
        network, net = self.network.at(index), self.net.rows(index)
        warm = self.temperatures is not None
        words = outcomes(self.spindle, network, self.mounted, net, warm=warm)
        return replace(self, law=law, network=network, net=net, outcome=words)

    def stop_speeds(self) -> Array:
        """Speed at which each sleeve meets its stop (sleeves,) [rad/s]; NaN: it does not."""
        if self.family is not None and isinstance(self.law, Law):
            return self.family.stop_speeds(self.law)
        return self.each_stop_speeds(1)[0]

    def each_stop_speeds(self, parts: int) -> Array:
        """The same of speeds that are repeated, once for each of several laws (parts, sleeves)."""
        pushes = self.network.arrangement.pushes
        each = [self._stop_speeds(push, parts) for push in pushes]
        return np.stack(each, axis=1) if each else np.empty((parts, 0))

    def _stop_speeds(self, push: Push, parts: int) -> Array:
        held = self.net.held[:, push.body].reshape(parts, -1)
        met, first = np.flatnonzero(held.any(axis=1)), held.argmax(axis=1)
        found = np.full(parts, np.nan)
        if not met.size:
            return found
        row = met * held.shape[1] + first[met]
        inner = first[met] > 0
        known = np.where(self.net.converged[:, None], self.net.position, self.rest)
        between = np.stack([np.where(inner, self.speed[row - 1], 0.0), self.speed[row]], axis=1)
        near = np.stack([np.where(inner[:, None], known[row - 1], self.rest), known[row]], axis=1)

        def at(speed: Array, which: NDArray[np.intp]) -> Network:
            law = self.law.take(row[which])
            acting = self.force, law, self.temperatures, self.films
            return replace(self.network, arrangement=arrangement(self.spindle, speed, *acting))

        found[met] = meeting_speeds(at, self.rest, self.limit, push, between, near)
        return found


def dynamic_preload(
    spindle: Spindle,
    speed: Array,
    law: Law | Laws,
    axial_force: float = 0.0,
    temperatures: Temperatures | None = None,
    films: Films | None = None,
) -> PreloadState:
    """Solve the axial arrangement of ``spindle`` at every ``speed`` [rad/s].

    The convention at rest: each spring carries exactly its stated preload, without external force;
    from there springs act with their stiffness and stops stand at their travel.
    """
    joined = arrangement(spindle, speed, axial_force, law, temperatures, films)
    mounted = _mounted(joined)
    rest = mounted.position[0]
    network = Network(joined, _springs(spindle, joined, rest))
    start = PreloadState(
        spindle,
        axial_force,
        law,
        network,
        mounted,
        limit=_limits(joined, rest),
        net=mounted,  # until it is settled
        outcome=(),
        temperatures=temperatures,
        films=films,
    )
    return settled(start, network)


def settled(state: PreloadState, network: Network, start: Array | None = None) -> PreloadState:
    """Another ``network`` of the same spindle at its speeds, sought from rest or from ``start``
    (speeds, bodies)."""
    limit = _limits(network.arrangement, state.rest)
    net = confirmed(network, with_stops(network, state.rest, limit, start))
    warm = state.temperatures is not None
    words = outcomes(state.spindle, network, state.mounted, net, warm=warm)
    return replace(state, network=network, limit=limit, net=net, outcome=words, family=None)


def _mounted(joined: Arrangement) -> NetworkState:
    """Equilibrium at rest under the stated preloads alone (one speed)."""
    still = as_mounted(joined)
    count = len(still.bodies)
    nothing = np.zeros(count)
    none = np.zeros(count, dtype=bool)
    springs = Springs(_preloads(still), nothing, nothing, none)
    network = Network(still, springs)
    start = _seated(network)
    return solve(network, start[None], none[None], start[None])


def _preloads(joined: Arrangement) -> Array:
    """Forces of the springs at rest, towards +x (bodies,) [N]."""
    return joined.direction * [0.0, *(push.preload for push in joined.pushes)]


def _seated(network: Network) -> Array:
    """A start at rest (bodies,): each bearing under its likely load, fitted by positions."""
    b, tandem, force = network.incidence, network.tandem, network.springs.force
    share = np.linalg.lstsq((tandem[:, None] * b).T, force, rcond=None)[0]
    largest = np.abs(force).max()
    # a bearing that takes thrust one way begins pressed, however the springs may share their force
    likely = np.maximum(np.where(network.both_ways, np.abs(share), share), 0.05 * largest + 1.0)
    likely = np.where(network.both_ways, np.copysign(likely, share), likely)
    carries = ~network.both_ways | (np.abs(share) > NO_SHARE * largest)
    load = np.zeros((1, len(likely), 5))
    load[0, :, 0] = likely
    deflection = np.empty(len(likely))
    for alike in network.solve_bearings(range(len(likely)), None, load=load).values():
        deflection[alike.places] = alike.state.displacement[0, :, 0]
    return np.linalg.lstsq(b[carries], deflection[carries], rcond=None)[0]


def _springs(spindle: Spindle, joined: Arrangement, rest: Array) -> Springs:
    """Springs acting about the place at rest.

    Linear supports hold the shaft along the axis without force at rest.
    """
    fixed = np.array([False, *map(rigid, joined.pushes)])
    along = sum(support.along for support in spindle.supports)
    stiffness = np.array([along, *(push.stiffness for push in joined.pushes)])
    return Springs(_preloads(joined), np.where(fixed, 0.0, stiffness), rest, fixed)


def _limits(joined: Arrangement, rest: Array) -> Array:
    """Where each stop ends the travel (bodies,); NaN without one."""
    travel = [push.travel if has_stop(push) else np.nan for push in joined.pushes]
    return rest - joined.direction * [np.nan, *travel]
