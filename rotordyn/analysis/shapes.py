"""From reduced coordinates back to node displacements (x, y, z, θx, θy, θz)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.node import FREEDOMS, position
from rotordyn.system.lateral import LateralSystem
from rotordyn.system.longitudinal import RodSystem

Complex = NDArray[np.complex128]


def bending_shape(system: LateralSystem, vector: Complex, turning: float) -> Complex:
    """Node displacements (nodes, 6) of e^(iωt), ω > 0, for a bending mode.

    In the complex form a mode with ``turning`` = Im(pole) < 0 is the conjugate motion.
    """
    basis, size = system.rotor.basis, system.rotor.size
    if system.isotropic:
        plane = basis @ vector
        first = plane if turning > 0.0 else plane.conj()
        second = (-1j if turning > 0.0 else 1j) * first
    else:
        first, second = basis @ vector[:size], basis @ vector[size:]
    shape = np.zeros((len(basis) // 2, len(FREEDOMS)), dtype=complex)
    shape[:, position("y")], shape[:, position("thz")] = first[0::2], first[1::2]
    shape[:, position("z")], shape[:, position("thy")] = second[0::2], -second[1::2]
    return shape


def rod_shape(system: RodSystem, vector: Complex, freedom: str) -> Complex:
    """Node displacements (nodes, 6) of an axial or torsion mode."""
    shape = np.zeros((len(system.basis), len(FREEDOMS)), dtype=complex)
    shape[:, position(freedom)] = system.basis @ vector
    return shape


def scaled(shape: Complex) -> Complex:
    """Largest translation 1 and real (largest rotation where nothing translates)."""
    translations = shape[:, :3]
    pool = translations if np.abs(translations).max() > 0.0 else shape
    largest = pool.flat[int(np.abs(pool).argmax())]
    return np.asarray(shape / largest)
