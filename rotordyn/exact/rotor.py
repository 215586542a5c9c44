"""A spindle as exact pieces of shaft with what sits between them, at one speed."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.lumped import lumped_element
from rotordyn.elements.shear import shear_coefficient
from rotordyn.elements.support import node_matrix, turn
from rotordyn.errors import InvalidInput
from rotordyn.exact.segment import Segments
from rotordyn.machine.cross_section import area, second_moment
from rotordyn.machine.spindle import Spindle
from rotordyn.system.dofs import Selection
from rotordyn.system.mesh import Mesh, build_mesh

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
PLANES = Selection(("y", "thz", "z", "thy"), (1, 1, 1, -1))
# From (y, θz, z, −θy) to the circular parts: forward y + i z, backward y − i z, each with its tilt.
_CIRCULAR = np.kron(np.array([[1.0, 1.0j], [1.0, -1.0j]]), np.eye(2))
_BACK = np.linalg.inv(_CIRCULAR)


@dataclass(frozen=True, eq=False, slots=True)
class NodeTerms:
    """What sits at the nodes: K + iω C − ω² M + ωΩ P, each (nodes, w, w), in circular parts."""

    stiffness: Complex
    damping: Complex
    mass: Complex
    polar: Complex

    def at(self, omega: complex, spin: float) -> Complex:
        """Dynamic stiffness at a whirl frequency [rad/s]."""
        turning = omega * spin * self.polar - omega**2 * self.mass
        return np.asarray(self.stiffness + 1j * omega * self.damping + turning)


@dataclass(frozen=True, eq=False, slots=True)
class ExactRotor:
    """Pieces between ``nodes`` at ``x`` [m], turning at ``spin`` [rad/s].

    ``planes``: 1 where every support answers alike in all directions; forward and backward whirl
    are then apart, and negative ω is backward. 2 where they are coupled.
    """

    x: Array
    segments: Segments
    terms: NodeTerms
    spin: float
    planes: int

    @property
    def width(self) -> int:
        """Displacements of a node: deflection and tilt of each circular part."""
        return 2 * self.planes

    def node_of(self, x: float) -> int:
        """The node at station ``x`` [m]."""
        return int(np.abs(self.x - x).argmin())

    def up_to(self, omega: float) -> ExactRotor:
        """The same with pieces short enough for whirl up to ``omega`` [rad/s]."""
        parts = self.segments.parts(abs(omega), self.spin)
        first = np.concatenate([[0], np.cumsum(parts)])
        nodes = int(first[-1]) + 1
        grown = {
            name: _spread(getattr(self.terms, name), first, nodes)
            for name in ("stiffness", "damping", "mass", "polar")
        }
        segments = self.segments.divided(parts)
        x = self.x[0] + np.concatenate([[0.0], np.cumsum(segments.length)])
        return replace(self, x=x, segments=segments, terms=NodeTerms(**grown))


def exact_rotor(
    spindle: Spindle, spin: float, seat_stiffness: Array, mesh: Mesh | None = None
) -> ExactRotor:
    """The rotor of ``spindle`` at ``spin`` [rad/s] on its bearings and supports.

    ``seat_stiffness`` (seats, 5, 5): tangents of the bearings in their own frames; ``mesh``: at
    least a node at every station.

    Raises
    ------
    InvalidInput : modal damping of the rotor, or a sleeve on a radial spring, which have no place
        in the exact shaft
    """
    if any(spindle.rotor_damping):
        raise InvalidInput(
            "the exact shaft has no modes to damp one by one: leave damping.rotor of the spindle "
            "empty (override: {damping.rotor: []})"
        )
    if any(math.isfinite(sleeve.radial_stiffness) for sleeve in spindle.sleeves):
        raise InvalidInput("the exact shaft takes sleeves as held rigidly across the axis")
    mesh = mesh or build_mesh(spindle, _whole(spindle))
    supports = _supports(spindle, mesh, seat_stiffness)
    planes = 1 if all(_alike(matrix) for _, _, matrix in supports) else 2
    terms = {name: np.zeros((mesh.nodes, 4, 4), dtype=complex) for name in _TERMS}
    for name, node, matrix in supports:
        terms[name][node] += _CIRCULAR @ matrix @ _BACK
    for body in spindle.lumped:
        own, node = lumped_element(body), mesh.node_of(body.x)
        terms["mass"][node] += PLANES.take(own.mass)
        polar = np.diag([0.0, body.polar_inertia, 0.0, -body.polar_inertia])
        terms["polar"][node] += polar
    kept = slice(None, 2 * planes)
    cut = {name: values[:, kept, kept] for name, values in terms.items()}
    return ExactRotor(mesh.x, _segments(spindle, mesh), NodeTerms(**cut), spin, planes)


_TERMS = ("stiffness", "damping", "mass", "polar")


def _whole(spindle: Spindle) -> float:
    """A length no piece exceeds, so that nodes are at stations only."""
    return 2.0 * (spindle.shaft.end - spindle.shaft.start)


def _segments(spindle: Spindle, mesh: Mesh) -> Segments:
    ratio = mesh.inner_diameter / mesh.outer_diameter
    ring = area(mesh.outer_diameter, mesh.inner_diameter)
    moment = second_moment(mesh.outer_diameter, mesh.inner_diameter)
    kappa = shear_coefficient(spindle.shaft.shear_coefficient, mesh.poisson_ratio, ratio)
    return Segments(
        length=mesh.length,
        shear=kappa * mesh.shear_modulus * ring,
        bending=mesh.young_modulus * moment,
        line_mass=mesh.density * ring,
        rotary=mesh.density * moment,
    )


def _supports(spindle: Spindle, mesh: Mesh, tangents: Array) -> list[tuple[str, int, Array]]:
    """Term, node and matrix (4, 4) over (y, θz, z, −θy) of everything that holds the rotor."""
    found: list[tuple[str, int, Array]] = []
    for seat, tangent in zip(spindle.seats, tangents, strict=True):
        node, across = mesh.node_of(seat.x), np.diag([1.0, 0.0, 1.0, 0.0])
        found.append(("stiffness", node, PLANES.take(turn(tangent, seat.thrust))))
        found.append(("damping", node, seat.radial_damping * across))
    for support in spindle.supports:
        node = mesh.node_of(support.x)
        found.append(("stiffness", node, PLANES.take(node_matrix(support.stiffness))))
        found.append(("damping", node, PLANES.take(node_matrix(support.damping))))
    return found


def _alike(matrix: Array) -> bool:
    """True where a support answers alike in all directions: [[P, Q], [−Q, P]]."""
    turned = np.block([[matrix[2:, 2:], -matrix[2:, :2]], [-matrix[:2, 2:], matrix[:2, :2]]])
    return bool(np.allclose(matrix, turned, rtol=1e-9, atol=0.0))


def _spread(values: Complex, first: NDArray[np.intp], nodes: int) -> Complex:
    grown = np.zeros((nodes, *values.shape[1:]), dtype=complex)
    grown[first] = values
    return grown
