"""Fineness of a model: elements and their reduction for a required accuracy.

An element of degree n that a wave of number k crosses over a length h errs in frequency by

    ½ (n! / (2n)!)² (k h)^(2n) / (2n + 1)

(Ainsworth, SIAM J. Numer. Anal. 42 (2004) 553, for equal elements in a row), of the energy that the
wave has there: an upper bound for bending, shear and rods alike. That is half the share of the
strain energy in the strain ε ~ e^(ikx) which polynomials of degree n − 1 lack, by its n-th
derivative. In a cone ε ~ e^(ikx)/d⁴, and (k h)^n becomes

    Σ_j C(n, j) (k h)^(n−j) τ^j (j + 3)!/3!,   τ = 4 (√r − 1)/(√r + 1)

with r the ratio of the diameters, or walls, at the ends of the element (for a small taper τ is its
relative change, and (τ/4)^j is how Legendre series of functions with a pole at the apex fall).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rotordyn.arrays import Array, Indices
from rotordyn.numerics.crossing import boundary

USUAL = 1e-4  # relative error of a frequency that a designer does not notice
CUTOFF = 2.5  # free-free modes kept, over the highest frequency required, at the usual accuracy
STANDARD_CUTOFF = 4.0  # the same with standard elements, whose own error is to dominate
WEIGHTLESS = 30.0  # frequency of massless DOF over the highest required, at the usual accuracy
PRECISE = 1e-5  # accuracy below which gyroscopic forces get static modes
HEAVIEST = 1e3  # of the cut-off: no coordinate has a higher frequency
OWN_MASS = 0.1 * HEAVIEST  # of the cut-off: a fictitious mass changes lower frequencies by 1 %
# Cut-off of a finer model over that of the one before. 1.5 may add no mode: of 1279 errors of
# random rotors it reports one 10 times too small, 2 none, in the same time (test_random_rotors).
FINER = 2.0
HIGHEST = 10  # degree of elements
FAR = 1e12  # of a start, in ``resolved``
SAFETY = 5.0  # required error over the one aimed at
_DEGREES = np.arange(1, HIGHEST + 1)
_CONE = np.array(
    [
        [math.comb(n, j) * math.factorial(j + 3) / 6.0 if j <= n else 0.0 for n in _DEGREES]
        for j in range(HIGHEST + 1)
    ]
)
_FACTOR = np.array(
    [0.5 * (math.factorial(n) / math.factorial(2 * n)) ** 2 / (2 * n + 1) for n in _DEGREES]
)
SLOWEST = 1e-6  # rad/s: least band


@dataclass(frozen=True, slots=True)
class Fineness:
    """Required fineness of a model: relative ``accuracy`` of frequencies up to ``frequency`` [Hz].

    ``spin`` [rad/s]: highest speed. ``accuracy`` None: standard elements between the nodes of the
    mesh, whatever their error. ``finer``: steps beyond that; each is one degree more in every
    element, or half the length of standard ones, and a cut-off ``FINER`` times as high.
    A ``frequency`` of 0 is a shaft at rest, of elements between all nodes shown.
    """

    frequency: float
    spin: float = 0.0
    accuracy: float | None = None
    finer: int = 0

    @property
    def static(self) -> bool:
        """True of a shaft at rest: nodes at which elements of cylinders are exact are all shown."""
        return self.frequency == 0.0

    @property
    def band(self) -> float:
        """Highest frequency required [rad/s], or the least one whose squares are numbers."""
        return max(2.0 * math.pi * self.frequency, SLOWEST)

    @property
    def cutoff(self) -> float:
        """Frequency up to which free-free modes are kept [rad/s]: the error by truncated ones falls
        with its fourth power."""
        factor = STANDARD_CUTOFF if self.accuracy is None else CUTOFF * self._finer**0.25
        return FINER**self.finer * factor * self.band

    @property
    def gyroscopic(self) -> bool:
        """True if static modes represent the gyroscopic forces of the modes required: cheaper than
        a higher cut-off for high accuracy."""
        return self.finer > 0 or self._precise

    @property
    def slow(self) -> float:
        """Frequency [rad/s] below which the basis has static modes of the gyroscopic forces of
        every mode: above the band, since free-free modes above it contribute to modes in it."""
        return FINER ** (self.finer + self._precise) * self.band

    @property
    def _precise(self) -> bool:
        return self.accuracy is None or self.accuracy < PRECISE

    @property
    def weightless(self) -> float:
        """Frequency [rad/s] that a fictitious mass gives to massless DOF, far above the band: the
        error by that mass falls with its square."""
        return FINER**self.finer * WEIGHTLESS * self._finer**0.5 * self.band

    @property
    def own_mass(self) -> float:
        """Frequency [rad/s] below which motions have the mass of the machine; above, nearly
        massless coordinates may have a fictitious one."""
        return OWN_MASS * self.cutoff

    @property
    def _finer(self) -> float:
        """Factor by which the model is more accurate than usual, at least 1."""
        return 1.0 if self.accuracy is None else max(1.0, USUAL / self.accuracy)


def least_degree(phase: Array, tolerance: float, ratio: Array) -> Indices:
    """Return the lowest degree within ``tolerance`` at each phase and ``ratio`` of diameters; 0
    where none up to ``HIGHEST`` is."""
    errors = _FACTOR * _derivatives(phase, ratio) ** 2
    sufficient = errors <= tolerance
    return np.where(sufficient.any(axis=-1), sufficient.argmax(axis=-1) + 1, 0).astype(np.intp)


def _derivatives(phase: Array, ratio: Array) -> Array:
    """Return hⁿ times the n-th derivative of the strain, over its size, of every degree n."""
    value, root = phase[..., None] ** (1.0 * _DEGREES), np.sqrt(ratio)
    if (ratio == 1.0).all():
        return np.asarray(value)
    taper = 4.0 * (root - 1.0) / (root + 1.0)
    for j in _DEGREES:
        share = phase[..., None] ** np.maximum(_DEGREES - j, 0.0) * taper[..., None] ** float(j)
        value = value + _CONE[j] * share
    return np.asarray(value)


def cut(ratio: Array, parts: Indices) -> Array:
    """Return the ratio of end diameters of the steepest of equal parts of a cone of ``ratio``."""
    return np.asarray(1.0 + (ratio - 1.0) / parts)


def parts_and_degree(phase: Array, tolerance: float, ratio: Array) -> tuple[Indices, Indices]:
    """Return the number of equal parts into which lengths of ``phase`` are cut, cones with a
    ``ratio`` of the diameters at their ends, and their degree."""
    parts = np.ones(len(phase), dtype=np.intp)
    while not (degree := least_degree(phase / parts, tolerance / SAFETY, cut(ratio, parts))).all():
        parts = np.where(degree == 0, parts + 1 + parts // 4, parts)
    return parts, degree


def resolved(error: Callable[[float], float], tolerance: float, start: float) -> float:
    """Return the highest angular frequency [rad/s] up to which ``error`` (growing) stays within
    ``tolerance``, by bisection from ``start``; beyond ``FAR`` × ``start`` if nothing bends."""
    low, high = 0.0, start
    while error(high) <= tolerance and high < FAR * start:
        low, high = high, 2.0 * high
    return boundary(lambda omega: error(omega) <= tolerance, low, high)[0]


def bending_wave(
    omega: float, spin: float, shear: Array, bending: Array, line_mass: Array, rotary: Array
) -> Array:
    """Return the largest wave number [1/m] of whirl at ±``omega`` [rad/s] in each section.

    ``shear`` κGA [N], ``bending`` EI [N·m²], ``line_mass`` ρA [kg/m], ``rotary`` ρI [kg·m].
    """
    inertia = rotary * (omega**2 + 2.0 * abs(spin) * omega)
    mass = line_mass * omega**2
    p = mass / shear + inertia / bending
    q = mass / bending * (1.0 - inertia / shear)
    return np.sqrt((p + np.sqrt(p**2 + 4.0 * q)) / 2.0)


def rod_wave(omega: float, rigidity: Array, line_inertia: Array) -> Array:
    """Return the wave number [1/m] of axial motion or torsion at ``omega`` [rad/s]."""
    return omega * np.sqrt(line_inertia / rigidity)
