"""Bending, axial motion and torsion in one system, where supports or housings couple them.

Each motion keeps its own coordinates, bending those of its real form; what a support adds between
two motions joins them. Housings follow with theirs (``foundation``).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate, pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.node import FREEDOMS
from rotordyn.elements.support import along_and_about, support_matrices, turn
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import MOTIONS
from rotordyn.system.connections import connections, moved, supported
from rotordyn.system.foundation import foundation
from rotordyn.system.hysteresis import Hysteresis, Signs
from rotordyn.system.lateral import LateralSystem
from rotordyn.system.longitudinal import RodSystem
from rotordyn.system.mesh import Mesh

Array = NDArray[np.float64]
Matrix = NDArray[np.inexact[Any]]
_OWNER = np.array([MOTIONS[freedom] for freedom in FREEDOMS])
BETWEEN = _OWNER[:, None] != _OWNER  # places of a 6×6 matrix that couple two motions


@dataclass(frozen=True, eq=False, slots=True)
class Carried:
    """Bearings, then supports, and the housings under them: k coordinates, the last of the system.

    ``held``, ``damped`` (speeds, connections, 6, 6): matrices of the connections; ``under``
    (connections, 6, n): motion of the place under each, by all coordinates; ``apart``, likewise: of
    what it holds against that place. ``connected`` (connections, nodes): what each holds.
    """

    held: Matrix
    damped: Array
    under: Array
    apart: Array
    connected: Array
    size: int


@dataclass(frozen=True, eq=False, slots=True)
class CoupledSystem:
    """q̈ + ``damping`` q̇ + ``stiffness`` q = f, real arrays (speeds, n, n).

    ``places``: the coordinates that belong to each motion; ``motion`` (nodes, 6, n): displacements
    of the nodes by the coordinates.
    ``parts``: the systems joined; ``supports`` (2, supports, 6, 6): what supports add between
    them, stiffness and damping; ``at_supports`` (supports, 6, n): motion between their ends.
    ``carried``: what stands on housings; None where nothing does. ``hysteresis``: what loss factors
    add to the stiffness; None where there are none.
    """

    parts: Mapping[str, LateralSystem | RodSystem]
    places: Mapping[str, slice]
    motion: Array
    stiffness: Matrix
    damping: Array
    supports: Matrix
    at_supports: Array
    carried: Carried | None = None
    hysteresis: Hysteresis | None = None

    def answering(self, signs: Signs) -> CoupledSystem:
        """The linear system that answers motions of these signs: loss is in its stiffness."""
        own, carried = self.hysteresis, self.carried
        if own is None:
            return self
        supports = own.connections[len(own.connections) - len(self.at_supports) :]
        lossy = 1.0 + 1j * signs.fixed * supports[:, None, None]
        if carried is not None:
            carried = replace(carried, held=own.held(carried.held, signs))
        return replace(
            self,
            parts={name: part.answering(signs) for name, part in self.parts.items()},
            stiffness=self.stiffness + own.stiffness(signs),
            supports=np.stack([self.supports[0] * lossy, self.supports[1] + 0j]),
            carried=carried,
            hysteresis=None,
        )


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
        hysteresis=_hysteresis(spindle, parts, rows, between[0]),
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
    connected = connections(spindle, mesh)
    rows = moved(connected, rotor.motion)
    under = np.pad(base.under, ((0, 0), (0, 0), (size, 0)))
    wide = ((0, 0), (0, 0), (0, base.size))
    return replace(
        rotor,
        motion=np.pad(rotor.motion, wide),
        at_supports=np.pad(rotor.at_supports, wide),
        stiffness=_wide(rotor.stiffness, rows, held, base.under, base.stiffness),
        damping=_wide(rotor.damping, rows, damped, base.under, base.damping),
        carried=Carried(held, damped, under, np.pad(rows, wide) - under, connected, base.size),
        hysteresis=_hysteresis_on_housings(rotor.hysteresis, rows, held, base.under),
    )


def _hysteresis(
    spindle: Spindle, parts: Mapping[str, LateralSystem | RodSystem], rows: Array, between: Array
) -> Hysteresis | None:
    """Of all parts, and of what supports add ``between`` them (supports, 6, 6)."""
    own = [part.hysteresis for part in parts.values() if part.hysteresis is not None]
    if not own:
        return None
    factors = np.array([support.loss_factor for support in spindle.supports])
    joined = np.einsum("kin,kij,kjm->nm", rows, factors[:, None, None] * between, rows)
    return Hysteresis(
        _side_by_side([each.fixed for each in own]) + joined,
        _side_by_side([each.turning[None] for each in own])[0],
        _side_by_side([_across(each)[None] for each in own])[0],
        np.array(spindle.connection_losses),
    )


def _across(own: Hysteresis) -> Array:
    return np.zeros_like(own.turning) if own.across is None else own.across


def _hysteresis_on_housings(
    own: Hysteresis | None, rows: Array, held: Array, under: Array
) -> Hysteresis | None:
    """The same with the coordinates of the housings, which have no loss factor themselves."""
    if own is None:
        return None
    more = under.shape[-1]
    lossy, wide = held * own.connections[:, None, None], ((0, more), (0, more))
    return Hysteresis(
        _wide(own.fixed, rows, lossy, under, np.zeros((more, more))),
        np.pad(own.turning, wide),
        np.pad(_across(own), wide),
        own.connections,
    )


def _wide(before: Matrix, rows: Array, blocks: Array, under: Array, own: Array) -> Array:
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
            blocks.append(np.where(BETWEEN, 0.0, turn(seat_stiffness[:, k], seat.thrust)))
        else:
            damper = np.diag([seat.axial_damping, *[seat.radial_damping] * 2, 0.0, 0.0, 0.0])
            blocks.append(np.broadcast_to(damper, (len(speed), 6, 6)))
    blocks += [support_matrices(support, which, speed) for support in spindle.supports]
    return np.stack(blocks, axis=1)


def _between(left: Array, blocks: Array, right: Array) -> Array:
    """Σ leftᵀ block right over the connections (speeds, a, b)."""
    return np.einsum("cia,scij,cjb->sab", left, blocks, right, optimize=True)


def _side_by_side(matrices: Sequence[Matrix]) -> Array:
    """Block diagonal of (speeds or 1, k, k) matrices."""
    size = sum(matrix.shape[-1] for matrix in matrices)
    whole = np.zeros((max(len(matrix) for matrix in matrices), size, size))
    begin = 0
    for matrix in matrices:
        own = slice(begin, begin + matrix.shape[-1])
        whole[:, own, own] = matrix
        begin = own.stop
    return whole
