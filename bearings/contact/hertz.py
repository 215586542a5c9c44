"""Elliptic Hertzian contact, from the exact elliptic integrals (no curve fits).

Notation of Harris, *Rolling Bearing Analysis*, ch. 6: Σρ sum and F(ρ) difference of curvatures,
κ = a/b ≥ 1 ellipticity, a*, b*, δ* dimensionless semi-axes and approach.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from bearings.arrays import Array


class HertzContact(NamedTuple):
    """Hertzian contact of two bodies.

    ``stiffness`` k of Q = k δ^1.5 [N/m^1.5]; ``ellipticity`` κ; ``second_integral`` E(κ);
    ``semi_axis_major`` and ``semi_axis_minor``: a/Q^(1/3), b/Q^(1/3) [m/N^(1/3)].
    """

    stiffness: float
    ellipticity: float
    second_integral: float
    semi_axis_major: float
    semi_axis_minor: float

    def peak_pressure(self, load: Array) -> Array:
        """Largest pressure p = 3 Q / (2 π a b) under ``load`` Q ≥ 0 [Pa]."""
        return 1.5 / (math.pi * self.semi_axis_major * self.semi_axis_minor) * load ** (1.0 / 3.0)


def curvature_difference(ellipticity: float) -> float:
    """F(ρ) of a contact of given ellipticity κ > 1 (Harris 6.31)."""
    first, second = _integrals(ellipticity)
    return 1.0 - 2.0 * (first / second - 1.0) / (ellipticity**2 - 1.0)


def ellipticity(difference: float) -> float:
    """κ of a contact with curvature difference F(ρ) in (0, 1): bisection in ln κ, to rounding."""
    low, high = 1e-6, 16.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        if curvature_difference(math.exp(middle)) < difference:
            low = middle
        else:
            high = middle
    return math.exp(0.5 * (low + high))


def dimensionless(kappa: float) -> tuple[float, float, float]:
    """(a*, b*, δ*) of a contact of ellipticity κ (Harris 6.38–6.40)."""
    first, second = _integrals(kappa)
    major = (2.0 * kappa**2 * second / math.pi) ** (1.0 / 3.0)
    approach = 2.0 * first / math.pi * (math.pi / (2.0 * kappa**2 * second)) ** (1.0 / 3.0)
    return major, major / kappa, approach


def contact(curvature_sum: float, difference: float, compliance: float) -> HertzContact:
    """Solve the Hertzian contact of two bodies.

    ``curvature_sum`` Σρ [1/m], ``difference`` F(ρ) in (0, 1), ``compliance`` Σ(1 − ν²)/E [1/Pa].
    """
    kappa = ellipticity(difference)
    major, minor, approach = dimensionless(kappa)
    size = (1.5 * compliance / curvature_sum) ** (1.0 / 3.0)
    return HertzContact(
        stiffness=(approach * size**2 * curvature_sum / 2.0) ** -1.5,
        ellipticity=kappa,
        second_integral=_integrals(kappa)[1],
        semi_axis_major=major * size,
        semi_axis_minor=minor * size,
    )


def _integrals(kappa: float) -> tuple[float, float]:
    """Complete elliptic integrals K, E of modulus² m = 1 − 1/κ², by the arithmetic-geometric mean.

    Abramowitz & Stegun 17.6: K = π/(2 agm(1, 1/κ)), E = K (1 − Σ 2^(n−1) cₙ²) with c₀² = m. Nine
    steps reach rounding; importing a library for them would take longer than a whole preload sweep.
    """
    a, b, total, weight = 1.0, 1.0 / kappa, 0.5 * (1.0 - kappa**-2), 1.0
    for _ in range(9):
        a, b, c = 0.5 * (a + b), math.sqrt(a * b), 0.5 * (a - b)
        total += weight * c * c
        weight *= 2.0
    first = math.pi / (2.0 * a)
    return first, first * (1.0 - total)
