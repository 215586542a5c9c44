"""Displacement of a half-space under a short line of load, a part of Hertz's contact law.

The line lies across the raceway, its load a parabola over a half-length a. Along the raceway it is
a point, of which a Fourier series contains the wave numbers up to some K: the displacement of the
half-space is taken over the same, with the transform of Boussinesq's solution (K. L. Johnson,
Contact Mechanics, 1985, section 3.2), ∫ cos ky / √(x² + y²) dy = 2 K₀(k x).
"""

from __future__ import annotations

import math

import numpy as np
from scipy.special import iti0k0

from bearings.arrays import Array
from bearings.materials import Material

POINTS = 200  # of the quadratures


def half_space(material: Material, half_length: float, highest: float) -> float:
    """Mean normal displacement under a unit normal load, weighted by its parabola [m/N].

    ``highest``: largest wave number K [1/m] included.
    """
    part, weight = _distances()
    x = part * half_length
    integral = iti0k0(highest * x)[1]  # ∫ K₀ up to K x
    nu, shear = material.poisson_ratio, material.shear_modulus
    return (1.0 - nu) / (math.pi**2 * shear) * float((weight * integral / x).sum())


def _distances() -> tuple[Array, Array]:
    """Distances of two points of the parabola over a, (k,), and their probability weights."""
    node, weight = np.polynomial.legendre.leggauss(POINTS)
    t = 0.5 * (node + 1.0)
    gap, jacobian = 2.0 * t**3, 3.0 * t**2 * weight  # dense at 0, where the kernel is a logarithm
    half = 0.5 * (2.0 - gap)
    s = 0.5 * gap[:, None] + half[:, None] * node
    both = 0.75**2 * (1.0 - s**2) * (1.0 - (s - gap[:, None]) ** 2)
    return gap, 2.0 * jacobian * half * (both @ weight)
