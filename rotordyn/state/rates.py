"""Contacts that change as a path continues, from the rates of positions and contact forces.

A contact that may change has a rate of displacement w ≥ 0 and one of force λ ≥ 0, of which one is
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
SLOW = 1e-3  # of the displacement of the stiffest body by the force
FLIPS = 400  # changes of one contact each


@dataclass(frozen=True, eq=False, slots=True)
class Undecided:
    """Contacts that may change: ``row`` (contacts, bodies) is the direction of their motion and
    force; all others (contacts,): ``acts``: whether they hold; ``stop``: index of the stop, or −1;
    ``friction`` likewise."""

    row: Array
    acts: Flags
    stop: NDArray[np.int_]
    friction: NDArray[np.int_]


@dataclass(frozen=True, eq=False, slots=True)
class Rates:
    """Rates over the share of the step at unchanged contacts: of positions ``x`` (bodies,) [m], of
    ``friction`` that sticks (frictions,) and of the forces ``press`` of closed stops (stops,) [N].

    ``pace`` [m]: reference of ``x``, above its rounding also where every body is held.
    """

    x: Array
    friction: Array
    press: Array
    pace: float


def rates(step: Step, state: State) -> Rates:
    """Compute the rates of a state at unchanged contacts."""
    force, gap, size = step.rate(state.at)
    joints = held(step.network, state, gap)
    driven = _driven(joints.row, joints.rigid, gap)
    x, mu = solve(state.at.stiffness, force, joints.row, driven)
    friction, press = np.zeros_like(state.friction), np.zeros_like(state.press)
    _, pressing, friction[joints.sticks] = joints.forces(mu)
    press[joints.closed] = step.network.stops.side[joints.closed] * pressing
    return Rates(x, friction, press, _pace(x, size, state))


def _pace(v: Array, size: float, state: State) -> float:
    """``Rates.pace`` [m]; its second term keeps it positive where all bodies are held."""
    slow = SLOW * size / max(float(state.at.stiffness.max()), TINY)
    return float(np.abs(v).max()) + slow + TINY


def velocity(step: Step, state: State) -> Array:
    """dx over the share of the step (bodies,) at unchanged contacts."""
    return rates(step, state).x


def updated_contacts(step: Step, state: State, share: float, sticks: int | None = None) -> State:
    """Determine the contacts with which the path continues at ``share`` of the step; friction
    ``sticks`` is known to stick.

    Raises
    ------
    NoEquilibrium : rounding decides which contacts hold
    """
    pending = _undecided(step.network, state, sticks)
    if not len(pending.row):
        return state
    slip, closed = state.slip.copy(), state.closed.copy()
    slip[pending.friction[pending.friction >= 0]], closed[pending.stop[pending.stop >= 0]] = (
        1,
        False,
    )
    fixed = replace(state, slip=slip, closed=closed)
    return _decided(step.network, state, pending, _complementary(step, fixed, share, pending))


def _undecided(network: Network, state: State, sticks: int | None) -> Undecided:
    """Stops that just touch or carry no force, and friction at its limit except ``sticks``."""
    stops, frictions = network.stops, network.frictions
    gap = stops.side * (stops.row @ state.x - stops.limit)
    stop = np.flatnonzero(
        np.where(state.closed, state.press <= AT_LIMIT * state.at.size, gap <= TOUCHING)
    )
    at_limit = np.abs(state.friction) >= (1.0 - AT_LIMIT) * frictions.limit
    at_limit &= frictions.limit > 0.0
    at_limit[[] if sticks is None else [sticks]] = False
    friction = np.flatnonzero(at_limit)
    direction = np.where(state.slip == 0, -np.sign(state.friction), state.slip)
    return Undecided(
        row=np.concatenate(
            [
                stops.side[stop, None] * stops.row[stop],
                direction[friction, None] * frictions.row[friction],
            ]
        ),
        acts=np.concatenate([state.closed[stop], state.sticks[friction]]),
        stop=np.concatenate([stop, np.full(len(friction), -1)]),
        friction=np.concatenate([np.full(len(stop), -1), friction]),
    )


def _complementary(step: Step, fixed: State, share: float, pending: Undecided) -> Flags:
    """Whether each of the contacts holds; ``fixed``: the state with all of them free.

    Those that hold are independent: otherwise the least-index method may cycle.
    """
    force, gap, size = step.rate(fixed.at)
    joints = held(step.network, fixed, gap)
    driven = _driven(joints.row, joints.rigid, gap)
    acts = pending.acts.copy()
    acts[acts] = independent(np.concatenate([joints.row, pending.row[acts]]))[len(driven) :]
    for _ in range(FLIPS):
        row = np.concatenate([joints.row, pending.row[acts]])
        target = np.concatenate([driven, np.zeros(len(row) - len(driven))])
        v, mu = solve(fixed.at.stiffness, force, row, target)
        push = np.zeros(len(acts))
        push[acts] = mu[len(driven) :]
        opening = np.where(acts, 0.0, pending.row @ v)
        violated = opening < -ROUNDING * _pace(v, size, fixed)
        violated |= push < -ROUNDING * size
        if not violated.any():
            return acts
        first = int(np.flatnonzero(violated)[0])
        acts[first] = not acts[first]
    raise endless(step, share, velocity(step, fixed))


def _driven(row: Array, rigid: list[int], gap: Array) -> Array:
    """Rates of the held joints: rigid springs follow their gaps, all others are at rest."""
    rate = np.zeros(len(row))
    rate[: len(rigid)] = gap[rigid]
    return rate


def _decided(network: Network, state: State, pending: Undecided, acts: Flags) -> State:
    """Update the contacts: those that ``acts`` marks hold, and the others move."""
    closed, press = state.closed.copy(), state.press.copy()
    slip, friction, anchor = state.slip.copy(), state.friction.copy(), state.anchor.copy()
    for k, (stop, index) in enumerate(
        zip(pending.stop.tolist(), pending.friction.tolist(), strict=True)
    ):
        if stop >= 0:
            closed[stop] = acts[k]
            press[stop] = max(press[stop], 0.0) if acts[k] else 0.0
        elif acts[k]:
            anchor[index] = network.frictions.row[index] @ state.x if slip[index] else anchor[index]
            slip[index] = 0
        else:
            direction = slip[index] or -int(np.sign(friction[index]))
            slip[index], friction[index] = direction, -direction * network.frictions.limit[index]
    return replace(state, closed=closed, press=press, slip=slip, friction=friction, anchor=anchor)


def compliance(step: Step, state: State) -> Array:
    """dx (bodies,) by the change of force of the step, at unchanged contacts."""
    force = step.end.force - step.start.force
    joints = held(step.network, state, np.zeros(len(step.network.springs.force)))
    return solve(state.at.stiffness, force, joints.row, np.zeros(len(joints.row)))[0]
