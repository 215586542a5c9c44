"""The dynamic preload state: every bearing's load, deflection and tangent at every speed."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bearings.state import BearingState
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.arrangement import Arrangement, arrangement, at_rest, rigid
from rotordyn.preload.network import Law, Network, NetworkState, Springs, confirmed, groups, solve
from rotordyn.preload.outcome import outcomes

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class PreloadState:
    """Axial equilibrium at every speed.

    ``force``: external axial force [N]; ``rest`` and ``limit`` (bodies,): positions at rest, and
    where a stop ends the travel (NaN without one); ``net``: the solved network; ``outcome`` per
    speed: empty, or why there is no usable state.
    """

    spindle: Spindle
    force: float
    network: Network
    rest: Array
    limit: Array
    net: NetworkState
    outcome: tuple[str, ...]

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
        springs, pushes = self.network.springs, self.network.arrangement.pushes
        elastic = springs.force - springs.stiffness * self.shift
        forces = [
            push.direction
            * (elastic[:, push.body] - (rigid(push) * self._rest_of_forces(push.body)))
            for push in pushes
        ]
        return np.stack(forces, axis=1) if forces else np.zeros((len(self.speed), 0))

    @property
    def stop_force(self) -> Array:
        """Force of each end stop on its sleeve, 0 while open (speeds, sleeves) [N]."""
        pushes = self.network.arrangement.pushes
        forces = [
            np.where(self.net.held[:, p.body], np.abs(self._rest_of_forces(p.body)), 0.0)
            for p in pushes
        ]
        return np.stack(forces, axis=1) if forces else np.zeros((len(self.speed), 0))

    def _rest_of_forces(self, body: int) -> Array:
        return self.network.forces(self.net.position, self.net.response)[:, body]

    def seat_states(self) -> list[tuple[BearingState, int]]:
        """For every seat, its bearing model's batched state and its column there."""
        arrangement = self.network.arrangement
        place: dict[int, tuple[BearingState, int]] = {}
        for bearing, index in groups(arrangement).items():
            for column, k in enumerate(index):
                for seat in arrangement.joints[k].seats:
                    place[seat] = (self.net.response.states[bearing], column)
        return [place[seat] for seat in sorted(place)]

    def seat_stiffness(self) -> Array:
        """Complete tangent of every bearing in its own frame (speeds, seats, 5, 5)."""
        columns = [state.complete_stiffness[:, column] for state, column in self.seat_states()]
        return np.stack(columns, axis=1)

    def seat_growth(self) -> Array:
        """Total radial growth of every inner groove centre (speeds, seats) [m]."""
        joints = self.network.arrangement.joints
        place = {seat: joint.growth for joint in joints for seat in joint.seats}
        return np.stack([place[seat] for seat in sorted(place)], axis=1)

    def rest_loads(self) -> Array:
        """Axial load of every joint at rest under the stated preloads (joints,) [N]."""
        still = replace(self.network, arrangement=at_rest(self.network.arrangement))
        return still.respond(self.rest[None]).load[0]

    def stop_speeds(self) -> Array:
        """Speed at which each sleeve meets its stop (sleeves,) [rad/s]; NaN: it does not."""
        return np.array([_stop_speed(self, push.body) for push in self.network.arrangement.pushes])


def dynamic_preload(
    spindle: Spindle, speed: Array, law: Law, axial_force: float = 0.0
) -> PreloadState:
    """Solve the axial arrangement of ``spindle`` at every ``speed`` [rad/s].

    The convention at rest: each spring carries exactly its stated preload, without external force;
    from there springs act with their stiffness and stops stand at their travel.
    """
    joined = arrangement(spindle, speed, axial_force)
    rest = _rest(joined, law)
    springs, limit = _springs(joined, rest)
    network = Network(joined, law, springs)
    net = confirmed(network, _with_stops(network, rest, limit))
    words = outcomes(spindle, network, net)
    return PreloadState(spindle, axial_force, network, rest, limit, net, words)


def _rest(joined: Arrangement, law: Law) -> Array:
    """Positions at rest under the stated preloads alone (bodies,)."""
    still = at_rest(joined)
    count = len(still.bodies)
    nothing = np.zeros(count)
    none = np.zeros(count, dtype=bool)
    springs = Springs(_preloads(still), nothing, nothing, none)
    network = Network(still, law, springs)
    start = _seated(network)
    return solve(network, start[None], none[None], start[None]).position[0]


