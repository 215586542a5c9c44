"""Two-node Timoshenko beam in one plane: DOF (v1, φ1, v2, φ2), φ = v′ where shear is absent.

Both planes of a shaft have these matrices: φ = θz in the x–y plane, φ = −θy in the x–z plane.
The shape functions are the element's static solutions, of constant shear force (Nelson 1980, J.
Mech. Des. 102, 793; Friswell et al. 2010, ch. 5): static deflections are exact at the nodes, and
frequencies err by s (k h)²/24 + (1 − s) (k h)⁴/1440 with s the shear share of the strain energy; on
very stubby shafts rotary inertia adds a little to the first term.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.machine.cross_section import area, second_moment

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class PlaneBending:
    """Matrices of shape (…, 4, 4), real and symmetric.

    ``mass`` = ``translational_mass`` + rotary mass; ``polar`` Jp ≥ 0 couples the two planes by
    ω Ω Jp in (K + ω Ω Jp − ω² M) φ = 0.
    """

    mass: Array
    translational_mass: Array
    polar: Array
    stiffness: Array


def plane_bending(
    length: Array,
    outer_diameter: Array,
    inner_diameter: Array,
    young_modulus: Array,
    shear_modulus: Array,
    density: Array,
    shear_coefficient: Array,
) -> PlaneBending:
    """Consistent matrices of hollow circular elements; leading dimensions broadcast.

    Lengths and diameters [m], moduli [Pa], density [kg/m³], shear coefficient κ [1].
    """
    ring_area = area(outer_diameter, inner_diameter)
    ring_moment = second_moment(outer_diameter, inner_diameter)
    bending, shear = young_modulus * ring_moment, shear_coefficient * shear_modulus * ring_area
    phi = shear_parameter(length, bending, shear)
    translational = _translational_mass(length, phi, density * ring_area)
    rotary = _slope_product(length, phi, density * ring_moment)
    return PlaneBending(
        mass=translational + rotary,
        translational_mass=translational,
        polar=2.0 * rotary,
        stiffness=_stiffness(length, phi, bending),
    )


def shear_parameter(length: Array, bending_rigidity: Array, shear_rigidity: Array) -> Array:
    """Φ = 12 E I / (κ G A L²) [1]: 0 for a slender element, large for a stubby one."""
    return 12.0 * bending_rigidity / (shear_rigidity * length**2)


def _stiffness(length: Array, phi: Array, bending: Array) -> Array:
    twelve, six = 12.0 + 0.0 * phi, 6.0 + 0.0 * phi
    scale = bending / ((1.0 + phi) * length**3)
    return _pattern(length, scale, twelve, six, -twelve, six, 4.0 + phi, 2.0 - phi)


def _translational_mass(length: Array, phi: Array, line_mass: Array) -> Array:
    return _pattern(
        length,
        line_mass * length / (840.0 * (1.0 + phi) ** 2),
        312.0 + 588.0 * phi + 280.0 * phi**2,
        44.0 + 77.0 * phi + 35.0 * phi**2,
        108.0 + 252.0 * phi + 140.0 * phi**2,
        -(26.0 + 63.0 * phi + 35.0 * phi**2),
        8.0 + 14.0 * phi + 7.0 * phi**2,
        -(6.0 + 14.0 * phi + 7.0 * phi**2),
    )


def _slope_product(length: Array, phi: Array, line_inertia: Array) -> Array:
    """ρ I ∫ φ² dx with φ the rotation of the section."""
    return _pattern(
        length,
        line_inertia / (30.0 * length * (1.0 + phi) ** 2),
        36.0 + 0.0 * phi,
        3.0 - 15.0 * phi,
        -36.0 + 0.0 * phi,
        3.0 - 15.0 * phi,
        4.0 + 5.0 * phi + 10.0 * phi**2,
        -1.0 - 5.0 * phi + 5.0 * phi**2,
    )


# Place of each of (a, b, c, d, e, f, −b, −d) in the matrix.
_LAYOUT = np.array([[0, 1, 2, 3], [1, 4, 7, 5], [2, 7, 0, 6], [3, 5, 6, 4]])


def _pattern(length: Array, scale: Array, *terms: Array) -> Array:
    """The one layout that a symmetric beam element has, from its six terms without dimension."""
    a, b, c, d, e, f = terms
    table = np.stack(np.broadcast_arrays(a, b, c, d, e, f, -b, -d), axis=-1)[..., _LAYOUT]
    one = np.ones_like(length)
    lever = np.stack((one, length, one, length), axis=-1)
    return np.asarray(scale)[..., None, None] * lever[..., :, None] * lever[..., None, :] * table
