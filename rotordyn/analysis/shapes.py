"""From reduced coordinates back to node displacements (x, y, z, θx, θy, θz)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.node import FREEDOMS

Complex = NDArray[np.complex128]


def both_planes(vector: Complex, turning: float) -> Complex:
    """Plane y and plane z of e^(iωt), ω > 0, for a mode of the complex form (m,) -> (2m,).

    A mode with ``turning`` = Im(pole) < 0 is the conjugate motion.
    """
    first = vector if turning > 0.0 else vector.conj()
    return np.concatenate([first, (-1j if turning > 0.0 else 1j) * first])


def scaled(shape: Complex, kind: str) -> Complex:
    """Largest translation 1 and real; in torsion, the largest twist."""
    axis = FREEDOMS.index("thx")
    pool = shape[:, axis] if kind == "torsion" else shape[:, :3]
    largest = pool.flat[int(np.abs(pool).argmax())]
    return np.asarray(shape / largest)
