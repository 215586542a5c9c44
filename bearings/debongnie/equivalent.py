"""Equivalent loads: radial loads at rest with the same largest ball load, or with the same life.

Life after Lundberg and Palmgren (1947); equations 20 to 28.
"""

from __future__ import annotations

import math

LIFE = 10.0 / 3.0  # w, exponent of load for a race that stands still under passing balls


def equivalent_factors(exponent: float = 1.5) -> tuple[float, float, float]:
    """Factors of z Q in P0, Pi and Pe, for a ring at rest with Q ∝ cosⁿ θ (20, 28).

    Contacts at rest are Hertz', n = 1.5: 0.2288, 0.4068, 0.3895.
    """
    radial = _mean_of_cosine(exponent + 1.0)
    inner = radial / _mean_of_cosine(3.0 * exponent) ** (1.0 / 3.0)
    return radial, inner, radial / _mean_of_cosine(LIFE * exponent) ** (1.0 / LIFE)


def race_weights(
    size_ratio: float, inner: float = 0.52, outer: float = 0.52
) -> tuple[float, float]:
    """(C/Ci)^w and (C/Ce)^w, which add up to 1 (21 to 26).

    ``size_ratio`` is D/dm; ``inner``, ``outer`` are groove radii over ball diameter.
    """
    grooves = inner / outer * (2.0 * outer - 1.0) / (2.0 * inner - 1.0)
    ratio = 1.04 * ((1.0 - size_ratio) / (1.0 + size_ratio)) ** 1.72 * grooves**0.41  # Ci/Ce
    return 1.0 / (1.0 + ratio**LIFE), 1.0 / (1.0 + ratio**-LIFE)


def _mean_of_cosine(power: float) -> float:
    """Mean around the ring of cosᵖ θ over the loaded half."""
    return math.gamma(power / 2.0 + 0.5) / math.gamma(power / 2.0 + 1.0) / math.sqrt(4.0 * math.pi)
