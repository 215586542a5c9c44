"""A rigid mass on one node, 6×6."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.equation.dofs import position
from rotordyn.machine.lumped import PointMass

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class LumpedElement:
    """Matrices of shape (6, 6); the same meaning and signs as in ``ShaftElement``."""

    mass: Array
    translational_mass: Array
    gyroscopic: Array


def lumped_element(body: PointMass) -> LumpedElement:
    """Mass and inertias [kg, kg·m²] on the node at which the body sits."""
    transverse = _diagonal(y=body.mass, z=body.mass)
    turning = _diagonal(
        thx=body.polar_inertia, thy=body.diametral_inertia, thz=body.diametral_inertia
    )
    gyroscopic = np.zeros((6, 6))
    gyroscopic[position("thy"), position("thz")] = body.polar_inertia
    gyroscopic[position("thz"), position("thy")] = -body.polar_inertia
    return LumpedElement(
        mass=transverse + _diagonal(x=body.mass) + turning,
        translational_mass=transverse,
        gyroscopic=gyroscopic,
    )


def _diagonal(**entries: float) -> Array:
    matrix = np.zeros((6, 6))
    for freedom, value in entries.items():
        matrix[position(freedom), position(freedom)] = value
    return matrix
