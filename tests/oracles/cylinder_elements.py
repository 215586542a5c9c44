"""Elements of the product for hollow cylinders, by their dimensions (elements,) in SI."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rotordyn.equation.elements.beam import PlaneBending, beam_matrices, shear_parameter
from rotordyn.equation.elements.rod import rod_matrices
from rotordyn.machine.cross_section import area, second_moment

Array = NDArray[np.float64]


def hierarchic_bending(
    length: Array,
    outer: Array,
    inner: Array,
    young: Array,
    shear_modulus: Array,
    density: Array,
    kappa: Array,
    *,
    degree: int,
) -> PlaneBending:
    """A beam of any ``degree``."""
    ring, moment = area(outer, inner), second_moment(outer, inner)
    shear, bending = kappa * shear_modulus * ring, young * moment
    along = (each[:, None] for each in (shear, bending, density * ring, density * moment))
    return beam_matrices(length, shear_parameter(length, bending, shear), *along, degree=degree)


def hierarchic_rod(
    length: Array, rigidity: Array, line_inertia: Array, *, degree: int
) -> tuple[Array, Array]:
    """Mass and stiffness of a rod of any ``degree``."""
    return rod_matrices(length, rigidity[:, None], line_inertia[:, None], degree=degree)
