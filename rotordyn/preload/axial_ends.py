"""A bearing's load along its axis: where it begins and turns, and where its points are too few."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from bearings.bearing import BallBearing
from bearings.geometry import geometry, groove_origin
from rotordyn.arrays import Array
from rotordyn.errors import NoSolution

MISSED, FLAT = 1e-2, 1e-4  # of a slope, and of the largest, by which cubic pieces may miss it
INSIDE = np.arange(1.0, 8.0) / 8.0  # of a piece, further points


def begins(model: BallBearing, static_growth: ArrayLike, growth: ArrayLike) -> Array:
    """Deflection [m] at which balls without inertia are loaded; growth [m]: static, and all of it.

    Where growth leaves no contact angle it says nothing: free distance or 0.
    """
    axial, radial = _origin(model, static_growth, growth)
    return np.sqrt(np.maximum(model.free_distance**2 - radial**2, 0.0)) - axial


def turns(model: BallBearing, static_growth: ArrayLike) -> Array:
    """Deflection [m] at which contact angles vanish; −∞ where thrust is taken both ways.

    Below it balls would press against the side that takes no thrust.
    """
    axial, _ = _origin(model, static_growth, static_growth)
    return np.full_like(axial, -np.inf) if model.both_ways else -axial


def missed(d: Array, load: Array, slope: Array) -> Array:
    """Deflections [m] between points of a law, loads [N] and slopes [N/m], next to those that cubic
    pieces through the others miss."""
    from scipy.interpolate import CubicHermiteSpline

    bent = np.zeros(len(d), dtype=bool)
    for k in (0, 1) if len(d) > 4 else ():
        kept, left = slice(k, None, 2), slice(1 - k, None, 2)
        through = CubicHermiteSpline(d[kept], load[kept], slope[kept])(d[left], 1)
        bent[left] = np.abs(through - slope[left]) > MISSED * slope[left] + FLAT * slope.max()
    bent[[0, -1]] = False
    between = bent[1:] | bent[:-1]
    return (d[:-1, None] + np.diff(d)[:, None] * INSIDE)[between].ravel()


def without_state(which: str, speed: float, growth: float) -> NoSolution:
    """That a bearing has no axial state at a speed [rad/s], its grooves grown [m]."""
    return NoSolution(
        f"{which} at {speed * 30.0 / np.pi:.6g} rpm, groove growth {growth * 1e6:.4g} µm: "
        "it has no axial state at any deflection; lower the speed or the growth"
    )


def _origin(model: BallBearing, *growth: ArrayLike) -> Array:
    return np.nan_to_num(groove_origin(geometry(model.grooves), *map(np.asarray, growth)))
