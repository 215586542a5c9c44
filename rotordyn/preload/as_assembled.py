"""Machine as assembled: its equilibrium at rest, and the positions of springs and stops there.

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

NO_SHARE = 1e-9  # of the largest preload: a bearing with less load may float within its play


def mounted(joined: Sequence[Arrangement]) -> Iterator[NetworkState]:
    """Yield the equilibrium of each arrangement at rest under its stated preloads (one speed)."""
    parts = []
    for machine in joined:
        at_rest, zero = as_mounted(machine), np.zeros((1, len(machine.bodies)))
        parts.append(Network(at_rest, Springs(_preloads(at_rest), zero, zero, zero[0] > 0.0)))
    network = Network.side_by_side(parts)
    start = _initial_positions(network)
    state = solve(network, start, np.zeros(start.shape, dtype=bool), start)
    return state.parts([1] * len(parts))


def springs(spindle: Spindle, joined: Arrangement, rest: Array) -> Springs:
    """Return the springs, which act about the positions ``rest`` (1, bodies) [m].

    Linear supports hold the shaft along the axis by a spring that is without force at rest, at the
    position of the supports.
    """
    fixed = np.array([False, *map(rigid, joined.pushes)])
    axial = sum(support.along for support in spindle.supports)
    stiffness = np.array([[axial, *(push.stiffness for push in joined.pushes)]])
    shift = np.multiply.outer(joined.support_shift, np.arange(len(fixed)) == SHAFT)
    return Springs(_preloads(joined), np.where(fixed, 0.0, stiffness), rest - shift, fixed)


def limits(joined: Arrangement, rest: Array) -> Array:
    """Return the positions at which stops end the travel (bodies,) [m]; NaN without a stop."""
    travel = [push.travel if has_stop(push) else np.nan for push in joined.pushes]
    return rest - joined.direction * [np.nan, *travel]


def _preloads(joined: Arrangement) -> Array:
    """Forces of the springs at rest, towards +x (1, bodies) [N]."""
    return joined.direction[None] * [0.0, *(push.preload for push in joined.pushes)]


def _initial_positions(network: Network) -> Array:
    """Estimate the positions at rest (machines, bodies) [m]: least-squares fit to the deflections
    of bearings under their likely loads."""
    b, tandem, force = network.incidence, network.tandem, network.springs.force
    share = np.linalg.lstsq((tandem[:, None] * b).T, force.T, rcond=None)[0].T
    largest = np.abs(force).max(axis=1, keepdims=True)
    # a bearing with thrust one way starts loaded, whatever its share of the spring forces
    likely = np.maximum(np.where(network.both_ways, np.abs(share), share), 0.05 * largest + 1.0)
    likely = np.where(network.both_ways, np.copysign(likely, share), likely)
    load = np.zeros((*likely.shape, 5))
    load[..., 0] = likely
    deflection = np.empty(likely.shape)
    for batch in network.solve_bearings(range(likely.shape[1]), None, load=load).values():
        deflection[:, batch.places] = batch.state.displacement[..., 0]
    carries = ~network.both_ways | (np.abs(share) > NO_SHARE * largest)
    return np.stack(
        [
            np.linalg.lstsq(b[loaded], deflections[loaded], rcond=None)[0]
            for loaded, deflections in zip(carries, deflection, strict=True)
        ]
    )
