"""What a mode is: how much of it a rigid shaft could do, which way it whirls along the shaft."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.branches import PLANAR, Branch, whirl_degree
from rotordyn.elements.node import FREEDOMS
from rotordyn.system.coupled import CoupledSystem
from rotordyn.system.lateral import LateralSystem
from rotordyn.system.longitudinal import RodSystem

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
System = LateralSystem | RodSystem | CoupledSystem
MOSTLY = 0.5  # of the kinetic energy
FELT = 1e-3  # of the largest deflection squared: where less moves, no direction is seen


def rigid_share(system: System, branch: Branch) -> Array:
    """Share of the kinetic energy of a mode (speeds,) in motions of rigid rotors, NaN if lost."""
    moved = branch.vector @ _rigid_motions(system, branch)
    whole = (np.abs(branch.vector) ** 2).sum(axis=1)
    share = (np.abs(moved) ** 2).sum(axis=1) / whole
    return np.where(branch.column < 0, np.nan, share)


def character(branch: Branch, share: Array) -> str:
    """The kind of a mode, and whether it is rather a rigid-body motion, over all speeds."""
    return f"rigid-body {branch.kind}" if np.nanmean(share) > MOSTLY else branch.kind


def whirl_along(system: System, vector: Complex, degree: float) -> str:
    """``"forward"``, ``"backward"``, ``"planar"`` or ``"mixed"`` for a bending mode ``vector``
    (n,): mixed where some nodes go round one way and others the other."""
    if isinstance(system, LateralSystem) and system.isotropic:
        return "forward" if degree > 0.0 else "backward"
    if abs(degree) < PLANAR:
        return "planar"
    y, z = (system.motion[:, FREEDOMS.index(name)] @ vector for name in ("y", "z"))
    size = np.abs(y) ** 2 + np.abs(z) ** 2
    felt = size > FELT * size.max()
    turn = whirl_degree(np.stack([y, z], axis=1)[felt], np.zeros(felt.sum(), dtype=bool))
    if turn.min() < -PLANAR and turn.max() > PLANAR:
        return "mixed"
    return "forward" if degree > 0.0 else "backward"


def _rigid_motions(system: System, branch: Branch) -> Array:
    """Orthonormal coordinates of rigid motions (n, r); energy is the square of coordinates."""
    size = branch.vector.shape[1]
    columns: list[int] = []
    if isinstance(system, CoupledSystem):
        parts = [(part, system.places[name].start, name) for name, part in system.parts.items()]
    else:
        parts = [(system, 0, branch.kind)]
    for part, start, name in parts:
        width = part.motion.shape[-1] // 2 if name == "bending" else 0
        for plane in range(part.planes):
            columns += [start + plane * width + int(k) for k in np.flatnonzero(_rigid(part))]
    return np.eye(size)[:, columns]


def _rigid(part: LateralSystem | RodSystem) -> NDArray[np.bool_]:
    return part.rotor.rigid if isinstance(part, LateralSystem) else part.rigid
