"""Which contacts change where the path goes on, from the rates of positions and contact forces.

A contact that may change has a rate of its way w ≥ 0 and one of its force λ ≥ 0, of which one is
zero: a closed stop without force opens or presses, sliding friction slides on or sticks. With K
positive this is a linear complementarity problem; the least-index method of Murty solves it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Flags
from rotordyn.state.contacts import TINY, State, held, independent, solve
from rotordyn.state.network import Network, Step
from rotordyn.state.no_equilibrium import endless

AT_LIMIT = 1e-9  # of the friction limit, of the sum of forces
TOUCHING = 1e-13  # m
ROUNDING = 1e-9  # of the largest rate
SLOW = 1e-3  # of what the force moves the stiffest body by
FLIPS = 400  # of one contact each


@dataclass(frozen=True, eq=False, slots=True)
class Undecided:
    """Contacts that may change: ``row`` (contacts, bodies) points the way they move, with forces
    along it; all others (contacts,): ``acts``: they hold; ``stop``: index of the stop, or −1;
    ``friction`` likewise."""

    row: Array
    acts: Flags
    stop: NDArray[np.int_]
    friction: NDArray[np.int_]


@dataclass(frozen=True, eq=False, slots=True)
class Rates:
    """Over the share of the step, contacts as they are: of positions ``x`` (bodies,) [m], of
    ``friction`` that sticks (frictions,) and of what closed stops ``press`` with (stops,) [N].

    ``pace`` [m]: what ``x`` is measured by, more than rounding leaves where every body is held.
    """

    x: Array
    friction: Array
    press: Array
    pace: float


def rates(step: Step, state: State) -> Rates:
    """Rates of a state whose contacts stay as they are."""
    force, gap, size = step.rate(state.at)
    joints = held(step.network, state, gap)
    way = _driven(joints.row, joints.rigid, gap)
    x, mu = solve(state.at.stiffness, force, joints.row, way)
    friction, press = np.zeros_like(state.friction), np.zeros_like(state.press)
    _, pressing, friction[joints.sticks] = joints.forces(mu)
    press[joints.closed] = step.network.stops.side[joints.closed] * pressing
    return Rates(x, friction, press, _pace(x, size, state))


def _pace(v: Array, size: float, state: State) -> float:
    """``Rates.pace`` [m]: without its second term bodies that are all held would have none."""
    slow = SLOW * size / max(float(state.at.stiffness.max()), TINY)
    return float(np.abs(v).max()) + slow + TINY


def velocity(step: Step, state: State) -> Array:
    """dx over the share of the step (bodies,), contacts as they are."""
    return rates(step, state).x


def updated_contacts(step: Step, state: State, share: float, sticks: int | None = None) -> State:
    """The state with the contacts the path goes on with, ``share`` of the step done; friction
    ``sticks`` is known to stick.

    Raises
    ------
    NoEquilibrium : rounding decides which contacts hold
    """
    may = _undecided(step.network, state, sticks)
    if not len(may.row):
        return state
    slip, closed = state.slip.copy(), state.closed.copy()
    slip[may.friction[may.friction >= 0]], closed[may.stop[may.stop >= 0]] = 1, False
    fixed = replace(state, slip=slip, closed=closed)
    return _decided(step.network, state, may, _complementary(step, fixed, share, may))


def _undecided(network: Network, state: State, sticks: int | None) -> Undecided:
    """Stops that just touch or carry nothing, friction at its limit but for ``sticks``."""
    stops, frictions = network.stops, network.frictions
    gap = stops.side * (stops.row @ state.x - stops.limit)
    stop = np.flatnonzero(
        np.where(state.closed, state.press <= AT_LIMIT * state.at.size, gap <= TOUCHING)
    )
    full = np.abs(state.friction) >= (1.0 - AT_LIMIT) * frictions.limit
    full &= frictions.limit > 0.0
    full[[] if sticks is None else [sticks]] = False
    friction = np.flatnonzero(full)
    way = np.where(state.slip == 0, -np.sign(state.friction), state.slip)
    return Undecided(
        row=np.concatenate(
            [
                stops.side[stop, None] * stops.row[stop],
                way[friction, None] * frictions.row[friction],
            ]
        ),
        acts=np.concatenate([state.closed[stop], state.sticks[friction]]),
        stop=np.concatenate([stop, np.full(len(friction), -1)]),
        friction=np.concatenate([np.full(len(stop), -1), friction]),
    )


def _complementary(step: Step, fixed: State, share: float, may: Undecided) -> Flags:
    """Which of the contacts hold; ``fixed``: the state with all of them free.

    Those that hold are independent: without that the least-index method may go round for ever.
    """
    force, gap, size = step.rate(fixed.at)
    joints = held(step.network, fixed, gap)
    way = _driven(joints.row, joints.rigid, gap)
    acts = may.acts.copy()
    acts[acts] = independent(np.concatenate([joints.row, may.row[acts]]))[len(way) :]
    for _ in range(FLIPS):
        row = np.concatenate([joints.row, may.row[acts]])
        target = np.concatenate([way, np.zeros(len(row) - len(way))])
        v, mu = solve(fixed.at.stiffness, force, row, target)
        push = np.zeros(len(acts))
        push[acts] = mu[len(way) :]
        opening = np.where(acts, 0.0, may.row @ v)
        wrong = opening < -ROUNDING * _pace(v, size, fixed)
        wrong |= push < -ROUNDING * size
        if not wrong.any():
            return acts
        first = int(np.flatnonzero(wrong)[0])
        acts[first] = not acts[first]
    raise endless(step, share, velocity(step, fixed))


def _driven(row: Array, rigid: list[int], gap: Array) -> Array:
    """Rates of the held joints: rigid springs follow their gaps, all others stand."""
    way = np.zeros(len(row))
    way[: len(rigid)] = gap[rigid]
    return way


def _decided(network: Network, state: State, may: Undecided, acts: Flags) -> State:
    """The state in which those contacts hold that ``acts`` says, and the others move."""
    closed, press = state.closed.copy(), state.press.copy()
    slip, friction, anchor = state.slip.copy(), state.friction.copy(), state.anchor.copy()
    for k, (stop, rub) in enumerate(zip(may.stop.tolist(), may.friction.tolist(), strict=True)):
        if stop >= 0:
            closed[stop] = acts[k]
            press[stop] = max(press[stop], 0.0) if acts[k] else 0.0
        elif acts[k]:
            anchor[rub] = network.frictions.row[rub] @ state.x if slip[rub] else anchor[rub]
            slip[rub] = 0
        else:
            way = slip[rub] or -int(np.sign(friction[rub]))
            slip[rub], friction[rub] = way, -way * network.frictions.limit[rub]
    return replace(state, closed=closed, press=press, slip=slip, friction=friction, anchor=anchor)


def compliance(step: Step, state: State) -> Array:
    """dx (bodies,) over the change of force of the step, contacts as they are."""
    force = step.end.force - step.start.force
    joints = held(step.network, state, np.zeros(len(step.network.springs.force)))
    return solve(state.at.stiffness, force, joints.row, np.zeros(len(joints.row)))[0]
