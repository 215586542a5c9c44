"""Bending of the rotor alone, reduced to a few vectors a plane."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.bubbles import points
from rotordyn.machine.damping import RayleighDamping
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import Sleeve
from rotordyn.numerics.reduction import Coupling, RitzBasis
from rotordyn.numerics.sparse import Matrix, filled, scaled_rows
from rotordyn.system.assemble import bending_plane, loaded_plane
from rotordyn.system.connections import connections, moved
from rotordyn.system.dofs import PLANE_Y
from rotordyn.system.flexibility import bending_answer, free_vectors
from rotordyn.system.geometric_stiffness import GeometricStiffness
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
from rotordyn.system.left_damping import LeftDamping, are_answers, modal_damping
from rotordyn.system.mesh import Mesh
from rotordyn.system.remainder import Remainder, remainder
from rotordyn.system.stiffening import Stiffening, stiffening
from rotordyn.system.unreduced import MaterialDamping, Unreduced

Array = NDArray[np.float64]
USUAL = 1e-4  # relative error of a frequency that a designer does not notice
TINY = 1e-300
GAUSS = 7  # degree up to which the work of the axial force is integrated exactly
SHARE = 0.03  # of the accuracy, that a gyroscopic force may cost
STANDARD_CUTOFF = 4.0  # likewise with standard elements, whose own error is to stand alone
CUTOFF = 2.5  # free-free modes kept, over the highest frequency asked, at the usual accuracy
SLEEVE_CUTOFF = 30.0  # own frequency given to a sprung sleeve without mass, likewise


@dataclass(frozen=True, slots=True)
class Fineness:
    """How good a model must be: relative ``accuracy`` of every frequency up to ``frequency`` [Hz].

    ``spin`` [rad/s]: highest speed. ``accuracy`` None: standard elements between the nodes of the
    mesh, whatever they give.
    """

    frequency: float
    spin: float = 0.0
    accuracy: float | None = None

    @property
    def cutoff(self) -> float:
        """Up to which free-free modes are kept [rad/s]: what others leave out falls with its 4th
        power."""
        factor = STANDARD_CUTOFF if self.accuracy is None else CUTOFF * self._finer**0.25
        return factor * self.band

    @property
    def band(self) -> float:
        """[rad/s]"""
        return 2.0 * math.pi * self.frequency

    @property
    def gyroscopic(self) -> float:
        """Energy f K⁻¹ f from which answers to gyroscopic forces f are kept: without them, Ω s f of
        a mode of unit mass moves its pole s by Ω² f K⁻¹ f / 2 of itself."""
        allowed = 0.0 if self.accuracy is None else 2.0 * SHARE * USUAL / self._finer
        return allowed / self.spin**2 if self.spin**2 > TINY * allowed else math.inf

    @property
    def beyond(self) -> float:
        """A frequency so far above the band [Hz] that what swings there acts as if it had no mass:
        its error falls with the square."""
        return self._finer**0.5 * self.frequency

    @property
    def _finer(self) -> float:
        """How many times as accurate as usual."""
        return 1.0 if self.accuracy is None else max(1.0, USUAL / self.accuracy)


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
    and moments at bearings, supports, contacts of the drawbar and the nodes ``ports``, and to what
    gyroscopic effect and drawbar make of the lowest modes; a ``rigid`` rotor keeps the two motions
    of a rigid body.
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
    masses = np.array([sleeve_mass(s, s.radial_stiffness, fineness.beyond) for s in sprung])
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
    damping, joints = _own_damping(spindle, basis), jump_damping(elements, vectors)
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
            left_out,
            strung=strung,
            damped=_left_damping(spindle, elements, basis, left_out),
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
    xi, weight = points(GAUSS)
    half = mesh.length[:, None] / 2.0
    places = mesh.middle[:, None] + half * xi
    return scaled_rows(slopes(spindle, elements, places.ravel()), np.sqrt(weight * half).ravel())


def bending_elements(spindle: Spindle, mesh: Mesh, fineness: Fineness) -> Hierarchy:
    """Standard elements between all nodes, or those that the accuracy asks for."""
    if fineness.accuracy is None:
        return beams(spindle, mesh, np.ones(mesh.nodes - 1, dtype=np.intp))
    omega = 2.0 * math.pi * fineness.frequency
    return bending_hierarchy(spindle, omega, fineness.spin, fineness.accuracy)


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
    damping = np.diag(own_damping(still, spindle))
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


def _left_damping(
    spindle: Spindle, elements: Hierarchy, basis: RitzBasis, left_out: Remainder
) -> LeftDamping | None:
    """The rotor's own damping on what is left out; of modes not kept the last modal ratio."""
    if not (spindle.damped or elements.dampers):
        return None
    own, finer = spindle.rayleigh, len(left_out.own_mass) - len(basis.rest_values)
    every = np.pad(_modal_damping(spindle, basis)[1], (finer, 0))
    proportional = own.mass * left_out.mass + own.stiffness * left_out.stiffness
    proportional += every[:, None] * left_out.mass
    joints = np.zeros_like(proportional)
    for row, damping in elements.dampers.items():
        joints[finer:] += damping * np.outer(basis.rest[row], basis.vectors[row])
    return LeftDamping(
        proportional + joints,
        every + own.mass * left_out.own_mass + own.stiffness * left_out.own_stiffness,
        spindle.internal_damping * proportional + joints,
    )


