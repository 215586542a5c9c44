"""End stops: which are closed at every speed, and at which speed one is met."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.numerics.crossing import zero_crossings
from rotordyn.preload.arrangement import Push
from rotordyn.preload.network import Network, NetworkState, solve

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
OVERRUN = 1e-13  # m
PULL = 1e-10  # of the largest preload: a stop that pulls less than that stays closed
SAMPLES = 5
ROUNDS = 24
CLOSE = 1e-5  # relative width of the bracket in Ω² within which the local cubic is exact
CLOSER = 1e-4  # share of the bracket that is searched next around the zero of the cubic
EPS = 1e-12


def with_stops(
    network: Network, rest: Array, limit: Array, start: Array | None = None
) -> NetworkState:
    """Equilibrium with unilateral stops at ``limit`` (bodies,), NaN where there is none.

    Sought from ``rest`` (bodies,), or from ``start`` (speeds, bodies), places likely to be near.
    Stops that would be overrun are closed and those that would have to pull are opened, until
    neither happens; a speed where that never ends is not ``converged``.
    """
    if start is None:
        start = np.repeat(rest[None], len(network.arrangement.speed), axis=0)
    held = np.zeros(start.shape, dtype=bool)
    net = solve(network, start, held, limit)
    for _ in range(2 * len(limit) + 2):
        force = network.forces(net.position, net.response)
        wanted = stops_wanted(network, net.position, force, held, limit)
        if (wanted == held).all():
            return net
        held = wanted
        net = solve(network, net.position, held, limit, net.response)
    force = network.forces(net.position, net.response)
    settled = stops_wanted(network, net.position, force, held, limit) == held
    return replace(net, converged=net.converged & settled.all(axis=1))


def stops_wanted(
    network: Network, position: Array, force: Array, held: Flags, limit: Array
) -> Flags:
    """Bodies (speeds, bodies) that belong at their stops.

    Those that stand there and are pressed on, and those that have run past. ``force`` on the bodies
    [N] without what the stops carry.
    """
    direction = network.arrangement.direction
    overrun = direction * (position - limit) < -OVERRUN
    slack = PULL * np.abs(network.springs.force).max()
    pulls = held & (direction * force > slack)
    return (held | overrun) & ~pulls


def meeting_speed(
    at: Callable[[Array], Network],
    rest: Array,
    limit: Array,
    push: Push,
    between: tuple[float, float],
    near: Array,
) -> float:
    """First speed within ``between`` [rad/s] at which the sleeve of ``push`` meets its stop.

    ``at`` gives the network at any speeds. The sleeve's own stop is taken away and its gap followed
    over Ω², all other stops acting; the bracket around its zero is narrowed by local cubics. A
    speed that has no equilibrium without the stop counts as overrun. ``near`` (2, bodies): places
    at the two speeds, to start from.
    """
    released = limit.copy()
    released[push.body] = np.nan
    low, high = between[0] ** 2, between[1] ** 2
    known = [(np.array([low, high]), near)]

    def gaps(squares: Array) -> Array:
        start = _between(squares, *known[-1])
        net = with_stops(at(np.sqrt(squares)), rest, released, start)
        if net.converged.all():
            known.append((squares, net.position))
        gap = push.direction * (net.position[:, push.body] - limit[push.body])
        return np.where(net.converged, gap, -np.inf)

    guess = (low, high)
    for _ in range(ROUNDS):
        squares = np.linspace(*guess, SAMPLES)
        gap = gaps(squares)
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


def _between(at: Array, places: Array, values: Array) -> Array:
    """``values`` (places, columns) on straight lines between ascending ``places``."""
    return np.stack([np.interp(at, places, column) for column in values.T], axis=1)
