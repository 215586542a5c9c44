"""The ellipse that a point runs through under harmonic motion in y and z."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Complex

CIRCLE = 1e-8  # of the half axes: a smaller difference is rounding, and the angle taken as 0


class Orbit(NamedTuple):
    """Half axes and the angle of the major one from y to z [rad], −π/2 to π/2; arrays alike.

    ``minor`` is negative where the point runs backward, from z to y.
    """

    major: Array
    minor: Array
    inclination: Array


def orbit(y: Complex, z: Complex) -> Orbit:
    """Of y(t) = Re(``y`` e^(iωt)), z(t) = Re(``z`` e^(iωt)).

    y + i z = r₊ e^(iωt) + r₋ e^(−iωt): half axes |r₊| ± |r₋|, inclination half the sum of the
    arguments.
    """
    forward, backward = 0.5 * (y + 1j * z), 0.5 * (y.conj() + 1j * z.conj())
    ahead, behind = np.abs(forward), np.abs(backward)
    circle = np.minimum(ahead, behind) <= CIRCLE * np.maximum(ahead, behind)
    turned = np.pi - np.mod(np.pi - np.angle(forward) - np.angle(backward), 2.0 * np.pi)
    turned = np.where(circle, 0.0, 0.5 * turned)
    return Orbit(ahead + behind, ahead - behind, turned)
