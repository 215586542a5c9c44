"""A machine as assembled: its equilibrium at rest, and where that puts springs and stops.

The convention at rest: each spring carries exactly its stated preload, without external force.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from rotordyn.arrays import Array
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.arrangement import SHAFT, Arrangement, as_mounted, has_stop, rigid
from rotordyn.preload.equilibrium import solve
from rotordyn.preload.network import Network, NetworkState, Springs

NO_SHARE = 1e-9  # of the largest preload: a bearing that carries less may stand within its play


def mounted(joined: Sequence[Arrangement]) -> Iterator[NetworkState]:
    """Equilibria at rest under the stated preloads alone, each of one speed."""
    parts = []
    for each in joined:
        still, nothing = as_mounted(each), np.zeros((1, len(each.bodies)))
        parts.append(Network(still, Springs(_preloads(still), nothing, nothing, nothing[0] > 0.0)))
    network = Network.side_by_side(parts)
    start = _seated(network)
    state = solve(network, start, np.zeros(start.shape, dtype=bool), start)
    return state.parts([1] * len(parts))


def springs(spindle: Spindle, joined: Arrangement, rest: Array) -> Springs:
    """Springs acting about the place at rest (1, bodies).

    Linear supports hold the shaft along the axis without force at rest, where it is at them.
    """
    fixed = np.array([False, *map(rigid, joined.pushes)])
    along = sum(support.along for support in spindle.supports)
    stiffness = np.array([[along, *(push.stiffness for push in joined.pushes)]])
    shift = np.multiply.outer(joined.support_shift, np.arange(len(fixed)) == SHAFT)
    return Springs(_preloads(joined), np.where(fixed, 0.0, stiffness), rest - shift, fixed)


def limits(joined: Arrangement, rest: Array) -> Array:
    """Where each stop ends the travel (bodies,); NaN without one."""
    travel = [push.travel if has_stop(push) else np.nan for push in joined.pushes]
    return rest - joined.direction * [np.nan, *travel]


def _preloads(joined: Arrangement) -> Array:
    """Forces of the springs at rest, towards +x (1, bodies) [N]."""
    return joined.direction[None] * [0.0, *(push.preload for push in joined.pushes)]


def _seated(network: Network) -> Array:
    """A start at rest (machines, bodies): each bearing under its likely load, fitted by
    positions."""
    b, tandem, force = network.incidence, network.tandem, network.springs.force
    share = np.linalg.lstsq((tandem[:, None] * b).T, force.T, rcond=None)[0].T
    largest = np.abs(force).max(axis=1, keepdims=True)
    # a bearing that takes thrust one way begins pressed, however the springs may share their force
    likely = np.maximum(np.where(network.both_ways, np.abs(share), share), 0.05 * largest + 1.0)
    likely = np.where(network.both_ways, np.copysign(likely, share), likely)
    load = np.zeros((*likely.shape, 5))
    load[..., 0] = likely
    deflection = np.empty(likely.shape)
    for alike in network.solve_bearings(range(likely.shape[1]), None, load=load).values():
        deflection[:, alike.places] = alike.state.displacement[..., 0]
    carries = ~network.both_ways | (np.abs(share) > NO_SHARE * largest)
    return np.stack(
        [
            np.linalg.lstsq(b[held], each[held], rcond=None)[0]
            for held, each in zip(carries, deflection, strict=True)
        ]
    )
