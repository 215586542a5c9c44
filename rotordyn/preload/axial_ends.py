"""Ends of a bearing's axial load: onset, vanishing contact angles, and where points are too few."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from bearings.bearing import BallBearing
from bearings.geometry import geometry, groove_origin
from rotordyn.arrays import Array
from rotordyn.errors import NoSolution

MISSED, FLAT = 1e-2, 1e-4  # tolerance of a cubic's slope: of the slope, and of the largest
INSIDE = np.arange(1.0, 8.0) / 8.0  # further points, as fractions of a piece


def begins(model: BallBearing, static_growth: ArrayLike, growth: ArrayLike) -> Array:
    """Return the deflection [m] at which balls without inertia begin to carry load.

    ``static_growth`` and total ``growth`` [m]; where these leave no contact angle the value has no
    meaning: free distance or 0.
    """
    axial, radial = _origin(model, static_growth, growth)
    return np.sqrt(np.maximum(model.free_distance**2 - radial**2, 0.0)) - axial


def turns(model: BallBearing, static_growth: ArrayLike) -> Array:
    """Return the deflection [m] at which contact angles vanish; −∞ where thrust is taken both ways.

    Below it balls would press against the side that takes no thrust.
    """
    axial, _ = _origin(model, static_growth, static_growth)
    return np.full_like(axial, -np.inf) if model.both_ways else -axial


def missed(d: Array, load: Array, slope: Array) -> Array:
    """Return further deflections [m] around the points whose slopes cubics through others miss.

    ``d`` [m], ``load`` [N] and ``slope`` [N/m]: the points of the law.
    """
    from scipy.interpolate import CubicHermiteSpline

    missing = np.zeros(len(d), dtype=bool)
    for k in (0, 1) if len(d) > 4 else ():
        kept, checked = slice(k, None, 2), slice(1 - k, None, 2)
        cubic = CubicHermiteSpline(d[kept], load[kept], slope[kept])(d[checked], 1)
        missing[checked] = (
            np.abs(cubic - slope[checked]) > MISSED * slope[checked] + FLAT * slope.max()
        )
    missing[[0, -1]] = False
    between = missing[1:] | missing[:-1]
    return (d[:-1, None] + np.diff(d)[:, None] * INSIDE)[between].ravel()


def without_state(which: str, speed: float, growth: float) -> NoSolution:
    """Return the error of a bearing without any axial state at a speed [rad/s] and growth [m]."""
    return NoSolution(
        f"{which} at {speed * 30.0 / np.pi:.6g} rpm, groove growth {growth * 1e6:.4g} µm: "
        "no axial equilibrium at any deflection; lower the speed or the growth"
    )


def _origin(model: BallBearing, *growth: ArrayLike) -> Array:
    return np.nan_to_num(groove_origin(geometry(model.grooves), *map(np.asarray, growth)))
