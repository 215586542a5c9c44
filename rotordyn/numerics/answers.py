"""Answers of a system to forces that differ from one s to the next, from its modes."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.numerics.modes import WELL_CONDITIONED, Modes

Complex = NDArray[np.complex128]


def answers(found: Modes, s: Complex, force: NDArray[Any], side: float = 1.0) -> Complex:
    """Solutions x (n, f) of Z x = ``force`` (n, f or 1) for the first system of ``found``.

    With Z = s² + s D + K at ``s`` (f,); ``side`` −1: of Zᵀ x = force.
    """
    if found.condition[0] >= WELL_CONDITIONED:
        stiff = found.stiffness[0] + s[:, None, None] * found.damping[0]
        dynamic = stiff + (s * s)[:, None, None] * np.eye(len(force))
        dynamic = dynamic if side > 0.0 else np.swapaxes(dynamic, -1, -2)
        right = np.broadcast_to(force, (len(force), len(s))).T[..., None] + 0j
        return np.asarray(np.linalg.solve(dynamic, right)[..., 0].T, dtype=complex)
    vector, left = found.vector[0], found.participation[0]
    if side < 0.0:
        vector, left = left.T, vector.T
    near = 1.0 / (s - found.pole[0][:, None])
    return np.asarray(vector @ (near * (left @ force)))
