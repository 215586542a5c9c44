"""Bending, axial motion and torsion in one system, where supports or housings couple them.

Each motion keeps its own coordinates, bending those of its real form; what a support adds between
two motions joins them. Housings follow with theirs (``foundation``).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import accumulate, pairwise

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.node import FREEDOMS
from rotordyn.elements.support import along_and_about, support_matrices, turn
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import MOTIONS
from rotordyn.system.connections import connections, moved, supported
from rotordyn.system.foundation import foundation
from rotordyn.system.lateral import LateralSystem
from rotordyn.system.longitudinal import RodSystem
from rotordyn.system.mesh import Mesh

Array = NDArray[np.float64]
_OWNER = np.array([MOTIONS[freedom] for freedom in FREEDOMS])
BETWEEN = _OWNER[:, None] != _OWNER  # places of a 6×6 matrix that couple two motions


@dataclass(frozen=True, eq=False, slots=True)
class Carried:
    """Bearings, then supports, and the housings under them: k coordinates, the last of the system.

    ``held``, ``damped`` (speeds, connections, 6, 6): matrices of the connections; ``under``
    (connections, 6, n): motion of the place under each, by all coordinates.
    """

    held: Array
    damped: Array
    under: Array
    size: int


@dataclass(frozen=True, eq=False, slots=True)
class CoupledSystem:
    """q̈ + ``damping`` q̇ + ``stiffness`` q = f, real arrays (speeds, n, n).

    ``places``: the coordinates that belong to each motion; ``motion`` (nodes, 6, n): displacements
    of the nodes by the coordinates.
    ``parts``: the systems joined; ``supports`` (2, supports, 6, 6): what supports add between
    them, stiffness and damping; ``at_supports`` (supports, 6, n): motion between their ends.
    ``carried``: what stands on housings; None where nothing does.
    """

    parts: Mapping[str, LateralSystem | RodSystem]
    places: Mapping[str, slice]
    motion: Array
    stiffness: Array
    damping: Array
    supports: Array
    at_supports: Array
    carried: Carried | None = None


def coupled_system(
    spindle: Spindle,
    mesh: Mesh,
    parts: Mapping[str, LateralSystem | RodSystem],
    seat_stiffness: Array | None = None,
    speed: Array | None = None,
) -> CoupledSystem:
    """Join the systems of some motions (``"bending"`` …) by what the supports add between them.

    Bending must be in its real form; a part that is the same at all speeds may have one only.
    ``seat_stiffness`` (speeds, seats, 5, 5): tangents in the bearings' own frames, at ``speed``
    (speeds,) [rad/s]; needed where housings carry something.
    """
    motion = np.concatenate([part.motion for part in parts.values()], axis=-1)
    rows = moved(supported(spindle.supports, mesh), motion)
    ends = [0, *accumulate(part.motion.shape[-1] for part in parts.values())]
    between = np.array(
        [
            [np.where(BETWEEN, along_and_about(s, which), 0.0) for s in spindle.supports]
            for which in ("stiffness", "damping")
        ]
    ).reshape(2, -1, 6, 6)
    joined = np.einsum("kin,wkij,kjm->wnm", rows, between, rows, optimize=True)
    rotor = CoupledSystem(
        parts=parts,
        places={name: slice(*ends) for name, ends in zip(parts, pairwise(ends), strict=True)},
        motion=motion,
        stiffness=_side_by_side([part.stiffness for part in parts.values()]) + joined[0],
        damping=_side_by_side([part.damping for part in parts.values()]) + joined[1],
        supports=between,
        at_supports=rows,
    )
    if not spindle.housings or seat_stiffness is None or speed is None:
        return rotor
    return _on_housings(spindle, mesh, rotor, seat_stiffness, speed)


def _on_housings(
    spindle: Spindle, mesh: Mesh, rotor: CoupledSystem, seat_stiffness: Array, speed: Array
) -> CoupledSystem:
    """The same with the coordinates of the housings behind those of the rotor."""
    base, size = foundation(spindle), rotor.motion.shape[-1]
    held = _connections(spindle, seat_stiffness, speed, "stiffness")
    damped = _connections(spindle, seat_stiffness, speed, "damping")
    rows = moved(connections(spindle, mesh), rotor.motion)
    under = np.pad(base.under, ((0, 0), (0, 0), (size, 0)))
    wide = ((0, 0), (0, 0), (0, base.size))
    return replace(
        rotor,
        motion=np.pad(rotor.motion, wide),
        at_supports=np.pad(rotor.at_supports, wide),
        stiffness=_wide(rotor.stiffness, rows, held, base.under, base.stiffness),
        damping=_wide(rotor.damping, rows, damped, base.under, base.damping),
        carried=Carried(held, damped, under, base.size),
    )


def _wide(before: Array, rows: Array, blocks: Array, under: Array, own: Array) -> Array:
    """A matrix of the rotor on ground, on housings with their ``own``."""
    size = before.shape[-1]
    whole = np.zeros((len(blocks), size + len(own), size + len(own)))
    whole[:, :size, :size] = before
    whole[:, :size, size:] = -_between(rows, blocks, under)
    whole[:, size:, :size] = -_between(under, blocks, rows)
    whole[:, size:, size:] = own + _between(under, blocks, under)
    return whole


def _connections(spindle: Spindle, seat_stiffness: Array, speed: Array, which: str) -> Array:
    """Matrices of bearings, then supports (speeds, connections, 6, 6)."""
    blocks = []
    for k, seat in enumerate(spindle.seats):
        if which == "stiffness":
            blocks.append(turn(seat_stiffness[:, k], seat.thrust))
        else:
            damper = np.diag([seat.axial_damping, *[seat.radial_damping] * 2, 0.0, 0.0, 0.0])
            blocks.append(np.broadcast_to(damper, (len(speed), 6, 6)))
    blocks += [support_matrices(support, which, speed) for support in spindle.supports]
    return np.stack(blocks, axis=1)


def _between(left: Array, blocks: Array, right: Array) -> Array:
    """Σ leftᵀ block right over the connections (speeds, a, b)."""
    return np.einsum("cia,scij,cjb->sab", left, blocks, right, optimize=True)


def _side_by_side(matrices: list[NDArray[np.inexact]]) -> Array:
    """Block diagonal of (speeds or 1, k, k) matrices."""
    size = sum(matrix.shape[-1] for matrix in matrices)
    whole = np.zeros((max(len(matrix) for matrix in matrices), size, size))
    begin = 0
    for matrix in matrices:
        own = slice(begin, begin + matrix.shape[-1])
        whole[:, own, own] = matrix
        begin = own.stop
    return whole
