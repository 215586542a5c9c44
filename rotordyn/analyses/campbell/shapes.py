"""From reduced coordinates back to node displacements (x, y, z, θx, θy, θz)."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Complex
from rotordyn.equation.dofs import position


def scaled(shape: Complex, kind: str) -> Complex:
    """Largest translation 1 and real; in torsion, the largest twist."""
    axis = position("thx")
    pool = shape[:, axis] if kind == "torsion" else shape[:, :3]
    largest = pool.flat[int(np.abs(pool).argmax())]
    return np.asarray(shape / largest)
