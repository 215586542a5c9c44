"""Axial motion of rotors and sleeves, and torsion of the rotors, at many speeds.

Each is a system of its own unless a support couples it to another motion (``coupled``). Along the
axis a bearing on a sleeve is in series with the sleeve's spring (a stop that is closed grounds the
sleeve); nothing but linear supports holds the spin.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.node import FREEDOMS, position
from rotordyn.elements.support import along_and_about
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import Sleeve
from rotordyn.numerics.sparse import filled
from rotordyn.system.assemble import loaded_rod
from rotordyn.system.connections import connections, moved, supported
from rotordyn.system.dofs import AXIAL, TORSION, Selection
from rotordyn.system.fineness import Fineness, sleeve_mass
from rotordyn.system.flexibility import free_vectors, rod_answer
from rotordyn.system.hierarchic_rotor import (
    axial_properties,
    jump_damping,
    rod_displacements,
    rod_hierarchy,
    rods,
    torsion_properties,
)
from rotordyn.system.hierarchy import Hierarchy
from rotordyn.system.hysteresis import Hysteresis, Signs, answering
from rotordyn.system.jumps import jumps
from rotordyn.system.mesh import Mesh
from rotordyn.system.remainder import Remainder, remainder
from rotordyn.system.rotor_damping import damping_beside, diagonal_damping, own_damping
from rotordyn.system.unreduced import MaterialDamping, Unreduced

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
CLOSED = 1e3  # stiffness of a closed stop over that of the bearings on its sleeve


@dataclass(frozen=True, eq=False, slots=True)
class RodSystem:
    """q̈ + ``damping`` q̇ + ``stiffness`` q = f, arrays (speeds, n, n).

    ``basis`` (nodes, n): the nodes' ``freedom``, x or thx. ``rows`` (c, 1, n): motion between the
    ends of each bearing or support, which join the nodes ``connected`` (c, nodes); ``held``,
    ``damped`` (speeds, c, 1, 1): what they answer. ``weightless`` (n,): 1 for sleeves without mass,
    else 0; ``rigid`` (n,): coordinates that are rigid motions of a rotor.
    ``remainder``: what the coordinates leave out; ``unreduced``: the assembled rod they were taken
    from; None where the shaft is rigid. ``hysteresis``: what loss factors add to the stiffness;
    None where there are none.
    """

    freedom: str
    basis: Array
    stiffness: Array
    damping: Array
    rows: Array
    connected: Array
    held: Array
    damped: Array
    weightless: Array
    rigid: Flags
    remainder: Remainder | None
    unreduced: Unreduced | None
    hysteresis: Hysteresis | None = None

    def answering(self, signs: Signs) -> RodSystem:
        """The linear system that answers motions of these signs: loss is in its stiffness."""
        return answering(self, signs)

    @property
    def planes(self) -> int:
        """The motion is one along a line, or about it."""
        return 1

    @property
    def freedoms(self) -> int:
        """Of a node."""
        return 1

    @property
    def force(self) -> None:
        """Axial force does nothing to a motion along or about the axis."""
        return

    @property
    def frame(self) -> Array:
        """Speed of the coordinates: none (speeds,)."""
        return np.zeros(len(self.stiffness))

    @property
    def motion(self) -> Array:
        """Displacements of the nodes by the coordinates (nodes, 6, n)."""
        motion = np.zeros((len(self.basis), len(FREEDOMS), self.basis.shape[1]))
        motion[:, position(self.freedom)] = self.basis
        return motion


def axial_system(
    spindle: Spindle,
    mesh: Mesh,
    fineness: Fineness,
    ports: tuple[int, ...],
    axial_stiffness: Array,
    stops: Flags,
    *,
    rigid: bool,
) -> RodSystem:
    """Axial motion; ``axial_stiffness`` (speeds, seats), closed ``stops`` (speeds, sleeves)."""
    ends = connections(spindle, mesh)
    free = _reduced(_AXIAL, spindle, mesh, fineness, ports, rigid=rigid)
    basis, values = free.at_nodes, free.values
    sliding = [s for s in spindle.sleeves if math.isfinite(s.spring.stiffness)]
    carried = _carried(spindle, sliding, axial_stiffness)
    most = [s.spring.stiffness + float(carried[:, k].max()) for k, s in enumerate(sliding)]
    masses = [sleeve_mass(s, held, fineness) for s, held in zip(sliding, most, strict=True)]
    scale = np.array([mass**-0.5 for mass in masses])
    modal, size = basis.shape[1], basis.shape[1] + len(sliding)
    rows = np.zeros((len(ends), size))
    rows[:, :modal] = moved(ends, basis)
    for row, seat in enumerate(spindle.seats):
        for place, sleeve in enumerate(sliding):
            if seat.name in sleeve.bearings:
                rows[row, modal + place] = -scale[place]
    held = np.array([along_and_about(s, "stiffness")[0, 0] for s in spindle.supports])
    tiled = np.tile(held, (len(axial_stiffness), 1))
    springs_held = np.concatenate([axial_stiffness, tiled], axis=1)
    stiffness = np.einsum("sc,ci,cj->sij", springs_held, rows, rows, optimize=True)
    dampers = [seat.axial_damping for seat in spindle.seats]
    dampers += [along_and_about(s, "damping")[0, 0] for s in spindle.supports]
    damping = np.einsum("c,ci,cj->ij", np.array(dampers), rows, rows, optimize=True)
    own = np.arange(modal)
    damping[:modal, :modal] += free.damping
    stiffness[:, own, own] += values
    closed = stops[:, [spindle.sleeves.index(s) for s in sliding]]
    springs = np.array([s.spring.stiffness for s in sliding]) + CLOSED * closed * carried
    there = modal + np.arange(len(sliding))
    stiffness[:, there, there] += springs * scale**2
    wide = np.concatenate([basis, np.zeros((len(basis), len(sliding)))], axis=1)
    left_out = free.remainder.widened(len(sliding)) if free.remainder else None
    return RodSystem(
        "x",
        wide,
        stiffness,
        np.broadcast_to(damping, stiffness.shape),
        rows[:, None],
        ends,
        springs_held[..., None, None],
        np.broadcast_to(np.array(dampers)[:, None, None], (*springs_held.shape, 1, 1)),
        np.concatenate([np.zeros(modal), [float(s.mass == 0.0) for s in sliding]]),
        np.concatenate([values == 0.0, np.zeros(len(sliding), dtype=bool)]),
        left_out,
        replace(free.unreduced, more=len(sliding)) if free.unreduced else None,
        _hysteresis(spindle, rows, springs_held, values, spindle.connection_losses),
    )


def torsion_system(
    spindle: Spindle,
    mesh: Mesh,
    fineness: Fineness,
    ports: tuple[int, ...],
    speeds: int,
    *,
    rigid: bool,
) -> RodSystem:
    """Torsion of all rotors, free but for linear supports; the same at all ``speeds``."""
    ends = supported(spindle.supports, mesh)
    free = _reduced(_TORSION, spindle, mesh, fineness, ports, rigid=rigid)
    basis, values = free.at_nodes, free.values
    spin = position("thx")
    rows = moved(ends, basis)
    matrices, blocks = [], []
    for which, alone in (("stiffness", np.diag(values)), ("damping", free.damping)):
        entries = [along_and_about(s, which)[spin, spin] for s in spindle.supports]
        held = np.einsum("c,ci,cj->ij", np.array(entries), rows, rows)
        one = np.array(entries).reshape(1, -1, 1, 1)
        blocks.append(np.broadcast_to(one, (speeds, *one.shape[1:])))
        matrices.append(np.broadcast_to(alone + held, (speeds, *held.shape)))
    return RodSystem(
        "thx",
        basis,
        matrices[0],
        matrices[1],
        rows[:, None],
        ends,
        blocks[0],
        blocks[1],
        np.zeros(basis.shape[1]),
        values == 0.0,
        free.remainder,
        free.unreduced,
        _hysteresis(
            spindle,
            rows,
            blocks[0][..., 0, 0],
            values,
            spindle.connection_losses[len(spindle.seats) :],
        ),
    )


def _hysteresis(
    spindle: Spindle, rows: Array, held: Array, values: Array, factors: Sequence[float]
) -> Hysteresis | None:
    """By the loss factors of shaft and supports: nothing here turns out of its own direction.

    ``rows`` (c, n); ``held`` (speeds, c): stiffness, with ``factors`` (c,); ``values``: of the
    shaft's own coordinates, the first ones.
    """
    if not spindle.hysteretic:
        return None
    own = np.zeros(rows.shape[1])
    own[: len(values)] = spindle.loss_factor * values
    connections = np.array(factors, dtype=float)
    fixed = np.diag(own) + np.einsum("sc,ci,cj->sij", held * connections, rows, rows)
    return Hysteresis(fixed, np.zeros_like(fixed[0]), None, connections)


@dataclass(frozen=True, slots=True)
class _Rod:
    """One of the two motions along the shaft: what its elements are made of, what it carries, the
    way in which joints give."""

    properties: Callable[[Mesh], tuple[Array, Array]]
    selection: Selection
    way: str


_AXIAL = _Rod(axial_properties, AXIAL, "axial")
_TORSION = _Rod(torsion_properties, TORSION, "torsion")


@dataclass(frozen=True, eq=False, slots=True)
class _Reduced:
    """Reduced coordinates of free rods: seen at the nodes (nodes, m), stiffness (m,) and own
    damping (m, m), that of joints included."""

    at_nodes: Array
    values: Array
    damping: Array
    remainder: Remainder | None
    unreduced: Unreduced | None

    def beside(self, others: Sequence[_Reduced]) -> _Reduced:
        """With the rods of other rotors."""
        if not others:
            return self
        from scipy.linalg import block_diag

        every = (self, *others)
        left_out = [one.remainder for one in others if one.remainder]
        wholes = [one.unreduced for one in others if one.unreduced]
        return _Reduced(
            at_nodes=block_diag(*(one.at_nodes for one in every)),
            values=np.concatenate([one.values for one in every]),
            damping=block_diag(*(one.damping for one in every)),
            remainder=self.remainder and self.remainder.beside(left_out),
            unreduced=self.unreduced and self.unreduced.beside(wholes),
        )


def _reduced(
    rod: _Rod,
    spindle: Spindle,
    mesh: Mesh,
    fineness: Fineness,
    ports: tuple[int, ...],
    *,
    rigid: bool,
) -> _Reduced:
    """All rotors, each reduced by itself."""
    found = []
    for name in spindle.ratios:
        part, own = spindle.part(name), mesh.of_rotors[name]
        seats = part.seats if rod is _AXIAL else ()
        nodes = own.nodes_of(seats, part.supports)
        stations = (*nodes, *mesh.within(name, ports))
        found.append(_alone(rod, part, own, fineness, stations, rigid=rigid))
    return found[0].beside(found[1:])


def _alone(
    rod: _Rod,
    spindle: Spindle,
    mesh: Mesh,
    fineness: Fineness,
    stations: tuple[int, ...],
    *,
    rigid: bool,
) -> _Reduced:
    elements = _elements(rod, spindle, mesh, fineness)
    whole = loaded_rod(spindle, elements, rod.selection)
    if rigid:
        count = elements.mesh.nodes
        one = np.ones((mesh.nodes, 1)) / math.sqrt(whole.mass[:count, :count].sum())
        still = np.zeros(1)
        own = np.diag(diagonal_damping(still, spindle, bending=False))
        return _Reduced(one, still, own, None, None)
    seen = rod_displacements(elements, mesh.x)
    acting = filled(seen[sorted(set(stations))].T)
    loads = np.concatenate([acting, elements.damper_loads], axis=1)
    together = (np.arange(elements.size) < elements.mesh.nodes).astype(float)[:, None]
    rigidity, _ = rod.properties(elements.mesh)
    basis = free_vectors(
        elements,
        whole,
        lambda: rod_answer(rigidity, elements, whole.stiffness),
        fineness.cutoff,
        loads,
        together,
    )
    left_out = remainder(elements, basis, {"mass": whole.mass}, seen)
    beside = damping_beside(spindle, elements, basis, left_out, bending=False)
    left_out = replace(left_out, damped=beside and beside.at_ratio(0.0))
    own = own_damping(spindle, basis, bending=False) + jump_damping(elements, basis.vectors)
    material = MaterialDamping.of(spindle)
    unreduced = Unreduced(basis, seen, dampers=elements.dampers, material=material).at_ratio(0.0)
    return _Reduced(seen @ basis.vectors, basis.values, own, left_out, unreduced)


def _elements(rod: _Rod, spindle: Spindle, mesh: Mesh, fineness: Fineness) -> Hierarchy:
    """Linear rods between all nodes, or those that the accuracy asks for."""
    if fineness.accuracy is None:
        degree = np.ones(mesh.nodes - 1, dtype=np.intp)
        return rods(mesh, degree, rod.properties, jumps(spindle, (rod.way,)))
    return rod_hierarchy(spindle, fineness.band, fineness.accuracy, rod.properties, rod.way)


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
