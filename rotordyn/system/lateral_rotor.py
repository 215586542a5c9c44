"""Bending of the rotor alone, reduced to a few vectors a plane."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import Sleeve
from rotordyn.numerics.reduction import ritz_basis
from rotordyn.system.assemble import BendingPlane, bending_plane
from rotordyn.system.dofs import PLANE_Y
from rotordyn.system.mesh import Mesh
from rotordyn.system.stiffening import Stiffening, stiffening

Array = NDArray[np.float64]
CUTOFF = 4.0  # free-free modes are kept up to this multiple of the highest frequency asked
SLEEVE_CUTOFF = 30.0  # own frequency given to a sprung sleeve without mass, likewise


@dataclass(frozen=True, eq=False, slots=True)
class LateralRotor:
    """The rotor's bending plane in m coordinates of unit mass.

    ``basis`` (2·nodes, m); ``stiffness`` (m,); ``polar`` and ``translational_mass`` (m, m);
    ``damping_ratio`` (m,). ``per_newton`` (elements, m, m): stiffness per newton of axial force in
    each element; ``bar`` (m, m): that of the drawbar. ``seats`` (seats, 2, m): deflection and tilt
    between the rings of each bearing; ``supports`` (supports, 2, m): those of the node of each
    linear support. The last coordinates are the sprung sleeves, if any.
    """

    basis: Array
    stiffness: Array
    polar: Array
    translational_mass: Array
    damping_ratio: Array
    per_newton: Array
    bar: Array
    seats: Array
    supports: Array

    @property
    def size(self) -> int:
        """Coordinates a plane."""
        return self.basis.shape[1]

    def row(self, node: int, freedom: str) -> Array:
        """Deflection "y" or tilt "thz" of a node in these coordinates (m,)."""
        return self.basis[PLANE_Y.row(node, freedom)]


def lateral_rotor(
    spindle: Spindle, mesh: Mesh, max_frequency: float, ports: tuple[int, ...], *, rigid: bool
) -> LateralRotor:
    """Reduce the rotor's bending plane.

    Kept are the free-free modes up to ``CUTOFF`` times ``max_frequency`` [Hz] and the static
    answers to forces and moments at bearings, supports, contacts of the drawbar and the nodes
    ``ports``, and to what gyroscopic effect and drawbar make of the lowest modes; a ``rigid`` rotor
    keeps the two motions of a rigid body.
    """
    plane, tension = bending_plane(spindle, mesh), stiffening(spindle, mesh)
    if rigid:
        basis, values = _rigid_body(mesh, plane), np.zeros(2)
    else:
        loads = _loads(spindle, mesh, ports)
        cutoff = 2.0 * math.pi * CUTOFF * max_frequency
        couplings = [plane.polar, *_drawbar(spindle, mesh, tension)]
        basis, values = ritz_basis(plane.mass, plane.stiffness, cutoff, loads, 2, couplings)
    sprung = [s for s in spindle.sleeves if math.isfinite(s.radial_stiffness)]
    masses = np.array([sleeve_mass(s, s.radial_stiffness, max_frequency) for s in sprung])
    held = np.array([s.radial_stiffness for s in sprung]) / masses
    nodes = [mesh.node_of(seat.x) for seat in spindle.seats]
    seats = _widened(_rows(basis, nodes), len(sprung))
    for k, seat in enumerate(spindle.seats):
        for place, sleeve in enumerate(sprung):
            if seat.name in sleeve.bearings:
                seats[k, 0, basis.shape[1] + place] = -1.0 / math.sqrt(masses[place])
    at_supports = _rows(basis, [mesh.node_of(s.x) for s in spindle.supports])
    wide = _widened(_rows(basis, list(range(mesh.nodes))), len(sprung))
    return LateralRotor(
        basis=_widened(basis, len(sprung)),
        stiffness=np.concatenate([values, held]),
        polar=_bordered(basis.T @ plane.polar @ basis, len(sprung)),
        translational_mass=_bordered(basis.T @ plane.translational_mass @ basis, len(sprung)),
        damping_ratio=np.concatenate(
            [damping_ratios(values, spindle.rotor_damping), np.zeros(len(sprung))]
        ),
        per_newton=tension.projected(wide),
        bar=tension.bar(wide),
        seats=seats,
        supports=_widened(at_supports, len(sprung)),
    )


def _drawbar(spindle: Spindle, mesh: Mesh, tension: Stiffening) -> list[Array]:
    """Stiffness by the drawbar alone (2·nodes, 2·nodes), where there is one that acts."""
    bar = spindle.drawbar
    if bar is None or not bar.contacts:
        return []
    inside = (bar.start < mesh.middle) & (mesh.middle < bar.end)
    every = np.eye(2 * mesh.nodes).reshape(mesh.nodes, 2, -1)
    return [tension.bar(every) - tension.shaft(bar.force * inside.astype(float))]


def damping_ratios(values: Array, given: tuple[float, ...]) -> Array:
    """Modal damping: none for rigid motion, then ``given`` in order, the last repeated."""
    ratios = np.zeros(len(values))
    if given:
        order = np.arange(len(values)) - int((values == 0.0).sum())
        flexible = np.array(given)[np.clip(order, 0, len(given) - 1)]
        ratios = np.where(order < 0, 0.0, flexible)
    return ratios


def _rigid_body(mesh: Mesh, plane: BendingPlane) -> Array:
    """Translation and rotation of a rigid rotor, mass-normalised."""
    shape = np.zeros((2 * mesh.nodes, 2))
    shape[0::2, 0], shape[0::2, 1], shape[1::2, 1] = 1.0, mesh.x, 1.0
    factor = np.linalg.cholesky(shape.T @ plane.mass @ shape)
    return np.asarray(np.linalg.solve(factor, shape.T).T)


def _loads(spindle: Spindle, mesh: Mesh, ports: tuple[int, ...]) -> Array:
    """Unit forces and moments where something acts on the rotor (2·nodes, l)."""
    stations = mesh.nodes_of(spindle.seats, spindle.supports)
    stations += [mesh.node_of(x) for x in (spindle.drawbar.stations if spindle.drawbar else ())]
    rows = sorted({PLANE_Y.row(n, f) for n in (*stations, *ports) for f in PLANE_Y.names})
    return np.eye(2 * mesh.nodes)[:, rows]


def _rows(basis: Array, nodes: list[int]) -> Array:
    """(deflection, tilt) rows of nodes, (nodes, 2, m)."""
    return basis.reshape(-1, 2, basis.shape[1])[nodes]


def _widened(rows: Array, more: int) -> Array:
    """Room for more coordinates behind the last."""
    return np.concatenate([rows, np.zeros((*rows.shape[:-1], more))], axis=-1)


def _bordered(matrix: Array, more: int) -> Array:
    return np.pad(matrix, ((0, more), (0, more)))


def sleeve_mass(sleeve: Sleeve, held: float, max_frequency: float) -> float:
    """Its mass, or what lifts its own frequency far above the band where none is given [kg].

    ``held``: the stiffness that holds it [N/m].
    """
    if sleeve.mass > 0.0:
        return sleeve.mass
    return held / (2.0 * math.pi * SLEEVE_CUTOFF * max_frequency) ** 2
