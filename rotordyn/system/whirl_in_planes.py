"""Whirl seen in the planes y and z, and where nothing couples these.

Motion in both is the sum of forward whirl y + iz at ω and of backward whirl y − iz, the conjugate
of whirl at −ω. In circular coordinates, where each is answered by itself, matrices are real unless
they couple the planes.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Values = NDArray[np.inexact[Any]]
FORWARD = np.array([1.0, -1.0j])  # planes y and z of whirl r e^(iωt)


def planes_of(forward: Values, backward: Values) -> tuple[Values, Values]:
    """Plane y and plane z of y + iz and y − iz."""
    return 0.5 * (forward + backward), -0.5j * (forward - backward)


def planes_of_whirl(both_ways: Values) -> tuple[Values, Values]:
    """Plane y and plane z (…, f) of whirl at ω, then at −ω (…, 2f)."""
    ahead, back = np.split(both_ways, 2, axis=-1)
    return planes_of(ahead, back.conj())


def receptance_in_planes(
    both_ways: Complex, turns: NDArray[np.intp], planar: NDArray[np.bool_]
) -> Complex:
    """Receptances (…, pairs, f) from those of whirl at ω, then at −ω (…, pairs, 2f).

    A force in one plane whirls both ways. ``turns`` (pairs,): 0 within a plane, +1 from a force in
    plane y to plane z, −1 back; ``planar`` (…,): nothing couples the planes, not even rounding.
    """
    same, across = planes_of_whirl(both_ways)
    across[planar] = 0.0
    turn = turns[:, None]
    return np.where(turn == 0, same, turn * across)


def are_apart(stiffness: Values, damping: Values, spin: Array) -> NDArray[np.bool_]:
    """Where nothing couples the planes (speeds,), by matrices (speeds, …) in circular coordinates.

    ``spin`` (speeds,) [rad/s]: of what couples them as it turns and is not in these matrices.
    """
    apart = spin == 0.0
    for matrix in (stiffness, damping):
        apart &= ~matrix.imag.reshape(len(matrix), -1).any(axis=1)
    return apart
