"""Equivalent loads of ISO 281 and ISO 76, as catalogues compute them, and the life they give."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from bearings.arguments import checked
from bearings.arrays import Array
from bearings.errors import InvalidBearing, shown

# 15°: i Fa/C0, e and Y of ISO 281; X 0.44 (SNFA's and GMN's catalogues print the same).
_SHALLOW = np.array(
    [
        (0.015, 0.38, 1.47),
        (0.029, 0.40, 1.40),
        (0.058, 0.43, 1.30),
        (0.087, 0.46, 1.23),
        (0.12, 0.47, 1.19),
        (0.17, 0.50, 1.12),
        (0.29, 0.55, 1.02),
        (0.44, 0.56, 1.00),
        (0.58, 0.56, 1.00),
    ]
)
# contact angle [deg]: e, X, Y of ISO 281, one row or several in tandem; 25° as two catalogues print
# them, the others from memory [M]
_STEEP = {20: (0.57, 0.43, 1.00), 25: (0.68, 0.41, 0.87), 30: (0.80, 0.39, 0.76)}
_STEEP |= {35: (0.95, 0.37, 0.66), 40: (1.14, 0.35, 0.57), 45: (1.34, 0.33, 0.50)}
# contact angle [deg]: Y0 of ISO 76; 15°, 20° and 25° as printed, the others from memory [M]
STATIC_FACTOR = {
    5: 0.52,
    10: 0.50,
    15: 0.46,
    20: 0.42,
    25: 0.38,
    30: 0.33,
    35: 0.29,
    40: 0.26,
    45: 0.22,
}


@checked
def pair_rating(single: float, rows: int) -> float:
    """C of ``rows`` identical bearings that share the load, i^0.7 C1 [N]; catalogues print C1."""
    if rows < 1:
        raise InvalidBearing(f"rows must be at least 1, got {shown(rows)}")
    return float(rows**0.7 * single)


@checked
def dynamic_load(
    radial: ArrayLike,
    axial: ArrayLike,
    contact_angle: float,
    axial_over_static: ArrayLike | None = None,
) -> Array:
    """P of a single-row angular-contact bearing, X Fr + Y Fa where Fa/Fr > e, else Fr [N].

    ``contact_angle`` [rad], to whole degrees: 15° or one of the table, 20° to 45° by 5°;
    ``axial_over_static``: i Fa/C0, which a bearing of 15° needs.

    Raises
    ------
    InvalidBearing : an angle the table does not have, 15° without ``axial_over_static``
    """
    fr, fa = np.abs(np.asarray(radial, float)), np.abs(np.asarray(axial, float))
    degrees = round(math.degrees(contact_angle))
    if degrees == 15:
        if axial_over_static is None:
            raise InvalidBearing("a contact angle of 15° needs axial_over_static, i Fa/C0: give it")
        share = np.asarray(axial_over_static, float)
        e, y = (np.interp(share, _SHALLOW[:, 0], _SHALLOW[:, k]) for k in (1, 2))
        x: Array | float = 0.44
    elif degrees in _STEEP:
        e, x, y = (np.asarray(value) for value in _STEEP[degrees])
    else:
        raise InvalidBearing(
            f"no factors X and Y of ISO 281 for a contact angle of {degrees}°: 15° or "
            f"{', '.join(map(str, _STEEP))}°; take the life of a state instead"
        )
    return np.asarray(np.where(fa > e * fr, x * fr + y * fa, fr))


@checked
def equivalent_static(radial: ArrayLike, axial: ArrayLike, contact_angle: float) -> Array:
    """P0 = max(0.5 Fr + Y0 Fa, Fr) of a single-row angular-contact bearing [N].

    ``contact_angle`` [rad], to whole degrees: 5° to 45° by 5°; raises InvalidBearing for others.
    """
    degrees = round(math.degrees(contact_angle))
    if degrees not in STATIC_FACTOR:
        raise InvalidBearing(f"no factor Y0 of ISO 76 at {degrees}°: 5° to 45° by 5°")
    fr, fa = np.abs(np.asarray(radial, float)), np.abs(np.asarray(axial, float))
    return np.asarray(np.maximum(0.5 * fr + STATIC_FACTOR[degrees] * fa, fr))


@checked
def basic_life(rating: ArrayLike, load: ArrayLike) -> Array:
    """L10 = (C/P)³ million revolutions, in revolutions; InvalidBearing for negative arguments."""
    for name, value in (("rating", rating), ("load", load)):
        if (np.asarray(value, float) < 0.0).any():
            raise InvalidBearing(f"{name} must not be negative, got {shown(value)}")
    with np.errstate(divide="ignore"):
        return np.asarray(1e6 * (np.asarray(rating, float) / np.asarray(load, float)) ** 3)
