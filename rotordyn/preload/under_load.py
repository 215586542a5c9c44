"""The preload state under static loads across the axis, every bearing with all its balls.

The loads grow from zero to full size, at all speeds at once: in one step where that converges, else
in shorter ones. Only the balance under full loads is kept; it is solved anew from the convex start
of every bearing, so that it does not depend on the path.

Theory: docs/theory/loads.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from rotordyn.arrays import Array, Flags, Indices
from rotordyn.equation.statics import StaticRotor
from rotordyn.machine.limits import HIGHEST_PRESSURE
from rotordyn.preload.arrangement import apart
from rotordyn.preload.balance import Balance, Force, Point
from rotordyn.preload.balance_search import balanced
from rotordyn.preload.leaving import NEARER, Leaving
from rotordyn.preload.network import Network, NetworkState, Response
from rotordyn.preload.outcome import LEAST_PRELOAD, lost_at_speed, pushed, pushed_apart, unpreloaded
from rotordyn.preload.state import PreloadState
from rotordyn.preload.together import Together

STRIDES = (1, 4, 16)  # numbers of load steps, tried in turn
LOST = 1e-9  # of its lightest ball without loads: a ball with less has lost contact
SURE = 1e-8  # of the largest force: residual with every bearing solved anew, at most


def under_load(state: PreloadState, rotor: StaticRotor, size: float) -> PreloadState:
    """Return ``state`` under loads of ``size`` [N] along ``rotor.point``, at the same speeds."""
    first = Balance.at(state, rotor, np.arange(len(state.speed)))
    balance, point, converged = _marched(first, size)
    failed = np.flatnonzero(~converged)
    axial = _axial_failures(state, failed) if failed.size else {}
    outcome = [
        _pushed_apart(state, balance, point, row)
        if solved
        else axial.get(row) or _why(state, point, row, size)
        for row, solved in enumerate(converged.tolist())
    ]
    return _as_state(state, balance, point, balance.error(point, size), tuple(outcome))


@dataclass(frozen=True, eq=False, slots=True)
class ContactLoss:
    """Loads at which the first ball of each bearing leaves its inner race.

    ``share`` (states, seats) of the loads, NaN where all balls stay in contact, or one has none
    even without loads; ``ball`` (states, seats): index of that ball, −1 for none.
    """

    share: Array
    ball: Indices


def contact_loss(
    state: PreloadState, rotor: StaticRotor, size: float, rows: Indices, steps: int
) -> ContactLoss:
    """Increase loads to ``size`` [N] in ``steps`` on ``state``, the one without them, at ``rows``.

    Within the step in which the first ball of a bearing leaves its race the load is sought from
    below (``Leaving``).
    """
    first = Balance.at(state, rotor, rows)
    shares = np.linspace(0.0, 1.0, steps + 1)
    loads_at = [_inner_loads(_marched(first, 0.0)[1])]
    lost_at = np.full((len(rows), len(loads_at[0])), np.nan)
    ball = np.full(lost_at.shape, -1)
    if not any(load.min() > 0.0 for seat in loads_at[0] for load in seat):
        return ContactLoss(lost_at, ball)  # every bearing is within its play
    loads_at += [_inner_loads(_marched(first, share * size)[1]) for share in shares[1:]]
    for seat in range(lost_at.shape[1]):
        iterates = [
            _leaving(shares, [at_share[seat][row] for at_share in loads_at])
            for row in range(len(rows))
        ]
        for _ in range(NEARER):
            if all(iterate is None or iterate.found for iterate in iterates):
                break
            trial = np.array([iterate.trial if iterate else 0.0 for iterate in iterates])
            loads = _inner_loads(_marched(first, trial * size)[1])[seat]
            iterates = [
                iterate and iterate.after(trial[k], float(loads[k].min()), int(loads[k].argmin()))
                for k, iterate in enumerate(iterates)
            ]
        for row, iterate in enumerate(iterates):
            if iterate is not None:
                lost_at[row, seat], ball[row, seat] = iterate.zero, iterate.ball
    return ContactLoss(lost_at, ball)


def _leaving(shares: Array, loads: list[Array]) -> Leaving | None:
    """Return the iterate from inner ball loads at every share; None if no ball leaves, or one has
    left without loads."""
    lightest = np.array([balls.min() for balls in loads])
    least = LOST * float(lightest[0])
    lost = np.flatnonzero(lightest <= least)
    if not lightest[0] > 0.0 or not lost.size:
        return None
    k = int(lost[0])
    before_loss = shares[:k].tolist(), lightest[:k].tolist()
    return Leaving.between(*before_loss, float(shares[k]), least, int(loads[k - 1].argmin()))


def _inner_loads(point: Point) -> list[Array]:
    """Return the inner loads of the balls of every seat (states, balls) [N]."""
    assert point.states is not None
    by_seat = {
        place: solved.state.inner_load[:, column]
        for solved in point.states.values()
        for column, place in enumerate(solved.places)
    }
    return [by_seat[seat] for seat in sorted(by_seat)]


def _marched(first: Balance, size: Force) -> tuple[Balance, Point, Flags]:
    """Return the balance under loads of ``size`` [N], common or per state, and where it exists."""
    start = first.evaluate(first.start, None)
    solved = np.zeros(len(first.held), dtype=bool)
    coordinates, problem = start.coordinates.copy(), first
    for strides in STRIDES:
        alive = ~solved
        balance, point = first, start
        for share in np.arange(1, strides + 1) / strides:
            guess = _predicted(balance, point, size / strides, alive)
            balance, point, converged = balanced(balance, guess, point, share * size, alive)
            alive &= converged
            if not alive.any():
                break
        coordinates = np.where(alive[:, None], point.coordinates, coordinates)
        problem = balance.where(alive, problem)
        solved |= alive
        if solved.all():
            break
    final = problem.evaluate(coordinates, None)
    confirmed = problem.error(final, size) < SURE
    return problem, final, solved & confirmed & (final.pressure <= HIGHEST_PRESSURE)


def _predicted(balance: Balance, point: Point, step: Force, alive: Flags) -> list[Array]:
    """Return coordinates and balls extrapolated linearly by a load ``step`` [N]."""
    change = np.asarray(step)[..., None] * balance.per_newton(point, alive)
    longest = np.abs(change).max(axis=1)
    straight = np.isfinite(longest) & ~balance.slack(point)
    change = np.where(straight[:, None], change, 0.0)
    balls = [batch.ball for _, batch in point.bearings]
    ball_change = balance.balls_along(point, change)
    return [point.coordinates + change, *(x + dx for x, dx in zip(balls, ball_change, strict=True))]


def _axial_failures(state: PreloadState, rows: Indices) -> dict[int, str]:
    """Return failures at those of ``rows`` where no axial load presses the bearings, or one has no
    state under its axial load alone."""
    network = state.network
    lost = lost_at_speed(state.spindle, network, state.rest_loads(), rows)
    for row in rows.tolist():
        if not state.net.converged[row] and pushed(network) < LEAST_PRELOAD:
            lost[row] = unpreloaded(state.spindle, network, row)
    return lost


def _why(state: PreloadState, point: Point, row: int, size: float) -> str:
    rpm, pressure = state.speed[row] * 30.0 / math.pi, float(point.pressure[row])
    if pressure > HIGHEST_PRESSURE:
        return (
            f"bearings are overloaded under the loads of {size:.4g} N on the shaft at {rpm:.0f} "
            f"rpm (peak pressure {pressure / 1e9:.1f} GPa, at most {HIGHEST_PRESSURE / 1e9:g} "
            "GPa): lower the loads"
        )
    return (
        f"nothing balances the loads of {size:.4g} N on the shaft at {rpm:.0f} rpm: lower them, "
        "raise the preload, or hold the shaft by further bearings or supports"
    )


def _pushed_apart(state: PreloadState, balance: Balance, point: Point, row: int) -> str:
    """Return the failure where the loads push a bearing apart, or ""."""
    seats = state.spindle.seats
    load = point.load[row, :, 0] * [seat.thrust for seat in seats]
    both_ways, rpm = state.network.both_ways[balance.bearings], state.speed[row] * 30.0 / math.pi
    return pushed_apart([seat.name for seat in seats], load, both_ways, rpm)


def _as_state(
    state: PreloadState, balance: Balance, point: Point, error: Array, outcome: tuple[str, ...]
) -> PreloadState:
    """Return the balance as a preload state with one bearing per seat."""
    assert point.states is not None
    p, shape = len(balance.rotor.point), point.load.shape[:2]
    joined = apart(state.network.arrangement)
    load, slope = np.empty(shape), np.empty(shape)
    for places, balls in point.bearings:
        load[:, places], slope[:, places] = balls.load[..., 0], balls.stiffness[..., 0, 0]
    response = Response(load, slope, point.states, point.bearings)
    network = Network(joined, state.network.springs, balance.friction(point))
    position = point.coordinates[:, p:]
    converged = np.array([failure == "" for failure in outcome])
    net = NetworkState(position, balance.held, response, error, converged)
    lateral = point.coordinates[:, :p]
    mounted = _by_seat(state.mounted, balance.bearings)
    state = replace(state, network=network, mounted=mounted, net=net)
    return Together.of([replace(state, outcome=outcome, lateral=lateral)])[0]


def _by_seat(mounted: NetworkState, bearings: list[int]) -> NetworkState:
    """Return the network at rest with a column per seat; ``bearings``: the index of each seat's."""
    response = mounted.response
    per_seat = replace(response, load=response.load[:, bearings], slope=response.slope[:, bearings])
    return replace(mounted, response=per_seat)
