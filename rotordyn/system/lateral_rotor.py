"""Bending of the rotor alone, reduced to a few vectors a plane."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.machine.spindle import Spindle
from rotordyn.numerics.sparse import Matrix, filled, scaled_rows
from rotordyn.numerics.static_answers import Coupling
from rotordyn.system.assemble import bending_plane, loaded_plane
from rotordyn.system.connections import connections, moved
from rotordyn.system.dofs import PLANE_Y
from rotordyn.system.fineness import USUAL, Fineness, sleeve_mass
from rotordyn.system.flexibility import bending_answer, free_vectors
from rotordyn.system.geometric_stiffness import GeometricStiffness, gauss_points
from rotordyn.system.hierarchic_rotor import (
    beams,
    bending_hierarchy,
    deflections,
    jump_damping,
    resolved_whirl,
    rigid_motions,
    slopes,
)
from rotordyn.system.hierarchy import Hierarchy
from rotordyn.system.mesh import Mesh
from rotordyn.system.remainder import Remainder, remainder
from rotordyn.system.rotor_damping import damping_beside, diagonal_damping, own_damping
from rotordyn.system.stiffening import Stiffening, stiffening
from rotordyn.system.unreduced import MaterialDamping, Unreduced

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class LateralRotor:
    """The bending plane of the rotor, or of all rotors, in m coordinates of unit mass.

    ``basis`` (2·nodes, m); ``stiffness`` (m,); ``polar`` (m, m): per unit of the spindle's speed,
    a further rotor's times its speed ratio; ``translational_mass`` (m, m); ``damping`` (m, m): the
    rotors' own, by joints included. ``per_newton`` (m, m): stiffness by the axial force in each
    element of the shaft; ``bar`` (m, m): that of the drawbar. ``seats`` (seats, 2, m): deflection
    and tilt between the rings of each bearing; ``supports`` (supports, 2, m): those between the
    ends of each linear support, and ``connected`` the nodes of both (``connections``). The last
    coordinates are the sprung sleeves, if any; ``weightless`` (m,) is 1 for those that have no
    mass of their own, else 0. ``rigid`` (m,): coordinates that are rigid motions of a rotor.
    ``remainder``: what the coordinates leave out; None for a rigid rotor. ``unreduced``: the
    assembled rotor they were taken from, likewise. ``resolved`` [Hz]: highest frequency that the
    elements carry within the accuracy asked for, or within ``USUAL`` where none is. ``turning``
    (m, m): damping that turns with its rotor, per unit of the spindle's speed. ``loss`` (m,): loss
    factor of the shaft times stiffness.
    """

    basis: Array
    stiffness: Array
    polar: Array
    translational_mass: Array
    damping: Array
    per_newton: GeometricStiffness
    bar: Array
    seats: Array
    supports: Array
    connected: Array
    weightless: Array
    rigid: NDArray[np.bool_]
    remainder: Remainder | None
    unreduced: Unreduced | None
    resolved: float
    turning: Array
    loss: Array

    @property
    def size(self) -> int:
        """Coordinates a plane."""
        return self.basis.shape[1]

    def row(self, node: int, freedom: str) -> Array:
        """Deflection "y" or tilt "thz" of a node in these coordinates (m,)."""
        return self.basis[PLANE_Y.row(node, freedom)]


@dataclass(frozen=True, eq=False, slots=True)
class _Reduced:
    """The free rotor: coordinates seen at the nodes of the mesh, and its matrices in them.

    The stiffness of the drawbar is apart, as is what turns with the rotor."""

    at_nodes: Array
    values: Array
    damping: Array
    polar: Array
    translational_mass: Array
    per_newton: GeometricStiffness
    remainder: Remainder | None
    unreduced: Unreduced | None
    resolved: float
    turning: Array

    def at_ratio(self, ratio: float) -> _Reduced:
        """The same rotor at ``ratio`` times the speed."""
        left_out, whole = self.remainder, self.unreduced
        if left_out is not None:
            damped = left_out.damped and left_out.damped.at_ratio(ratio)
            left_out = replace(left_out, polar=ratio * left_out.polar, damped=damped)
        if whole is not None:
            whole = whole.at_ratio(ratio)
        return replace(
            self,
            polar=ratio * self.polar,
            turning=ratio * self.turning,
            remainder=left_out,
            unreduced=whole,
        )

    def beside(self, others: Sequence[_Reduced]) -> _Reduced:
        """With other rotors, on which no axial force acts."""
        if not others:
            return self
        from scipy.linalg import block_diag

        every, more = (self, *others), sum(len(one.values) for one in others)
        names = ("at_nodes", "polar", "translational_mass", "damping", "turning")
        blocks = {name: block_diag(*(getattr(one, name) for one in every)) for name in names}
        left_out = [one.remainder for one in others if one.remainder]
        wholes = [one.unreduced for one in others if one.unreduced]
        return _Reduced(
            **blocks,
            values=np.concatenate([one.values for one in every]),
            per_newton=self.per_newton.padded(rows=more, columns=more),
            remainder=self.remainder and self.remainder.beside(left_out),
            unreduced=self.unreduced and self.unreduced.beside(wholes),
            resolved=min(one.resolved for one in every),
        )


def lateral_rotor(
    spindle: Spindle, mesh: Mesh, fineness: Fineness, ports: tuple[int, ...], *, rigid: bool
) -> LateralRotor:
    """Reduce the bending plane of all rotors, each by itself, seen at the nodes of ``mesh``.

    Kept are the free-free modes up to the cutoff of ``fineness`` and the static answers to forces
    at bearings, supports, contacts of the drawbar and the nodes ``ports``, to moments there (at
    supports only where these tilt), to what the drawbar makes of the lowest modes and, as far as
    ``fineness`` asks, the gyroscopic effect; a ``rigid`` rotor keeps the two motions of a rigid
    body.
    """
    tension = stiffening(spindle, mesh)
    reduced = [
        _alone(spindle, name, mesh, fineness, ports, rigid=rigid).at_ratio(ratio)
        for name, ratio in spindle.ratios.items()
    ]
    free = reduced[0].beside(reduced[1:])
    basis, values = free.at_nodes, free.values
    sprung = [s for s in spindle.sleeves if math.isfinite(s.radial_stiffness)]
    more = len(sprung)
    masses = np.array([sleeve_mass(s, s.radial_stiffness, fineness) for s in sprung])
    held = np.array([s.radial_stiffness for s in sprung]) / masses
    ends = connections(spindle, mesh)
    nodes = _widened(_by_node(basis), more)
    seats, supports = np.split(moved(ends, nodes), [len(spindle.seats)])
    for k, seat in enumerate(spindle.seats):
        for place, sleeve in enumerate(sprung):
            if seat.name in sleeve.bearings:
                seats[k, 0, basis.shape[1] + place] = -1.0 / math.sqrt(masses[place])
    return LateralRotor(
        basis=_widened(basis, more),
        stiffness=np.concatenate([values, held]),
        polar=_bordered(free.polar, more),
        translational_mass=_bordered(free.translational_mass, more),
        damping=_bordered(free.damping, more),
        per_newton=free.per_newton.padded(rows=more, columns=more),
        bar=tension.bar(nodes),
        seats=seats,
        supports=supports,
        connected=ends,
        weightless=np.concatenate(
            [np.zeros(basis.shape[1]), [float(s.mass == 0.0) for s in sprung]]
        ),
        rigid=np.concatenate([values == 0.0, np.zeros(more, dtype=bool)]),
        remainder=free.remainder.widened(more) if free.remainder else None,
        unreduced=replace(free.unreduced, more=more) if free.unreduced else None,
        resolved=free.resolved,
        turning=_bordered(free.turning, more),
        loss=np.concatenate([spindle.loss_factor * values, np.zeros(more)]),
    )


def _alone(
    spindle: Spindle,
    name: str,
    mesh: Mesh,
    fineness: Fineness,
    ports: tuple[int, ...],
    *,
    rigid: bool,
) -> _Reduced:
    """One of the rotors, turning at the speed that the others are told by."""
    part, own = spindle.part(name), mesh.of_rotors[name]
    tension = stiffening(part, own)
    if rigid:
        return _rigid(part, own, tension)
    spin = abs(spindle.ratios[name]) * fineness.spin
    return _flexible(part, own, replace(fineness, spin=spin), mesh.within(name, ports), tension)


def _flexible(
    spindle: Spindle, mesh: Mesh, fineness: Fineness, ports: tuple[int, ...], tension: Stiffening
) -> _Reduced:
    """Modes and static answers of an elastic rotor."""
    elements = bending_elements(spindle, mesh, fineness)
    plane = loaded_plane(spindle, elements)
    seen = deflections(spindle, elements, mesh.x)
    loads = filled(seen[_loaded(spindle, mesh, ports)].T)
    loads = np.concatenate([loads, elements.damper_loads], axis=1)
    bars = [Coupling(seen.T @ c @ seen) for c in _drawbar(spindle, mesh, tension)]
    couplings = [*bars, Coupling(plane.polar, fineness.gyroscopic, fineness.band)]
    slope = _weighted_slopes(spindle, elements, mesh)
    basis = free_vectors(
        elements,
        plane,
        lambda: bending_answer(spindle, elements, plane.stiffness),
        fineness.cutoff,
        loads,
        rigid_motions(elements),
        couplings,
        lambda: [plane.polar, slope.T @ slope],
    )
    vectors = basis.vectors
    sloped = slope @ vectors
    damping, joints = own_damping(spindle, basis), jump_damping(elements, vectors)
    left_out = remainder(
        elements,
        basis,
        {"mass": plane.mass, "polar": plane.polar},
        seen,
        GeometricStiffness(slope @ basis.rest, sloped),
    )
    at_nodes = seen @ vectors
    strung = tension.bar(_by_node(left_out.at_nodes.T), _by_node(at_nodes))
    return _Reduced(
        at_nodes=at_nodes,
        values=basis.values,
        damping=damping + joints,
        polar=vectors.T @ (plane.polar @ vectors),
        translational_mass=vectors.T @ (plane.translational_mass @ vectors),
        per_newton=GeometricStiffness(sloped, sloped),
        remainder=replace(
            left_out, strung=strung, damped=damping_beside(spindle, elements, basis, left_out)
        ),
        unreduced=Unreduced(
            basis,
            seen,
            plane.polar,
            slope,
            [
                (PLANE_Y.row(left, "y"), PLANE_Y.row(right, "y"), stiffness)
                for left, right, stiffness in tension.spans
            ],
            elements.dampers,
            material=MaterialDamping.of(spindle, spindle.internal_damping),
        ),
        resolved=resolved_whirl(spindle, elements, fineness.spin, fineness.accuracy or USUAL)
        / (2.0 * math.pi),
        turning=spindle.internal_damping * damping + joints,
    )


def _weighted_slopes(spindle: Spindle, elements: Hierarchy, mesh: Mesh) -> Matrix:
    """Slopes at the Gauss points of every element of the mesh, times the root of the length that
    each stands for (elements·points, size)."""
    x, weight = gauss_points(mesh)
    root = np.sqrt(weight * (mesh.length[:, None] / 2.0))
    return scaled_rows(slopes(spindle, elements, x.ravel()), root.ravel())


def bending_elements(spindle: Spindle, mesh: Mesh, fineness: Fineness) -> Hierarchy:
    """Standard elements between all nodes, or those that the accuracy asks for."""
    if fineness.accuracy is None:
        return beams(spindle, mesh, np.ones(mesh.nodes - 1, dtype=np.intp))
    return bending_hierarchy(spindle, fineness.band, fineness.spin, fineness.accuracy)


def _rigid(spindle: Spindle, mesh: Mesh, tension: Stiffening) -> _Reduced:
    """Translation and rotation of a rigid rotor, mass-normalised."""
    plane = bending_plane(spindle, mesh)
    shape = np.zeros((2 * mesh.nodes, 2))
    shape[0::2, 0], shape[0::2, 1], shape[1::2, 1] = 1.0, mesh.x, 1.0
    factor = np.linalg.cholesky(shape.T @ (plane.mass @ shape))
    basis = np.asarray(np.linalg.solve(factor, shape.T).T)
    polar, translation = (basis.T @ (m @ basis) for m in (plane.polar, plane.translational_mass))
    sloped = np.sqrt(mesh.length)[:, None] * basis[1]
    still = np.zeros(2)
    damping = np.diag(diagonal_damping(still, spindle))
    return _Reduced(
        at_nodes=basis,
        values=still,
        damping=damping,
        polar=polar,
        translational_mass=translation,
        per_newton=GeometricStiffness(sloped, sloped),
        remainder=None,
        unreduced=None,
        resolved=math.inf,
        turning=spindle.internal_damping * damping,
    )


def _drawbar(spindle: Spindle, mesh: Mesh, tension: Stiffening) -> list[Matrix]:
    """Stiffness by the drawbar alone (2·nodes, 2·nodes), where there is one that acts."""
    bar = spindle.drawbar
    if bar is None or not bar.contacts:
        return []
    inside = (bar.start < mesh.middle) & (mesh.middle < bar.end)
    return [tension.strung(mesh.nodes) - tension.shaft(bar.force * inside.astype(float))]


def _loaded(spindle: Spindle, mesh: Mesh, ports: tuple[int, ...]) -> list[int]:
    """Rows of deflections where something acts on the rotor, and of tilts where a moment does."""
    tilting = mesh.nodes_of(spindle.seats, (s for s in spindle.supports if s.tilts))
    tilting += [mesh.node_of(x) for x in (spindle.drawbar.stations if spindle.drawbar else ())]
    rows = {PLANE_Y.row(n, f) for n in (*tilting, *ports) for f in PLANE_Y.names}
    return sorted(rows | {PLANE_Y.row(n, "y") for n in mesh.nodes_of(spindle.supports)})


def _by_node(rows: Array) -> Array:
    """Deflections and tilts (2·nodes, k) as (nodes, 2, k)."""
    return rows.reshape(-1, 2, rows.shape[1])


def _widened(rows: Array, more: int) -> Array:
    """Room for more coordinates behind the last."""
    return np.concatenate([rows, np.zeros((*rows.shape[:-1], more))], axis=-1)


def _bordered(matrix: Array, more: int) -> Array:
    return np.pad(matrix, [(0, 0)] * (matrix.ndim - 2) + [(0, more), (0, more)])
