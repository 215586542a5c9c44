"""How fine a mesh must be: the degree that carries a wave through an element within a tolerance.

An element of degree n that a wave of number k crosses over a length h errs in frequency by

    ½ (n! / (2n)!)² (k h)^(2n) / (2n + 1)

(Ainsworth, SIAM J. Numer. Anal. 42 (2004) 553, for equal elements in a row), of the energy that the
wave has there: an upper bound for bending, shear and rods alike.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Degrees = NDArray[np.intp]

HIGHEST = 10
FAR, HALVINGS = 1e12, 30
SAFETY = 5.0  # what is aimed at lies below what is asked by this
_DEGREES = np.arange(1, HIGHEST + 1)
_FACTOR = np.array(
    [0.5 * (math.factorial(n) / math.factorial(2 * n)) ** 2 / (2 * n + 1) for n in _DEGREES]
)


def expected_error(phase: Array, degree: Degrees) -> Array:
    """Relative error of a frequency by elements crossed with a ``phase`` k h [rad]."""
    return np.asarray(_FACTOR[degree - 1] * phase ** (2.0 * degree))


def least_degree(phase: Array, tolerance: float) -> Degrees:
    """The lowest degree within ``tolerance`` at each phase; 0 where none up to ``HIGHEST`` is."""
    errors = _FACTOR * np.asarray(phase)[..., None] ** (2.0 * _DEGREES)
    good = errors <= tolerance
    return np.where(good.any(axis=-1), good.argmax(axis=-1) + 1, 0).astype(np.intp)


def parts_and_degree(phase: Array, tolerance: float) -> tuple[Degrees, Degrees]:
    """Into how many equal parts a length of ``phase`` is cut, and their degree."""
    parts = np.ones(len(phase), dtype=np.intp)
    while not (degree := least_degree(phase / parts, tolerance / SAFETY)).all():
        parts = np.where(degree == 0, parts + 1 + parts // 4, parts)
    return parts, degree


def resolved(error: Callable[[float], float], tolerance: float, start: float) -> float:
    """Highest angular frequency [rad/s] up to which ``error`` (growing) stays within
    ``tolerance``, by bisection from ``start``; infinite where nothing bends."""
    low, high = 0.0, start
    while error(high) <= tolerance and high < FAR * start:
        low, high = high, 2.0 * high
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if error(middle) <= tolerance else (low, middle)
    return low


def bending_wave(
    omega: float, spin: float, shear: Array, bending: Array, line_mass: Array, rotary: Array
) -> Array:
    """Largest wave number [1/m] of whirl at ``omega`` [rad/s] either way, of each section.

    ``shear`` κGA [N], ``bending`` EI [N·m²], ``line_mass`` ρA [kg/m], ``rotary`` ρI [kg·m].
    """
    inertia = rotary * (omega**2 + 2.0 * abs(spin) * omega)
    mass = line_mass * omega**2
    p = mass / shear + inertia / bending
    q = mass / bending * (1.0 - inertia / shear)
    return np.sqrt((p + np.sqrt(p**2 + 4.0 * q)) / 2.0)


def rod_wave(omega: float, rigidity: Array, line_inertia: Array) -> Array:
    """Wave number [1/m] of axial motion or torsion at ``omega`` [rad/s]."""
    return omega * np.sqrt(line_inertia / rigidity)
