"""Which nodes bearings and supports join: all that tells a support between rotors from the rest."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import GROUND, LinearSupport
from rotordyn.system.mesh import Mesh

Array = NDArray[np.float64]


def connections(spindle: Spindle, mesh: Mesh) -> Array:
    """Of bearings, then supports: 1 at the node that each holds, −1 at the one it stands on.

    (connections, nodes of all rotors); what stands on ground or a housing has the first alone.
    """
    seats = np.zeros((len(spindle.seats), len(mesh.stations)))
    seats[np.arange(len(seats)), mesh.nodes_of(spindle.seats)] = 1.0
    return np.concatenate([seats, supported(spindle.supports, mesh)])


def supported(supports: tuple[LinearSupport, ...], mesh: Mesh) -> Array:
    """Of supports alone, likewise."""
    ends = np.zeros((len(supports), len(mesh.stations)))
    for row, support in zip(ends, supports, strict=True):
        row[mesh.node_at(support.holds, support.x)] = 1.0
        if support.against != GROUND:
            row[mesh.node_at(support.against, support.x)] = -1.0
    return ends


def moved(ends: Array, motion: Array) -> Array:
    """Motion between the ends of connections (c, …), of nodes (nodes, …)."""
    return np.asarray(np.tensordot(ends, motion, 1))
