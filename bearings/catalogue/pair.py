"""Rigidity and unloading force of two identical bearings back to back, rigidly preloaded, at rest.

A bearing pushed axially by x BD beyond touching has its groove centres at the angle α with
tan α = tan α0 + x/cos α0. Its balls are pressed by BD ε, ε = cos α0/cos α − 1, so that

    F = P ε^1.5 sin α,    P = Z K BD^1.5    (Harris, Rolling Bearing Analysis, preloading)

The pair has twice the slope of one. It unloads where the axial displacement of the loaded bearing
has doubled.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from bearings.arrays import Array

_FURTHEST = 1.5  # largest displacement beyond touching in the table, over BD
_POINTS = 3000


class AxialLaw:
    """Table of F/P and its slope over x, for one free contact angle α0 [rad]."""

    def __init__(self, contact_angle: float) -> None:
        # ln F over ln x is nearly straight, so that a table of it is exact to some 1e-6
        self._x = np.exp(np.linspace(math.log(1e-6), math.log(_FURTHEST), _POINTS))
        tangent = math.tan(contact_angle) + self._x / math.cos(contact_angle)
        stretch = math.cos(contact_angle) * np.hypot(1.0, tangent)
        angle = np.arctan(tangent)
        # ε = stretch − 1, without the difference of nearly equal numbers
        pressed = self._x * (2.0 * math.sin(contact_angle) + self._x) / (stretch + 1.0)
        sine = np.sin(angle)
        self._log_x = np.log(self._x)
        self._log_force = np.log(pressed**1.5 * sine)
        slope = 1.5 * np.sqrt(pressed) * sine**2
        slope = slope + pressed**1.5 * np.cos(angle) ** 2 / stretch
        self._log_slope = np.log(slope)

    def displacement(self, force: Array) -> Array:
        """Displacement x at which F/P is ``force``."""
        return np.exp(np.interp(np.log(force), self._log_force, self._log_x))

    def force(self, x: Array) -> Array:
        """F/P at x."""
        return np.exp(np.interp(np.log(x), self._log_x, self._log_force))

    def slope(self, x: Array) -> Array:
        """d(F/P)/dx at x."""
        return np.exp(np.interp(np.log(x), self._log_x, self._log_slope))


@lru_cache(maxsize=32)
def axial_law(contact_angle: float) -> AxialLaw:
    """Return the axial law of a free contact angle [rad]."""
    return AxialLaw(contact_angle)


def pair_values(
    law: AxialLaw, scale: Array, free_distance: Array, preload: float
) -> tuple[Array, Array]:
    """Axial rigidity of the pair [N/m] and the axial force that unloads one of it [N].

    ``scale`` P [N] and ``free_distance`` BD [m] of one bearing; ``preload`` of the pair [N].
    """
    x = law.displacement(preload / scale)
    return 2.0 * scale / free_distance * law.slope(x), scale * law.force(2.0 * x)
