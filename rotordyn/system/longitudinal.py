"""Axial motion of shaft and sleeves, and torsion of the shaft, at many speeds.

Each is a system of its own unless a support couples it to another motion (``coupled``). Along the
axis a bearing on a sleeve is in series with the sleeve's spring (a stop that is closed grounds the
sleeve); nothing but linear supports holds the spin.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.node import FREEDOMS, position
from rotordyn.elements.support import node_matrix
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import Sleeve
from rotordyn.numerics.reduction import ritz_basis
from rotordyn.system.assemble import RodMatrices, axial_rod, torsion_rod
from rotordyn.system.lateral_rotor import CUTOFF, damping_ratios, sleeve_mass
from rotordyn.system.mesh import Mesh

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
CLOSED = 1e3  # stiffness of a closed stop over that of the bearings on its sleeve


@dataclass(frozen=True, eq=False, slots=True)
class RodSystem:
    """q̈ + ``damping`` q̇ + ``stiffness`` q = f, arrays (speeds, n, n).

    ``basis`` (nodes, n): the nodes' ``freedom``, x or thx.
    """

    freedom: str
    basis: Array
    stiffness: Array
    damping: Array

    @property
    def motion(self) -> Array:
        """Displacements of the nodes by the coordinates (nodes, 6, n)."""
        motion = np.zeros((len(self.basis), len(FREEDOMS), self.basis.shape[1]))
        motion[:, position(self.freedom)] = self.basis
        return motion


def axial_system(
    spindle: Spindle,
    mesh: Mesh,
    max_frequency: float,
    ports: tuple[int, ...],
    axial_stiffness: Array,
    stops: Flags,
    *,
    rigid: bool,
) -> RodSystem:
    """Axial motion; ``axial_stiffness`` (speeds, seats), closed ``stops`` (speeds, sleeves)."""
    nodes = mesh.nodes_of(spindle.seats, spindle.supports)
    basis, values = _rod_basis(axial_rod(spindle, mesh), max_frequency, (*nodes, *ports), rigid)
    sliding = [s for s in spindle.sleeves if math.isfinite(s.spring.stiffness)]
    carried = _carried(spindle, sliding, axial_stiffness)
    scale = np.array(
        [
            sleeve_mass(s, s.spring.stiffness + float(carried[:, k].max()), max_frequency) ** -0.5
            for k, s in enumerate(sliding)
        ]
    )
    modal, size = basis.shape[1], basis.shape[1] + len(sliding)
    rows = np.zeros((len(nodes), size))
    rows[:, :modal] = basis[nodes]
    for row, seat in enumerate(spindle.seats):
        for place, sleeve in enumerate(sliding):
            if seat.name in sleeve.bearings:
                rows[row, modal + place] = -scale[place]
    held = np.array([node_matrix(s.stiffness)[0, 0] for s in spindle.supports])
    springs = np.concatenate([axial_stiffness, np.tile(held, (len(axial_stiffness), 1))], axis=1)
    stiffness = np.einsum("sc,ci,cj->sij", springs, rows, rows, optimize=True)
    dampers = [seat.axial_damping for seat in spindle.seats]
    dampers += [node_matrix(s.damping)[0, 0] for s in spindle.supports]
    damping = np.einsum("c,ci,cj->ij", np.array(dampers), rows, rows, optimize=True)
    own = np.arange(modal)
    stiffness[:, own, own] += values
    damping[own, own] += 2.0 * damping_ratios(values, spindle.rotor_damping[-1:]) * np.sqrt(values)
    closed = stops[:, [spindle.sleeves.index(s) for s in sliding]]
    springs = np.array([s.spring.stiffness for s in sliding]) + CLOSED * closed * carried
    there = modal + np.arange(len(sliding))
    stiffness[:, there, there] += springs * scale**2
    wide = np.concatenate([basis, np.zeros((len(basis), len(sliding)))], axis=1)
    return RodSystem("x", wide, stiffness, np.broadcast_to(damping, stiffness.shape))


def torsion_system(
    spindle: Spindle,
    mesh: Mesh,
    max_frequency: float,
    ports: tuple[int, ...],
    speeds: int,
    *,
    rigid: bool,
) -> RodSystem:
    """Torsion of the shaft, free but for linear supports; the same at all ``speeds``."""
    nodes = [mesh.node_of(support.x) for support in spindle.supports]
    basis, values = _rod_basis(torsion_rod(spindle, mesh), max_frequency, (*nodes, *ports), rigid)
    spin = position("thx")
    rows = basis[nodes]
    matrices = []
    for which, diagonal in (
        ("stiffness", values),
        ("damping", 2.0 * damping_ratios(values, spindle.rotor_damping[-1:]) * np.sqrt(values)),
    ):
        entries = [node_matrix(getattr(s, which))[spin, spin] for s in spindle.supports]
        held = np.einsum("c,ci,cj->ij", np.array(entries), rows, rows)
        matrices.append(np.broadcast_to(np.diag(diagonal) + held, (speeds, *held.shape)))
    return RodSystem("thx", basis, matrices[0], matrices[1])


def _rod_basis(
    rod: RodMatrices, max_frequency: float, stations: tuple[int, ...], rigid: bool
) -> tuple[Array, Array]:
    """Reduced coordinates of a free rod: basis (nodes, m) and stiffness (m,)."""
    if rigid:
        one = np.ones((len(rod.mass), 1))
        return one / math.sqrt(rod.mass.sum()), np.zeros(1)
    loads = np.eye(len(rod.mass))[:, sorted(set(stations))]
    return ritz_basis(rod.mass, rod.stiffness, 2.0 * math.pi * CUTOFF * max_frequency, loads, 1)


def _carried(spindle: Spindle, sliding: list[Sleeve], axial_stiffness: Array) -> Array:
    """Stiffness of the bearings on each sliding sleeve (speeds, sleeves) [N/m]."""
    columns = [
        sum(
            (
                axial_stiffness[:, k]
                for k, seat in enumerate(spindle.seats)
                if seat.name in s.bearings
            ),
            np.zeros(len(axial_stiffness)),
        )
        for s in sliding
    ]
    return np.stack(columns, axis=1) if columns else np.zeros((len(axial_stiffness), 0))
