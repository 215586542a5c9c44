"""Elliptic orbit of a point with harmonic motion in y and z."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Complex

CIRCLE = 1e-8  # of the half axes: a smaller difference is rounding; the angle is then 0


class Orbit(NamedTuple):
    """Half axes and angle of the major one from y to z [rad], −π/2 to π/2; arrays of one shape.

    ``minor`` is negative where the point whirls backward, from z to y.
    """

    major: Array
    minor: Array
    inclination: Array


def orbit(y: Complex, z: Complex) -> Orbit:
    """Return the orbit of y(t) = Re(``y`` e^(iωt)), z(t) = Re(``z`` e^(iωt)).

    y + i z = r₊ e^(iωt) + r₋ e^(−iωt): half axes |r₊| ± |r₋|, inclination half the sum of the
    arguments.
    """
    forward, backward = 0.5 * (y + 1j * z), 0.5 * (y.conj() + 1j * z.conj())
    plus, minus = np.abs(forward), np.abs(backward)
    is_circle = np.minimum(plus, minus) <= CIRCLE * np.maximum(plus, minus)
    angle = np.pi - np.mod(np.pi - np.angle(forward) - np.angle(backward), 2.0 * np.pi)
    angle = np.where(is_circle, 0.0, 0.5 * angle)
    return Orbit(plus + minus, plus - minus, angle)
