"""Bending, axial motion and torsion in one system, where linear supports couple them.

Each motion keeps its own coordinates, bending those of its real form; what a support adds between
two motions joins them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import accumulate, pairwise

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.node import FREEDOMS
from rotordyn.elements.support import along_and_about
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import MOTIONS
from rotordyn.system.lateral import LateralSystem
from rotordyn.system.longitudinal import RodSystem
from rotordyn.system.mesh import Mesh

Array = NDArray[np.float64]
_OWNER = np.array([MOTIONS[freedom] for freedom in FREEDOMS])
BETWEEN = _OWNER[:, None] != _OWNER  # places of a 6×6 matrix that couple two motions


@dataclass(frozen=True, eq=False, slots=True)
class CoupledSystem:
    """q̈ + ``damping`` q̇ + ``stiffness`` q = f, real arrays (speeds, n, n).

    ``places``: the coordinates that belong to each motion; ``motion`` (nodes, 6, n): displacements
    of the nodes by the coordinates.
    ``parts``: the systems joined; ``supports`` (2, supports, 6, 6): what supports add between
    them, stiffness and damping; ``at_supports`` (supports, 6, n): motion of their nodes.
    """

    parts: Mapping[str, LateralSystem | RodSystem]
    places: Mapping[str, slice]
    motion: Array
    stiffness: Array
    damping: Array
    supports: Array
    at_supports: Array


def coupled_system(
    spindle: Spindle, mesh: Mesh, parts: Mapping[str, LateralSystem | RodSystem]
) -> CoupledSystem:
    """Join the systems of some motions (``"bending"`` …) by what the supports add between them.

    Bending must be in its real form; a part that is the same at all speeds may have one only.
    """
    motion = np.concatenate([part.motion for part in parts.values()], axis=-1)
    rows = motion[mesh.nodes_of(spindle.supports)]
    ends = [0, *accumulate(part.motion.shape[-1] for part in parts.values())]
    between = np.array(
        [
            [np.where(BETWEEN, along_and_about(s, which), 0.0) for s in spindle.supports]
            for which in ("stiffness", "damping")
        ]
    )
    joined = np.einsum("kin,wkij,kjm->wnm", rows, between, rows, optimize=True)
    return CoupledSystem(
        parts=parts,
        places={name: slice(*ends) for name, ends in zip(parts, pairwise(ends), strict=True)},
        motion=motion,
        stiffness=_side_by_side([part.stiffness for part in parts.values()]) + joined[0],
        damping=_side_by_side([part.damping for part in parts.values()]) + joined[1],
        supports=between,
        at_supports=rows,
    )


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
