"""Friction moment of a ball bearing after Palmgren, as Harris gives it [M].

An order of magnitude in spindles; the viscous part does not depend on the state of the bearing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from bearings.arguments import checked
from bearings.arrays import Array
from bearings.errors import InvalidBearing, shown
from bearings.life.equivalent import STATIC_FACTOR
from bearings.life.rating import is_thrust, nominal_angle, static_rating

if TYPE_CHECKING:
    from bearings.grooves import Grooves
    from bearings.ring.state import BearingState

# f0 of single-row angular-contact bearings by the method of lubrication.
OIL_FACTORS = {"oil-air": 1.0, "mist": 1.0, "grease": 2.0, "bath": 2.0, "jet": 4.0}
_SLOW = 2000.0  # mm²/s · rpm, below which the viscous moment is constant


@checked
def viscous_moment(
    pitch_diameter: ArrayLike, viscosity: ArrayLike, speed: ArrayLike, oil_factor: float
) -> Array:
    """M0 = 1e-7 f0 (ν n)^(2/3) dm³ [N·m], constant below ν n = 2000 (mm²/s, rpm, mm); 0 at rest.

    ``viscosity`` [m²/s], ``speed`` [rad/s]; ``oil_factor`` f0.

    Raises
    ------
    InvalidBearing : a factor that is not positive
    """
    if not oil_factor > 0.0:
        raise InvalidBearing(f"oil_factor must be positive, got {shown(oil_factor)}")
    rpm = np.abs(np.asarray(speed, float)) * 30.0 / np.pi
    product = np.asarray(viscosity, float) * 1e6 * rpm
    size = (np.asarray(pitch_diameter, float) * 1e3) ** 3
    fast = 1e-7 * oil_factor * product ** (2.0 / 3.0) * size
    slow = np.where(rpm > 0.0, 160e-7 * oil_factor * size, 0.0)
    return np.asarray(1e-3 * np.where(product >= _SLOW, fast, slow))


@checked
def load_moment(state: BearingState, rating: float | None = None) -> Array:
    """M1 = f1 P1 dm [N·m], f1 = z (P0/C0)^y, of the load on the ring (…).

    z and y: 0.001 and 0.33 of angular-contact, 0.0005 and 0.55 of deep-groove, 0.0008 and 0.33 of
    thrust bearings. ``rating``: C0 [N]; None: from the grooves. Raises InvalidBearing for a
    rating that is not positive.
    """
    grooves = state.operation.grooves
    c0 = static_rating(grooves) if rating is None else rating
    if not c0 > 0.0:
        raise InvalidBearing(f"static rating C0 must be positive, got {shown(c0)}")
    axial = np.abs(np.asarray(state.load)[..., 0])
    radial = np.hypot(state.load[..., 1], state.load[..., 2])
    z, y, equivalent, driving = _loads(grooves, axial, radial)
    return np.asarray(z * (equivalent / c0) ** y * driving * grooves.pitch_diameter)


def _loads(grooves: Grooves, axial: Array, radial: Array) -> tuple[float, float, Array, Array]:
    """z, y, the equivalent static load P0 and the load P1 that drives the moment [N]."""
    alpha = nominal_angle(grooves)
    if is_thrust(grooves):
        return 0.0008, 0.33, axial, axial
    if alpha < np.radians(5.0):
        static = np.maximum(0.6 * radial + 0.5 * axial, radial)
        return 0.0005, 0.55, static, np.maximum(3.0 * axial - 0.1 * radial, radial)
    y0 = np.interp(np.degrees(alpha), [*STATIC_FACTOR], [*STATIC_FACTOR.values()])
    static = np.maximum(0.5 * radial + y0 * axial, radial)
    return 0.001, 0.33, static, np.maximum(0.9 * axial / np.tan(alpha) - 0.1 * radial, radial)
