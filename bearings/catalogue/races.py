"""Hertz contacts and static load ratings of many internal geometries of a bearing at once.

The contact of each is that of ``bearings.contact.hertz``, interpolated over the curvature
difference, since an estimate compares some ten thousand geometries.
"""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np

from bearings.arrays import Array
from bearings.contact.hertz import curvature_difference, dimensionless
from bearings.life.rating import STATIC_PRESSURE, Insides, steep
from bearings.materials import Material

DEGREE = 32  # of the polynomials over the curvature difference


def contact_stiffness(x: Insides, ball: Material, ring: Material) -> Array:
    """K of Q = K δ^1.5, both races in series [N/m^1.5]."""
    compliance = ball.contact_compliance + ring.contact_compliance
    series: Array = np.zeros(())
    for side in (1.0, -1.0):
        total, approach, _ = _race(x, side)
        size = (1.5 * compliance / total) ** (2.0 / 3.0)
        series = series + approach * size * total / 2.0
    return series**-1.5


def static_rating(x: Insides, ball: Material, ring: Material) -> Array:
    """C0 of one row [N]: its most loaded ball at 4200 MPa on the worse race, 5 Fr/(Z cos α) of a
    radial load or, above 45°, Fa/(Z sin α) of an axial one.

    This is ISO 76 with the contact instead of its table f0 [M]; hybrid: the same pressure.
    """
    compliance = ball.contact_compliance + ring.contact_compliance
    loads = []
    for side in (1.0, -1.0):
        total, _, area = _race(x, side)
        unit = 1.5 / (math.pi * area * (1.5 * compliance / total) ** (2.0 / 3.0))
        loads.append((STATIC_PRESSURE / unit) ** 3)
    angle = x.contact_angle
    share = math.sin(angle) if steep(angle) else math.cos(angle) / 5.0
    return np.minimum(*loads) * x.balls * share


def _race(x: Insides, side: float) -> tuple[Array, Array, Array]:
    """Σρ [1/m], δ* and a* b* on one race; ``side`` +1 inner, −1 outer."""
    ball = 2.0 / x.ball_diameter
    conformity = x.inner_conformity if side > 0.0 else x.outer_conformity
    rolling = side * ball * x.gamma / (1.0 - side * x.gamma)
    groove = -1.0 / (conformity * x.ball_diameter)
    total = 2.0 * ball + rolling + groove
    approach, area = np.exp(interpolated(-np.log1p(-(rolling - groove) / total)))
    return total, approach, area


def interpolated(where: Array) -> Array:
    """ln δ* and ln a* b* at −ln(1 − F(ρ)), shape (2, …), within 2e-8."""
    from numpy.polynomial.chebyshev import chebval

    low, high, coefficients = _series()
    return np.asarray(chebval((2.0 * where - low - high) / (high - low), coefficients))


@cache
def _series() -> tuple[float, float, Array]:
    """Limits of −ln(1 − F(ρ)) and the Chebyshev series of ln δ* and ln a* b* between them; splines
    of scipy take longer to load than an estimate takes."""
    from numpy.polynomial.chebyshev import chebfit

    kappa = np.exp(np.linspace(0.05, 8.0, 160))
    where = np.array([-math.log1p(-curvature_difference(ellipticity)) for ellipticity in kappa])
    values: Any = np.log([dimensionless(ellipticity) for ellipticity in kappa])
    low, high = float(where.min()), float(where.max())
    parts = np.column_stack((values[:, 2], values[:, 0] + values[:, 1]))
    return low, high, chebfit((2.0 * where - low - high) / (high - low), parts, DEGREE)
