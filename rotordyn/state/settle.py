"""Where a network comes to rest after it snapped: the next equilibrium down the energy.

Friction resists from where it was, stops from where they stand: the energy is convex between its
kinks, and an active set of kinks is walked until every held joint carries what it may.
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
BEYOND = 1e-9  # of a limit: a held joint carries too much
FURTHEST = 5e-3  # m from where it snapped: no spindle holds a body there
TOUCHING = 1e-13  # m


def settle(step: Step, state: State, share: float) -> State | None:
    """The next equilibrium when ``share`` of the step is done; None where there is none."""
    network, load = step.network, step.load(share)
    here = _stuck(network, state)
    for _ in range(ROUNDS):
        joints = held(network, here, load.gap)
        fixed = contact_forces(network, without_joint_forces(network, here, joints))
        at = step.forces(here.x, load)
        miss = joints.target - joints.row @ here.x
        dx, mu = solve(at.stiffness, at.force + fixed, joints.row, miss)
        size = at.size + float(np.abs(fixed).sum()) + TINY
        if np.abs(miss).max(initial=0.0) > PLACED:
            here = replace(here, x=here.x + dx)
        elif np.abs(at.force + fixed + mu @ joints.row).max() >= ENOUGH * size:
            dx = dx * min(1.0, LONGEST / float(np.abs(dx).max()))
            reach, kink = _first_kink(network, here, dx)
            x, _ = advance(step, load, fixed, here.x, reach * dx, at)
            arrived = kink >= 0 and np.array_equal(x, here.x + reach * dx)
            here = replace(here, x=x)
            here = _on_kink(network, here, kink) if arrived else here
        elif (easier := _overcome(network, here, joints, mu, size)) is not None:
            here = easier
        else:
            return hold(step, here, share)
        if np.abs(here.x - state.x).max() > FURTHEST:
            return None
    return None


def _stuck(network: Network, state: State) -> State:
    """The state with every contact held where it touches."""
    gap = network.stops.side * (network.stops.row @ state.x - network.stops.limit)
    closed = gap <= TOUCHING
    return replace(
        state,
        slip=np.zeros_like(state.slip),
        anchor=network.frictions.row @ state.x,
        closed=closed,
        press=np.where(closed, state.press, 0.0),
    )


def _overcome(network: Network, here: State, joints: Held, mu: Array, size: float) -> State | None:
    """The state without the contact that carries most beyond what it may; None if none does."""
    _, press, rub = joints.forces(mu)
    pull = -network.stops.side[joints.closed] * press / size
    limit = network.frictions.limit[joints.sticks]
    over = np.concatenate([pull, np.abs(rub) / limit - 1.0])
    if over.max(initial=0.0) <= BEYOND:
        return None
    worst = int(over.argmax())
    if worst < len(joints.closed):
        closed, forces = here.closed.copy(), here.press.copy()
        closed[joints.closed[worst]], forces[joints.closed[worst]] = False, 0.0
        return replace(here, closed=closed, press=forces)
    k = joints.sticks[worst - len(joints.closed)]
    slip, friction = here.slip.copy(), here.friction.copy()
    slip[k] = -int(np.sign(rub[worst - len(joints.closed)]))
    friction[k] = -slip[k] * network.frictions.limit[k]
    return replace(here, slip=slip, friction=friction)


def _first_kink(network: Network, here: State, dx: Array) -> tuple[float, int]:
    """Share of ``dx`` to the first contact that comes to hold, and which: stops, then friction.

    (1, −1) where none does.
    """
    stops, frictions = network.stops, network.frictions
    gap = stops.side * (stops.row @ here.x - stops.limit)
    out = here.slip * (frictions.row @ here.x - here.anchor)
    room = np.concatenate([gap, out])
    way = -np.concatenate([stops.side * (stops.row @ dx), here.slip * (frictions.row @ dx)])
    meets = np.concatenate([~here.closed, here.slip != 0]) & (way > room) & (way > 0.0)
    if not meets.any():
        return 1.0, -1
    share = np.where(meets, np.maximum(room, 0.0) / np.where(meets, way, 1.0), np.inf)
    return float(share.min()), int(share.argmin())


def _on_kink(network: Network, here: State, kink: int) -> State:
    if kink < len(here.closed):
        closed = here.closed.copy()
        closed[kink] = True
        return replace(here, closed=closed)
    slip = here.slip.copy()
    slip[kink - len(here.closed)] = 0
    return replace(here, slip=slip)
