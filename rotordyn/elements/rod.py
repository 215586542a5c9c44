"""Two-node rod: one freedom per node, linear in between (axial motion or torsion)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_STIFFNESS = np.array([[1.0, -1.0], [-1.0, 1.0]])
_MASS = np.array([[2.0, 1.0], [1.0, 2.0]]) / 6.0


@dataclass(frozen=True, eq=False, slots=True)
class Rod:
    """Matrices of shape (…, 2, 2)."""

    mass: Array
    stiffness: Array


def rod(length: Array, rigidity: Array, line_inertia: Array) -> Rod:
    """Consistent matrices of rods, leading dimensions broadcast.

    ``length`` [m]; ``rigidity`` E A [N] or G Ip [N·m²]; ``line_inertia`` ρ A [kg/m] or ρ Ip [kg·m].
    """
    mass = _spread(line_inertia * length) * _MASS
    return Rod(mass=mass, stiffness=_spread(rigidity / length) * _STIFFNESS)


def _spread(values: Array) -> Array:
    return np.asarray(values)[..., None, None]