def _own_damping(spindle: Spindle, basis: RitzBasis) -> Array:
    """Of the coordinates (m, m), dampers of joints apart."""
    modal = own_damping(basis.values, replace(spindle, rayleigh=RayleighDamping()))
    modal[~are_answers(basis.rest_mass)], rest = _modal_damping(spindle, basis)
    rayleigh = spindle.rayleigh.mass + spindle.rayleigh.stiffness * basis.values
    return modal_damping(basis.rest_mass, rest, modal) + np.diag(rayleigh)


def _modal_damping(spindle: Spindle, basis: RitzBasis) -> tuple[Array, Array]:
    """Of the modes kept and of the others, in their order."""
    kept = basis.values[~are_answers(basis.rest_mass)]
    every = np.concatenate([kept, np.maximum(basis.rest_values, 0.0)])
    modal = 2.0 * damping_ratios(every, spindle.rotor_damping) * np.sqrt(every)
    return modal[: len(kept)], modal[len(kept) :]


def own_damping(values: Array, spindle: Spindle, *, bending: bool = True) -> Array:
    """Damping of the rotor's coordinates of unit mass and stiffness ``values``: modal, Rayleigh.

    Other motions than ``bending`` take the last modal ratio.
    """
    given, rayleigh = spindle.rotor_damping, spindle.rayleigh
    modal = 2.0 * damping_ratios(values, given if bending else given[-1:]) * np.sqrt(values)
    return modal + rayleigh.mass + rayleigh.stiffness * values


def damping_ratios(values: Array, given: tuple[float, ...]) -> Array:
    """Modal damping: none for rigid motion, then ``given`` in order, the last repeated."""
    ratios = np.zeros(len(values))
    if given:
        order = np.arange(len(values)) - int((values == 0.0).sum())
        flexible = np.array(given)[np.clip(order, 0, len(given) - 1)]
        ratios = np.where(order < 0, 0.0, flexible)
    return ratios


def _loaded(spindle: Spindle, mesh: Mesh, ports: tuple[int, ...]) -> list[int]:
    """Rows of deflections and tilts where something acts on the rotor."""
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


def sleeve_mass(sleeve: Sleeve, held: float, max_frequency: float) -> float:
    """Its mass, or what lifts its own frequency far above the band where none is given [kg].

    ``held``: the stiffness that holds it [N/m].
    """
    if sleeve.mass > 0.0:
        return sleeve.mass
    return held / (2.0 * math.pi * SLEEVE_CUTOFF * max_frequency) ** 2
