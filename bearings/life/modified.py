"""Modified life: reliability, lubricant and cleanness, spectra and sets (ISO 281) [M].

L_nm = a1 a_ISO L10. Formulas of a1, a_ISO, ν1 and Cu are those of the standard from memory; SKF's
newer charts of ν1 read 0.83 to 0.85 of these.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from bearings.arguments import checked
from bearings.arrays import Array
from bearings.errors import InvalidBearing, shown
from bearings.life.rating import WEIBULL_SLOPE

LOWEST_KAPPA, HIGHEST_KAPPA = 0.1, 4.0
MOST = 50.0  # largest a_ISO
_RELIABILITY = {0.90: 1.0, 0.95: 0.64, 0.96: 0.55, 0.97: 0.47, 0.98: 0.37, 0.99: 0.25}
HOTTEST = 300.0  # °C, up to which factors on C are tabulated
_HOT = ((150.0, 1.0), (200.0, 0.73), (250.0, 0.42), (HOTTEST, 0.22))  # °C, factor on C
# a_ISO: largest κ of each range, and the number and the exponent of its formula
_KAPPA = ((0.4, 2.2649, 0.054381), (1.0, 1.9987, 0.19087), (HIGHEST_KAPPA, 1.9987, 0.071739))
_STATIC_PER_LIMIT = 22.0  # C0/Cu of ball bearings


@checked
def reliability_factor(reliability: float) -> float:
    """a1 of 90, 95, 96, 97, 98 or 99 % (ISO 281:2007; GMN prints the same).

    Raises
    ------
    InvalidBearing : another reliability
    """
    key = round(reliability, 6)
    if key not in _RELIABILITY:
        listing = ", ".join(f"{100 * r:g} %" for r in _RELIABILITY)
        raise InvalidBearing(f"a1 is tabulated for {listing}: got {100 * reliability:g} %")
    return _RELIABILITY[key]


@checked
def temperature_factor(celsius: ArrayLike) -> Array:
    """Factor on C at a bearing temperature [°C], from 1 at 150 to 0.22 at 300 °C.

    Raises
    ------
    InvalidBearing : hotter, or no number
    """
    hot = np.asarray(celsius, float)
    if not (hot <= HOTTEST).all():
        raise InvalidBearing(f"ratings are tabulated up to {HOTTEST:g} °C, got {hot.max():g} °C")
    return np.asarray(np.interp(hot, [t for t, _ in _HOT], [factor for _, factor in _HOT]))


@checked
def reference_viscosity(speed: ArrayLike, pitch_diameter: float) -> Array:
    """Viscosity ν1 [m²/s] that a bearing needs at ``speed`` [rad/s]; infinite at rest.

    45000 n^−0.83 dm^−0.5 below 1000 rpm, 4500 (n dm)^−0.5 above, mm²/s of rpm and mm.
    """
    rpm, size = np.abs(np.asarray(speed, float)) * 30.0 / math.pi, pitch_diameter * 1e3
    with np.errstate(divide="ignore"):
        slow = 45000.0 * rpm**-0.83 * size**-0.5
        return np.asarray(1e-6 * np.where(rpm < 1000.0, slow, 4500.0 * (rpm * size) ** -0.5))


@checked
def viscosity_ratio(viscosity: ArrayLike, speed: ArrayLike, pitch_diameter: float) -> Array:
    """κ = ν/ν1 of a kinematic ``viscosity`` [m²/s] at work; 0 at rest."""
    return np.asarray(np.asarray(viscosity, float) / reference_viscosity(speed, pitch_diameter))


@checked
def fatigue_load_limit(static_rating: float, pitch_diameter: float) -> float:
    """Cu of a ball bearing [N]: C0/22, above a pitch diameter of 100 mm times (0.1/dm)^0.5."""
    size = 1.0 if pitch_diameter <= 0.1 else math.sqrt(0.1 / pitch_diameter)
    return static_rating / _STATIC_PER_LIMIT * size


@checked
def life_factor(kappa: ArrayLike, contamination: float, limit: float, load: ArrayLike) -> Array:
    """a_ISO of a radial ball bearing, at most 50; NaN below κ = 0.1, where it is not defined.

    Thrust bearings, those of contact angles above 45°, have another one.

    Parameters
    ----------
    kappa : viscosity ratio, limited to 4
    contamination : eC, from 0 (heavy) to 1 (extreme cleanness)
    limit, load : fatigue load limit Cu and equivalent load P [N]

    Raises
    ------
    InvalidBearing : a contamination factor outside 0 to 1
    """
    if not 0.0 <= contamination <= 1.0:
        raise InvalidBearing(
            f"the contamination factor eC lies from 0 to 1, got {shown(contamination)}"
        )
    k, p = np.broadcast_arrays(np.asarray(kappa, float), np.asarray(load, float))
    clipped = np.clip(k, LOWEST_KAPPA, HIGHEST_KAPPA)
    first = np.where(clipped < _KAPPA[0][0], 0, np.where(clipped < _KAPPA[1][0], 1, 2))
    table = np.array(_KAPPA)
    front = 2.5671 - table[first, 1] * clipped ** -table[first, 2]
    with np.errstate(divide="ignore", invalid="ignore"):
        x = front**0.83 * np.cbrt(contamination * limit / p)
        inside = np.minimum(x, 1.0 - 1e-9)
        factor = np.minimum(0.1 * (1.0 - inside) ** -9.3, MOST)
    defined = (k >= LOWEST_KAPPA) & ~np.isnan(x)
    return np.asarray(np.where(defined, factor, np.nan))


@checked
def mean_life(share: ArrayLike, life: ArrayLike, axis: int = 0) -> Array:
    """Life under a spectrum of loads, 1/Σ(q/L) along ``axis``; Palmgren and Miner.

    ``share`` q of every load: of REVOLUTIONS where ``life`` is in revolutions, of TIME where it is
    in hours; they are scaled to a sum of 1. One share for each life along ``axis``, or an array
    that broadcasts to the lives.

    Raises
    ------
    InvalidBearing : a share below 0, or none above; a life below 0
    """
    lives, q = np.asarray(life, float), np.asarray(share, float)
    q = np.moveaxis(q, axis, -1) if q.ndim == lives.ndim else q
    q, lives = np.broadcast_arrays(q, np.moveaxis(lives, axis, -1))
    if (q < 0.0).any() or not (q.sum(axis=-1) > 0.0).all():
        raise InvalidBearing(f"shares of a load spectrum: from 0 up, not all 0: got {shown(share)}")
    if (lives < 0.0).any():
        raise InvalidBearing(f"lives must not be negative, got {shown(life)}")
    with np.errstate(divide="ignore"):
        return np.asarray(q.sum(axis=-1) / (q / lives).sum(axis=-1))


@checked
def set_life(life: ArrayLike, axis: int = -1) -> Array:
    """Life until the first bearing of a set fails, (Σ L^(−10/9))^(−9/10) along ``axis``.

    ``life``: of bearings at one speed, all in revolutions or all in time.
    """
    with np.errstate(divide="ignore"):
        failures = (np.asarray(life, float) ** -WEIBULL_SLOPE).sum(axis=axis)
        return np.asarray(failures ** (-1.0 / WEIBULL_SLOPE))
