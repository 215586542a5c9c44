"""The preload state under static loads across the axis, every bearing with all its balls.

The loads grow from zero to their size, at all speeds at once: in one stride where that is found,
else in shorter ones. Only the balance under the whole loads is kept; it is found anew from the
convex start of every bearing, so that the way to it leaves no mark.

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

STRIDES = (1, 4, 16)
LOST = 1e-9  # of its lightest ball without loads: a ball with less carries nothing
SURE = 1e-8  # of the largest force: what is left of the balance with every bearing solved anew


def under_load(state: PreloadState, rotor: StaticRotor, size: float) -> PreloadState:
    """``state`` under loads of ``size`` [N], along ``rotor.point`` of a structure in its states."""
    first = Balance.at(state, rotor, np.arange(len(state.speed)))
    balance, there, converged = _marched(first, size)
    failed = np.flatnonzero(~converged)
    alone = _alone(state, failed) if failed.size else {}
    words = [
        _pushed_apart(state, balance, there, row)
        if good
        else alone.get(row) or _why(state, there, row, size)
        for row, good in enumerate(converged.tolist())
    ]
    return _as_state(state, balance, there, balance.error(there, size), tuple(words))


@dataclass(frozen=True, eq=False, slots=True)
class ContactLoss:
    """Where the first ball of each bearing leaves its inner race as the loads grow.

    ``share`` (states, seats) of the loads, NaN where all of them stay pressed, or some is not even
    without loads; ``ball`` (states, seats): which one, −1 of none.
    """

    share: Array
    ball: Indices


def contact_loss(
    state: PreloadState, rotor: StaticRotor, size: float, rows: Indices, steps: int
) -> ContactLoss:
    """Loads of ``size`` [N] in so many ``steps`` on ``state``, the one without them, at ``rows``.

    Within the step in which the first ball of a bearing leaves its race the place is sought from
    below (``Leaving``).
    """
    first = Balance.at(state, rotor, rows)
    shares = np.linspace(0.0, 1.0, steps + 1)
    every = [_inner_loads(_marched(first, 0.0)[1])]
    lost_at = np.full((len(rows), len(every[0])), np.nan)
    ball = np.full(lost_at.shape, -1)
    if not any(load.min() > 0.0 for seat in every[0] for load in seat):
        return ContactLoss(lost_at, ball)  # as of bearings within their play
    every += [_inner_loads(_marched(first, share * size)[1]) for share in shares[1:]]
    for seat in range(lost_at.shape[1]):
        known = [_leaving(shares, [each[seat][row] for each in every]) for row in range(len(rows))]
        for _ in range(NEARER):
            if all(one is None or one.found for one in known):
                break
            trial = np.array([one.trial if one else 0.0 for one in known])
            loads = _inner_loads(_marched(first, trial * size)[1])[seat]
            known = [
                one and one.after(trial[k], float(loads[k].min()), int(loads[k].argmin()))
                for k, one in enumerate(known)
            ]
        for row, one in enumerate(known):
            if one is not None:
                lost_at[row, seat], ball[row, seat] = one.zero, one.ball
    return ContactLoss(lost_at, ball)


def _leaving(shares: Array, loads: list[Array]) -> Leaving | None:
    """From inner loads of the balls at every share; None where none leaves, or one has left without
    loads."""
    lightest = np.array([each.min() for each in loads])
    least = LOST * float(lightest[0])
    gone = np.flatnonzero(lightest <= least)
    if not lightest[0] > 0.0 or not gone.size:
        return None
    k = int(gone[0])
    known = shares[:k].tolist(), lightest[:k].tolist()
    return Leaving.between(*known, float(shares[k]), least, int(loads[k - 1].argmin()))


def _inner_loads(there: Point) -> list[Array]:
    """Inner loads of the balls of every seat (states, balls) [N]."""
    assert there.states is not None
    by_seat = {
        place: solved.state.inner_load[:, column]
        for solved in there.states.values()
        for column, place in enumerate(solved.places)
    }
    return [by_seat[seat] for seat in sorted(by_seat)]


def _marched(first: Balance, size: Force) -> tuple[Balance, Point, Flags]:
    """The balance under loads of ``size`` [N], of all states or of each, and where there is one
    (states,)."""
    begin = first.evaluate(first.start, None)
    solved = np.zeros(len(first.held), dtype=bool)
    coordinates, found = begin.coordinates.copy(), first
    for strides in STRIDES:
        alive = ~solved
        balance, here = first, begin
        for share in np.arange(1, strides + 1) / strides:
            guess = _ahead(balance, here, size / strides, alive)
            balance, here, good = balanced(balance, guess, here, share * size, alive)
            alive &= good
            if not alive.any():
                break
        coordinates = np.where(alive[:, None], here.coordinates, coordinates)
        found = balance.where(alive, found)
        solved |= alive
        if solved.all():
            break
    there = found.evaluate(coordinates, None)
    sure = found.error(there, size) < SURE
    return found, there, solved & sure & (there.pressure <= HIGHEST_PRESSURE)


def _ahead(balance: Balance, here: Point, step: Force, alive: Flags) -> list[Array]:
    """Where a linear machine would be after ``step`` [N] more."""
    change = np.asarray(step)[..., None] * balance.per_newton(here, alive)
    longest = np.abs(change).max(axis=1)
    straight = np.isfinite(longest) & ~balance.slack(here)
    change = np.where(straight[:, None], change, 0.0)
    balls = [one.ball for _, one in here.bearings]
    moved = balance.balls_along(here, change)
    return [here.coordinates + change, *(x + dx for x, dx in zip(balls, moved, strict=True))]


def _alone(state: PreloadState, rows: Indices) -> dict[int, str]:
    """Of ``rows`` at which nothing presses the bearings along their axis, or one has no state by
    its axial load alone, what keeps them from it."""
    network = state.network
    lost = lost_at_speed(state.spindle, network, state.rest_loads(), rows)
    for row in rows.tolist():
        if not state.net.converged[row] and pushed(network) < LEAST_PRELOAD:
            lost[row] = unpreloaded(state.spindle, network, row)
    return lost


def _why(state: PreloadState, there: Point, row: int, size: float) -> str:
    rpm, pressure = state.speed[row] * 30.0 / math.pi, float(there.pressure[row])
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


def _pushed_apart(state: PreloadState, balance: Balance, there: Point, row: int) -> str:
    """That the loads push a bearing apart, or nothing."""
    seats = state.spindle.seats
    load = there.load[row, :, 0] * [seat.thrust for seat in seats]
    both_ways, rpm = state.network.both_ways[balance.bearings], state.speed[row] * 30.0 / math.pi
    return pushed_apart([seat.name for seat in seats], load, both_ways, rpm)


def _as_state(
    state: PreloadState, balance: Balance, there: Point, error: Array, words: tuple[str, ...]
) -> PreloadState:
    """The balance as a preload state whose bearings all stand by themselves."""
    assert there.states is not None
    p, shape = len(balance.rotor.point), there.load.shape[:2]
    joined = apart(state.network.arrangement)
    load, slope = np.empty(shape), np.empty(shape)
    for places, each in there.bearings:
        load[:, places], slope[:, places] = each.load[..., 0], each.stiffness[..., 0, 0]
    response = Response(load, slope, there.states, there.bearings)
    network = Network(joined, state.network.springs, balance.friction(there))
    position = there.coordinates[:, p:]
    converged = np.array([word == "" for word in words])
    net = NetworkState(position, balance.held, response, error, converged)
    lateral = there.coordinates[:, :p]
    mounted = _by_seat(state.mounted, balance.bearings)
    state = replace(state, network=network, mounted=mounted, net=net)
    return Together.of([replace(state, outcome=words, lateral=lateral)])[0]


def _by_seat(mounted: NetworkState, bearings: list[int]) -> NetworkState:
    """The network at rest with a column for every seat, of ``bearings`` that stand for each."""
    one = mounted.response
    each = replace(one, load=one.load[:, bearings], slope=one.slope[:, bearings])
    return replace(mounted, response=each)
