"""Static bending of the rotor in one plane, seen only where something acts on it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.support import support_matrices
from rotordyn.machine.spindle import Spindle
from rotordyn.numerics.eigenvalue_count import condensed
from rotordyn.numerics.sparse import Matrix, is_sparse
from rotordyn.system.assemble import bending_plane
from rotordyn.system.dofs import PLANE_Y
from rotordyn.system.mesh import Mesh
from rotordyn.system.stiffening import Stiffening, stiffening

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class CondensedRotor:
    """Exact static stiffness (states, p, p) of rotor, drawbar, sprung sleeves and, in plane y,
    linear supports, a state being an axial force in the shaft and a speed of the supports.

    ``free``: the same without the supports. NaN where the shaft buckles between the places kept.
    ``seats`` (seats, 2, p): deflection and tilt between the rings of each bearing; ``supports``
    (supports, 2, p): those of each support's node; ``point`` (p,): deflection of the point loaded.
    """

    stiffness: Array
    free: Array
    seats: Array
    supports: Array
    point: Array

    def at(self, index: NDArray[np.intp]) -> CondensedRotor:
        """The rotor in some of its states; a single one serves all."""
        stiffness, free = (
            matrix[index if len(matrix) > 1 else np.zeros_like(index)]
            for matrix in (self.stiffness, self.free)
        )
        return replace(self, stiffness=stiffness, free=free)


def condensed_rotor(
    spindle: Spindle,
    mesh: Mesh,
    x: float,
    axial_force: Array | None = None,
    speed: Array | None = None,
    *,
    rigid: bool,
) -> CondensedRotor:
    """Condense the rotor to bearings, supports, contacts of the drawbar and the node at ``x`` [m].

    ``axial_force`` (states, elements) [N]: in the shaft, tension positive; None = one state in
    which it and the drawbar do nothing. Each state is condensed anew, so that it stays exact up to
    buckling. ``speed`` (states,) [rad/s]: of supports that follow it. A ``rigid`` rotor keeps
    deflection at x = 0 and tilt. Supports act with their y–θz part.
    """
    stations, point = mesh.nodes_of(spindle.seats, spindle.supports), mesh.node_of(x)
    contacts = spindle.drawbar.contacts if spindle.drawbar else ()
    kept = sorted({*stations, point, *map(mesh.node_of, contacts)})
    tension = stiffening(spindle, mesh)
    if rigid:
        rows = np.zeros((mesh.nodes, 2, 2))
        rows[:, 0, 0], rows[:, 0, 1], rows[:, 1, 1] = 1.0, mesh.x, 1.0
        force = np.zeros((1, mesh.nodes - 1)) if axial_force is None else axial_force
        stiffness = np.tensordot(force, tension.projected(rows), 1)
    else:
        rows = np.zeros((mesh.nodes, 2, 2 * len(kept)))
        rows[kept] = np.eye(2 * len(kept)).reshape(len(kept), 2, -1)
        stiffness = _flexible(bending_plane(spindle, mesh).stiffness, tension, axial_force, kept)
    if axial_force is not None:
        stiffness = stiffness + tension.bar(rows)
    split = len(spindle.seats)
    seats, supports = rows[stations[:split]], rows[stations[split:]]
    followed = any(support.speeds for support in spindle.supports) and speed is not None
    at = speed if followed and speed is not None else np.zeros(1)
    return _held(spindle, stiffness, at, (seats, supports), rows[point, 0])


def _flexible(
    plane: Matrix, tension: Stiffening, axial_force: Array | None, kept: list[int]
) -> Array:
    """The shaft in every state, condensed to the nodes ``kept`` (states, 2·kept, 2·kept)."""
    chosen = np.array([PLANE_Y.row(n, f) for n in kept for f in PLANE_Y.names])
    if axial_force is None:
        return _schur(plane, chosen)[None]
    return np.array([_schur(plane + tension.shaft(force), chosen) for force in axial_force])


def _schur(stiffness: Matrix, chosen: NDArray[np.intp]) -> Array:
    """Chosen freedoms with all others left to themselves; NaN where these would buckle."""
    others = np.setdiff1d(np.arange(stiffness.shape[0]), chosen)
    if is_sparse(stiffness):
        return condensed(stiffness, chosen, others)
    own = stiffness[chosen][:, chosen]
    if not others.size:
        return own
    inner, across = stiffness[others][:, others], stiffness[others][:, chosen]
    try:
        np.linalg.cholesky(inner)  # refuses what is not positive definite
        return np.asarray(own - across.T @ np.linalg.solve(inner, across))
    except np.linalg.LinAlgError:
        return np.full_like(own, np.nan)


def _held(
    spindle: Spindle, stiffness: Array, speed: Array, ends: tuple[Array, Array], point: Array
) -> CondensedRotor:
    """Add linear supports, and the deflection of every sprung sleeve as one more coordinate."""
    sprung = [s for s in spindle.sleeves if math.isfinite(s.radial_stiffness)]
    size, more = stiffness.shape[-1], len(sprung)
    free = np.pad(stiffness, ((0, 0), (0, more), (0, more)))
    seats, supports = (np.pad(rows, ((0, 0), (0, 0), (0, more))) for rows in ends)
    for place, sleeve in enumerate(sprung, start=size):
        free[:, place, place] = sleeve.radial_stiffness
        for row, seat in enumerate(spindle.seats):
            if seat.name in sleeve.bearings:
                seats[row, 0, place] = -1.0
    held = free
    for support, rows in zip(spindle.supports, supports, strict=True):
        held = held + rows.T @ PLANE_Y.take(support_matrices(support, "stiffness", speed)) @ rows
    return CondensedRotor(held, free, seats, supports, np.pad(point, (0, more)))
