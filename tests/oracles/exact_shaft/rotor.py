"""A spindle as exact pieces of shaft with what sits between them, at one speed."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.equation.elements.shear import shear_coefficient
from rotordyn.equation.mesh import Mesh, station_mesh
from rotordyn.errors import InvalidInput
from rotordyn.machine.cross_section import area, second_moment
from rotordyn.machine.spindle import Spindle
from tests.oracles.exact_shaft.nodes import NodeTerms, node_terms
from tests.oracles.exact_shaft.segment import Segments

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class ExactRotor:
    """Pieces between ``nodes`` at ``x`` [m], turning at ``spin`` [rad/s].

    ``planes``: 1 where every support answers alike in all directions; forward and backward whirl
    are then apart, and negative ω is backward. 2 where they are coupled. Displacements of a node
    are deflection and tilt of each circular part, then what is the same at all nodes: the
    deflection of each sprung sleeve and the stretch of each straight part of the drawbar.
    """

    x: Array
    segments: Segments
    terms: NodeTerms
    spin: float
    planes: int

    @property
    def width(self) -> int:
        """Displacements of a node, what is carried along included."""
        return self.terms.stiffness.shape[-1]

    def node_of(self, x: float) -> int:
        """The node at station ``x`` [m]."""
        return int(np.abs(self.x - x).argmin())

    def up_to(self, omega: float) -> ExactRotor:
        """The same with pieces short enough for whirl up to ``omega`` [rad/s]."""
        parts = self.segments.parts(abs(omega), self.spin)
        first = np.concatenate([[0], np.cumsum(parts)])
        segments = self.segments.divided(parts)
        x = self.x[0] + np.concatenate([[0.0], np.cumsum(segments.length)])
        x[first] = self.x
        return replace(self, x=x, segments=segments, terms=self.terms.spread(first))


def exact_rotor(
    spindle: Spindle,
    spin: float,
    seat_stiffness: Array,
    mesh: Mesh | None = None,
    axial_force: Array | None = None,
) -> ExactRotor:
    """The rotor of ``spindle`` at ``spin`` [rad/s] on its bearings and supports.

    ``seat_stiffness`` (seats, 5, 5): tangents of the bearings in their own frames; ``mesh``: at
    least a node at every station; ``axial_force`` (elements of ``mesh``,) [N]: in the shaft,
    tension positive; None = it and the drawbar do nothing to bending.

    Raises
    ------
    InvalidInput : damping of the rotor itself, which has no place in the exact shaft, or a
        compression that the shear stiffness does not withstand
    """
    if spindle.damped:
        raise InvalidInput("the exact shaft has no modes to damp one by one")
    if spindle.loss_factor or any(support.loss_factor for support in spindle.supports):
        raise InvalidInput("the exact shaft is counted and solved without loss factors")
    mesh = mesh or station_mesh(spindle)
    terms, planes = node_terms(spindle, mesh, seat_stiffness, pulled=axial_force is not None)
    tension = np.zeros(mesh.nodes - 1) if axial_force is None else axial_force
    return ExactRotor(mesh.x, _segments(spindle, mesh, tension), terms, spin, planes)


def _segments(spindle: Spindle, mesh: Mesh, tension: Array) -> Segments:
    if (mesh.steepness > 1.0).any():
        raise InvalidInput("the exact shaft is made of cylinders")
    ratio = mesh.inner[0] / mesh.outer[0]
    ring = area(mesh.outer[0], mesh.inner[0])
    moment = second_moment(mesh.outer[0], mesh.inner[0])
    kappa = shear_coefficient(spindle.shaft.shear_coefficient, mesh.poisson_ratio, ratio)
    shear = kappa * mesh.shear_modulus * ring
    if (shear + tension <= 0.0).any():
        raise InvalidInput("the axial force overcomes the shear stiffness of the shaft: lower it")
    return Segments(
        length=mesh.length,
        shear=shear,
        bending=mesh.young_modulus * moment,
        line_mass=mesh.density * ring,
        rotary=mesh.density * moment,
        tension=tension,
    )
