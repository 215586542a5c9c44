"""Static bending of the rotor in one plane, seen only where something acts on it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.support import node_matrix
from rotordyn.machine.spindle import Spindle
from rotordyn.system.assemble import bending_plane
from rotordyn.system.dofs import PLANE_Y
from rotordyn.system.mesh import Mesh

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class CondensedRotor:
    """Exact static stiffness (p, p) of rotor, linear supports and sprung sleeves in plane y.

    ``seats`` (seats, 2, p): deflection and tilt between the rings of each bearing; ``point`` (p,):
    deflection of the point loaded.
    """

    stiffness: Array
    seats: Array
    point: Array


def condensed_rotor(spindle: Spindle, mesh: Mesh, x: float, *, rigid: bool) -> CondensedRotor:
    """Condense the rotor to its bearings, its supports and the node at ``x`` [m].

    A ``rigid`` rotor keeps deflection at x = 0 and tilt. Supports act with their y–θz part.
    """
    stations = mesh.nodes_of(spindle.seats, spindle.supports)
    point = mesh.node_of(x)
    if rigid:
        rows = np.zeros((mesh.nodes, 2, 2))
        rows[:, 0, 0], rows[:, 0, 1], rows[:, 1, 1] = 1.0, mesh.x, 1.0
        stiffness = np.zeros((2, 2))
    else:
        kept = sorted({*stations, point})
        freedoms = [PLANE_Y.row(n, f) for n in kept for f in PLANE_Y.names]
        stiffness = _schur(bending_plane(spindle, mesh).stiffness, freedoms)
        rows = np.zeros((mesh.nodes, 2, len(freedoms)))
        rows[kept] = np.eye(len(freedoms)).reshape(len(kept), 2, -1)
    for support, node in zip(spindle.supports, stations[len(spindle.seats) :], strict=True):
        block = PLANE_Y.take(node_matrix(support.stiffness))
        stiffness = stiffness + rows[node].T @ block @ rows[node]
    seats = rows[stations[: len(spindle.seats)]]
    return _with_sleeves(spindle, stiffness, seats, rows[point, 0])


def _schur(stiffness: Array, kept: list[int]) -> Array:
    """Kept freedoms with all others left to themselves."""
    from scipy.linalg import solve

    chosen = np.array(kept)
    others = np.setdiff1d(np.arange(len(stiffness)), chosen)
    own = stiffness[chosen][:, chosen]
    if not others.size:
        return own
    across = stiffness[others][:, chosen]
    return own - across.T @ solve(stiffness[others][:, others], across, assume_a="pos")


def _with_sleeves(spindle: Spindle, stiffness: Array, seats: Array, point: Array) -> CondensedRotor:
    """Add the deflection of every sprung sleeve as one more coordinate."""
    sprung = [s for s in spindle.sleeves if math.isfinite(s.radial_stiffness)]
    more = len(sprung)
    seats = np.pad(seats, ((0, 0), (0, 0), (0, more)))
    stiffness = np.pad(stiffness, ((0, more), (0, more)))
    for k, sleeve in enumerate(sprung):
        place = stiffness.shape[0] - more + k
        stiffness[place, place] = sleeve.radial_stiffness
        for row, seat in enumerate(spindle.seats):
            if seat.name in sleeve.bearings:
                seats[row, 0, place] = -1.0
    return CondensedRotor(stiffness, seats, np.pad(point, (0, more)))
