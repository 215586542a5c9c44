"""The contact ellipse on its groove: half-axes, ends, and what lies beyond the groove.

Angles are measured in the section of the ring about the centre of the groove, from the radial
direction. The major axis, of half-length a, lies along the groove of radius f D and so takes the
angle a/(f D) either side of the contact angle (Lacroix 2014, section 2.4).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bearings.contact.hertz import HertzContact

    Array = NDArray[np.float64]


def half_axes(race: HertzContact, load: Array) -> tuple[Array, Array]:
    """Half-axes a along the groove and b along the rolling direction under ``load`` Q ≥ 0 [m]."""
    size = np.cbrt(load)
    return race.semi_axis_major * size, race.semi_axis_minor * size


def share_outside(lower: Array, upper: Array, least: Array, most: Array) -> Array:
    """Share of the length lower … upper that lies outside least … most; NaN bounds are none."""
    low = np.where(np.isnan(least), -np.inf, least)
    high = np.where(np.isnan(most), np.inf, most)
    beyond = np.maximum(upper - np.maximum(high, lower), 0.0)
    beyond += np.maximum(np.minimum(low, upper) - lower, 0.0)
    length = upper - lower
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(length > 0.0, np.minimum(beyond / length, 1.0), 0.0)