def _preloads(joined: Arrangement) -> Array:
    force = np.zeros(len(joined.bodies))
    for push in joined.pushes:
        force[push.body] = push.direction * push.preload
    return force


def _seated(network: Network) -> Array:
    """A start at rest (bodies,): each joint under its likely load, fitted by positions."""
    b, twins, force = network.incidence, network.twins, network.springs.force
    share = np.linalg.lstsq((twins[:, None] * b).T, force, rcond=None)[0]
    likely = np.maximum(share, 0.05 * np.abs(force).max() + 1.0)
    deflection = [
        joint.bearing.equilibrium(
            load=[load, 0.0, 0.0, 0.0, 0.0], static_growth=joint.static_growth
        ).displacement[0]
        for joint, load in zip(network.arrangement.joints, likely, strict=True)
    ]
    return np.linalg.lstsq(b, np.array(deflection), rcond=None)[0]


def _springs(joined: Arrangement, rest: Array) -> tuple[Springs, Array]:
    """Springs acting about the place at rest, and where each stop ends the travel (bodies,)."""
    stiffness, limit = np.zeros_like(rest), np.full_like(rest, np.nan)
    fixed = np.zeros(len(rest), dtype=bool)
    for push in joined.pushes:
        fixed[push.body] = rigid(push)
        stiffness[push.body] = 0.0 if rigid(push) else push.stiffness
        if np.isfinite(push.travel) and not rigid(push):
            limit[push.body] = rest[push.body] - push.direction * push.travel
    return Springs(_preloads(joined), stiffness, rest, fixed), limit


def _with_stops(network: Network, rest: Array, limit: Array) -> NetworkState:
    """Close stops that would be overrun, open those that would have to pull, until neither is."""
    direction = np.zeros_like(limit)
    for push in network.arrangement.pushes:
        direction[push.body] = push.direction
    start = np.repeat(rest[None], len(network.arrangement.speed), axis=0)
    held = np.zeros(start.shape, dtype=bool)
    net = solve(network, start, held, limit)
    for _ in range(2 * len(limit) + 2):
        overrun = direction * (net.position - limit) < -1e-13
        pulls = held & (direction * network.forces(net.position, net.response) > 0.0)
        wanted = (held | overrun) & ~pulls
        if (wanted == held).all():
            break
        held = wanted
        net = solve(network, net.position, held, limit, net.response)
    return net


def _stop_speed(state: PreloadState, body: int) -> float:
    """First speed at which ``body`` stands at its stop [rad/s]; NaN where it never does.

    The gap of the released body is sampled between the last speed with the stop open and the first
    with it closed, and its zero in Ω² is taken from the interpolating polynomial, twice.
    """
    held = np.flatnonzero(state.net.held[:, body])
    if not held.size:
        return float("nan")
    first = int(held[0])
    low, high = state.speed[max(first - 1, 0)] ** 2, state.speed[first] ** 2
    for narrow in (False, True):
        squares = np.linspace(low, high, 5)
        gap = _released_gap(state, body, first, np.sqrt(squares))
        if not (np.isfinite(gap).all() and gap[0] > 0.0 > gap[-1]):
            break
        zero = _zero(squares, gap)
        if narrow or high - low < 0.2 * high:
            return float(zero**0.5)
        margin = 0.02 * (high - low)
        low, high = max(low, zero - margin), min(high, zero + margin)
    return float(state.speed[first])


def _released_gap(state: PreloadState, body: int, row: int, speeds: Array) -> Array:
    """Distance of ``body`` from its stop at ``speeds`` if the stop were not there [m]."""
    network = state.network
    moved = replace(network, arrangement=arrangement(state.spindle, speeds, state.force))
    others = np.repeat(state.net.held[row : row + 1], len(speeds), axis=0)
    others[:, body] = False
    start = np.repeat(state.net.position[row : row + 1], len(speeds), axis=0)
    direction = next(p.direction for p in network.arrangement.pushes if p.body == body)
    net = solve(moved, start, others, state.limit)
    return direction * (net.position[:, body] - state.limit[body])


def _zero(x: Array, y: Array) -> float:
    """Zero of the polynomial through the points, found where ``y`` changes sign."""
    inverse = np.polynomial.Polynomial.fit(y, x, len(x) - 1)  # y falls steadily: invert
    return float(inverse(0.0))
