"""Two-node shaft element with six DOF per node: bending in two planes, axial rod, torsion.

Local order: x, y, z, thx, thy, thz of the left node, then of the right one. A right-handed spin Ω
about +x gives M_y the term +Ip Ω θz′ and M_z the term −Ip Ω θy′, so that with r = y + i z and
φ = θz − i θy forward whirl has a positive frequency which rises with Ω.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.equation.dofs import DIRECTIONS, position
from rotordyn.machine.cross_section import area, second_moment
from tests.oracles.standard_beam import PlaneBending, plane_bending

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class ShaftElement:
    """Matrices of shape (…, 12, 12).

    ``gyroscopic`` is per unit of spin and skew; ``translational_mass`` is the share of ``mass``
    that belongs to transverse translation (what −Ω² M_ω takes); the others are symmetric.
    """

    mass: Array
    translational_mass: Array
    gyroscopic: Array
    stiffness: Array


def shaft_element(
    length: Array,
    outer_diameter: Array,
    inner_diameter: Array,
    young_modulus: Array,
    shear_modulus: Array,
    density: Array,
    shear_coefficient: Array,
) -> ShaftElement:
    """Hollow circular elements [m, Pa, kg/m³]; leading dimensions broadcast."""
    plane = plane_bending(
        length,
        outer_diameter,
        inner_diameter,
        young_modulus,
        shear_modulus,
        density,
        shear_coefficient,
    )
    ring = area(outer_diameter, inner_diameter)
    polar = 2.0 * second_moment(outer_diameter, inner_diameter)
    axial = _rod(length, young_modulus * ring, density * ring)
    torsion = _rod(length, shear_modulus * polar, density * polar)
    return _compose(plane, axial, torsion)


class Rod(NamedTuple):
    """Matrices (…, 2, 2) of a linear rod."""

    mass: Array
    stiffness: Array


def _rod(length: Array, rigidity: Array, line_inertia: Array) -> Rod:
    unit = np.array([[2.0, 1.0], [1.0, 2.0]]) / 6.0, np.array([[1.0, -1.0], [-1.0, 1.0]])
    size = line_inertia * length, rigidity / length
    return Rod(*(np.asarray(s)[..., None, None] * one for s, one in zip(size, unit, strict=True)))


def _compose(plane: PlaneBending, axial: Rod, torsion: Rod) -> ShaftElement:
    return ShaftElement(
        mass=_in_both_planes(plane.mass) + _along_axis(axial.mass, torsion.mass),
        translational_mass=_in_both_planes(plane.translational_mass),
        gyroscopic=_between_planes(plane.polar),
        stiffness=_in_both_planes(plane.stiffness)
        + _along_axis(axial.stiffness, torsion.stiffness),
    )


def _transform(*names: str, signs: tuple[int, ...]) -> Array:
    """Matrix (12, 2 w) that sends local DOF, node by node, to the twelve."""
    width = len(names)
    matrix = np.zeros((12, 2 * width))
    for node in (0, 1):
        for column, (name, sign) in enumerate(zip(names, signs, strict=True)):
            matrix[len(DIRECTIONS) * node + position(name), width * node + column] = sign
    return matrix


_PLANE_Y = _transform("y", "thz", signs=(1, 1))
_PLANE_Z = _transform("z", "thy", signs=(1, -1))
_AXIAL = _transform("x", signs=(1,))
_TORSION = _transform("thx", signs=(1,))


def _in_both_planes(matrix: Array) -> Array:
    return _PLANE_Y @ matrix @ _PLANE_Y.T + _PLANE_Z @ matrix @ _PLANE_Z.T


def _between_planes(polar: Array) -> Array:
    upper = _PLANE_Y @ polar @ _PLANE_Z.T
    return upper - np.swapaxes(upper, -1, -2)


def _along_axis(axial: Array, torsion: Array) -> Array:
    return _AXIAL @ axial @ _AXIAL.T + _TORSION @ torsion @ _TORSION.T
