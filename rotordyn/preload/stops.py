"""End stops: those closed at every speed, and the speed at which one is met."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator
from dataclasses import replace

import numpy as np

from rotordyn.arrays import Array, Flags, Indices
from rotordyn.numerics.crossing import zero_crossings
from rotordyn.preload.arrangement import Push
from rotordyn.preload.equilibrium import solve
from rotordyn.preload.network import Network, NetworkState

OVERRUN = 1e-13  # m
PULL = 1e-10  # of the largest preload: a stop that pulls less stays closed
SAMPLES = 5  # speeds of a bracket that are solved at once
ROUNDS = 24  # narrowings of a bracket, at most
CLOSE = 1e-5  # relative width of the bracket in Ω² within which the local cubic is exact
CLOSER = 1e-4  # share of the bracket that is searched next around the zero of the cubic
EPS = 1e-12  # relative width of a bracket in Ω² that is not narrowed further


def with_stops(network: Network, limit: Array, start: Array) -> NetworkState:
    """Solve for the equilibrium with unilateral stops at ``limit`` (speeds or 1, bodies), NaN where
    there is none, from ``start`` (speeds, bodies).

    Stops that would be overrun are closed and those that would have to pull are opened, until
    neither happens; a speed where that never ends is not ``converged``.
    """
    held = np.zeros(start.shape, dtype=bool)
    net = solve(network, start, held, limit)
    for _ in range(2 * limit.shape[1] + 2):
        force = network.forces(net.position, net.response)
        updated = bodies_at_stops(network, net.position, force, held, limit)
        if (updated == held).all():
            return net
        held = updated
        net = solve(network, net.position, held, limit, net.response)
    force = network.forces(net.position, net.response)
    stable = bodies_at_stops(network, net.position, force, held, limit) == held
    return replace(net, converged=net.converged & stable.all(axis=1))


def bodies_at_stops(
    network: Network, position: Array, force: Array, held: Flags, limit: Array
) -> Flags:
    """Return the bodies (speeds, bodies) that must be at their stops.

    Those pressed against them, and those that have overrun them. ``force`` on the bodies [N]
    without stop forces.
    """
    direction = network.arrangement.direction
    overrun = direction * (position - limit) < -OVERRUN
    slack = PULL * np.abs(network.springs.force).max(axis=1, keepdims=True)
    pulls = held & (direction * force > slack)
    return (held | overrun) & ~pulls


def meeting_speeds(
    at: Callable[[Array, Indices], Network],
    limit: Array,
    push: Push,
    between: Array,
    near: Array,
) -> Array:
    """Return the first speed in each of ``between`` (k, 2) at which a sleeve meets its stop.

    All are sought together, (k,) [rad/s], for the sleeve of ``push``. ``at`` returns the network at
    any speeds, given which of the k they are for, ascending; ``limit`` (k, bodies) as of
    ``with_stops``. The sleeve's own stop is removed, all other stops act. A speed that has no
    equilibrium without the stop counts as overrun. ``near`` (k, 2, bodies): positions at the two
    speeds, as a start.
    """
    released = limit.copy()
    released[:, push.body] = np.nan
    positions = dict(enumerate(zip(between**2, near, strict=True)))
    searches = {k: _search(*ends) for k, ends in enumerate(between**2)}
    pending = {k: next(search) for k, search in searches.items()}
    speeds = np.empty(len(between))
    while pending:
        start = np.concatenate([_interpolated(x, *positions[k]) for k, x in pending.items()])
        squares, which = np.concatenate([*pending.values()]), np.repeat([*pending], SAMPLES)
        net = with_stops(at(np.sqrt(squares), which), released[which], start)
        gap = push.direction * (net.position[:, push.body] - limit[which, push.body])
        gap = np.where(net.converged, gap, -np.inf)
        for k, x in [*pending.items()]:
            rows = which == k
            if net.converged[rows].all():
                positions[k] = x, net.position[rows]
            try:
                pending[k] = searches[k].send(gap[rows])
            except StopIteration as end:
                speeds[k] = end.value
                del pending[k]
    return speeds


def _search(low: float, high: float) -> Generator[Array, Array, float]:
    """Yield squared speeds at which the gap is needed; return the speed of its first zero between
    two squared speeds: the bracket of ``SAMPLES`` is narrowed by local cubics over Ω²."""
    guess = (low, high)
    for _ in range(ROUNDS):
        squares = np.linspace(*guess, SAMPLES)
        gap = yield squares
        past = np.flatnonzero(gap <= 0.0)
        if past.size and past[0] == 0:
            high = min(high, squares[0])
        elif past.size:
            low, high = max(low, squares[past[0] - 1]), squares[past[0]]
        else:
            low = max(low, squares[-1])
        zero = next((z for z in zero_crossings(squares, gap) if low < z < high), None)
        if zero is not None and high - low <= CLOSE * high:
            return math.sqrt(zero)
        if high - low <= EPS * high:
            break
        margin = CLOSER * (high - low)
        guess = (low, high) if zero is None else (max(low, zero - margin), min(high, zero + margin))
    return math.sqrt(0.5 * (low + high))


def _interpolated(at: Array, places: Array, values: Array) -> Array:
    """Interpolate ``values`` (places, columns) linearly between ascending ``places``."""
    return np.stack([np.interp(at, places, column) for column in values.T], axis=1)
