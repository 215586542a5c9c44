"""Equilibrium of a network after a snap: the next one in the direction of falling energy.

Friction resists from its place before the snap, stops from their limits: the energy is convex
between its kinks, and an active set of kinks is updated until every held joint carries an
admissible force.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rotordyn.arrays import Array
from rotordyn.state.contacts import (
    ENOUGH,
    LONGEST,
    PLACED,
    TINY,
    Held,
    State,
    advance,
    contact_forces,
    held,
    hold,
    solve,
    without_joint_forces,
)
from rotordyn.state.network import Network, Step

ROUNDS = 1000
BEYOND = 1e-9  # of a limit, by which the force of a held joint is inadmissible
FURTHEST = 5e-3  # m from the place of the snap, beyond any travel of a body in a spindle
TOUCHING = 1e-13  # m


def settle(step: Step, state: State, share: float) -> State | None:
    """Find the next equilibrium at ``share`` of the step; None where there is none."""
    network, load = step.network, step.load(share)
    now = _stuck(network, state)
    for _ in range(ROUNDS):
        joints = held(network, now, load.gap)
        fixed = contact_forces(network, without_joint_forces(network, now, joints))
        at = step.forces(now.x, load)
        miss = joints.target - joints.row @ now.x
        dx, mu = solve(at.stiffness, at.force + fixed, joints.row, miss)
        size = at.size + float(np.abs(fixed).sum()) + TINY
        if np.abs(miss).max(initial=0.0) > PLACED:
            now = replace(now, x=now.x + dx)
        elif np.abs(at.force + fixed + mu @ joints.row).max() >= ENOUGH * size:
            dx = dx * min(1.0, LONGEST / float(np.abs(dx).max()))
            reach, kink = _first_kink(network, now, dx)
            x, _ = advance(step, load, fixed, now.x, reach * dx, at)
            arrived = kink >= 0 and np.array_equal(x, now.x + reach * dx)
            now = replace(now, x=x)
            now = _on_kink(network, now, kink) if arrived else now
        elif (released := _overcome(network, now, joints, mu, size)) is not None:
            now = released
        else:
            return hold(step, now, share)
        if np.abs(now.x - state.x).max() > FURTHEST:
            return None
    return None


def _stuck(network: Network, state: State) -> State:
    """Hold every contact that touches, and all friction, at its place."""
    gap = network.stops.side * (network.stops.row @ state.x - network.stops.limit)
    closed = gap <= TOUCHING
    return replace(
        state,
        slip=np.zeros_like(state.slip),
        anchor=network.frictions.row @ state.x,
        closed=closed,
        press=np.where(closed, state.press, 0.0),
    )


def _overcome(network: Network, state: State, joints: Held, mu: Array, size: float) -> State | None:
    """Release the contact with the largest inadmissible force; None if there is none."""
    _, press, rub = joints.forces(mu)
    pull = -network.stops.side[joints.closed] * press / size
    limit = network.frictions.limit[joints.sticks]
    over = np.concatenate([pull, np.abs(rub) / limit - 1.0])
    if over.max(initial=0.0) <= BEYOND:
        return None
    worst = int(over.argmax())
    if worst < len(joints.closed):
        closed, forces = state.closed.copy(), state.press.copy()
        closed[joints.closed[worst]], forces[joints.closed[worst]] = False, 0.0
        return replace(state, closed=closed, press=forces)
    k = joints.sticks[worst - len(joints.closed)]
    slip, friction = state.slip.copy(), state.friction.copy()
    slip[k] = -int(np.sign(rub[worst - len(joints.closed)]))
    friction[k] = -slip[k] * network.frictions.limit[k]
    return replace(state, slip=slip, friction=friction)


def _first_kink(network: Network, state: State, dx: Array) -> tuple[float, int]:
    """Share of ``dx`` to the first contact that becomes active, and its index: stops, frictions.

    (1, −1) where none does.
    """
    stops, frictions = network.stops, network.frictions
    gap = stops.side * (stops.row @ state.x - stops.limit)
    slid = state.slip * (frictions.row @ state.x - state.anchor)
    room = np.concatenate([gap, slid])
    travel = -np.concatenate([stops.side * (stops.row @ dx), state.slip * (frictions.row @ dx)])
    meets = np.concatenate([~state.closed, state.slip != 0]) & (travel > room) & (travel > 0.0)
    if not meets.any():
        return 1.0, -1
    share = np.where(meets, np.maximum(room, 0.0) / np.where(meets, travel, 1.0), np.inf)
    return float(share.min()), int(share.argmin())


def _on_kink(network: Network, state: State, kink: int) -> State:
    """Hold the contact with index ``kink``: a stop, or a friction after all stops."""
    if kink < len(state.closed):
        closed = state.closed.copy()
        closed[kink] = True
        return replace(state, closed=closed)
    slip = state.slip.copy()
    slip[kink - len(state.closed)] = 0
    return replace(state, slip=slip)
