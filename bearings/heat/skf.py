"""SKF's friction moment of single-row angular-contact ball bearings (catalogue 6000).

Made for bearings 72 B and 73 B at catalogue speeds; at spindle speeds it gives several times the
loss, and above n·dm of 0.8 million it is refused.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from bearings.arguments import checked
from bearings.arrays import Array
from bearings.errors import InvalidBearing, shown
from bearings.lubricant import THICKEST

LARGEST = 5.0  # outside diameter [m]
FASTEST = 0.8e6  # n·dm [rpm·mm]
REPLENISHMENT = {"bath": 0.0, "low bath": 3e-8, "jet": 3e-8, "grease": 6e-8, "oil-air": 6e-8}
# SKF's geometry constants of rolling (R), sliding (S) and starvation (KZ), bearings 72 B and 73 B
_R1, _R2, _R3 = 5.03e-7, 1.97, 1.90e-12
_S1, _S2, _S3 = 1.30e-2, 0.68, 1.91e-12
_KZ = 4.4
_HYBRID = 0.41  # centrifugal force of ceramic balls over that of steel balls
_BOUNDARY = 0.15  # μbl; later catalogues have 0.12


class SkfMoment(NamedTuple):
    """Moments of SKF's model [N·m], shape (…): rolling with its factors, sliding; no seals and no
    drag of an oil bath. ``inlet`` φish, ``starved`` φrs: factors of inlet shear and starvation."""

    rolling: Array
    sliding: Array
    inlet: Array
    starved: Array

    @property
    def total(self) -> Array:
        """Rolling and sliding moment together [N·m]."""
        return self.rolling + self.sliding


def inlet_shear(speed: ArrayLike, pitch_diameter: float, viscosity: ArrayLike) -> Array:
    """φish = 1/(1 + 1.84e-9 (n dm)^1.28 ν^0.64), n in rpm, dm in mm, ν in mm²/s."""
    n, nu = _rpm(speed), np.asarray(viscosity, float) * 1e6
    return np.asarray(1.0 / (1.0 + 1.84e-9 * (n * pitch_diameter * 1e3) ** 1.28 * nu**0.64))


def starvation(
    speed: ArrayLike,
    viscosity: ArrayLike,
    bore: float,
    outside: float,
    supply: str,
    geometry: float = _KZ,
) -> Array:
    """φrs = exp(−Krs ν n (d + D) (KZ/(2 (D − d)))^0.5); ``supply`` a word of ``REPLENISHMENT``."""
    if supply not in REPLENISHMENT:
        raise InvalidBearing(f"unknown supply {shown(supply)}: {', '.join(REPLENISHMENT)}")
    flow = _rpm(speed) * np.asarray(viscosity, float) * 1e6 * (bore + outside) * 1e3
    shape = np.sqrt(geometry / (2.0 * (outside - bore) * 1e3))
    return np.asarray(np.exp(-REPLENISHMENT[supply] * flow * shape))


def rolling_moment(factor: ArrayLike, viscosity: ArrayLike, speed: ArrayLike) -> Array:
    """Mrr = Grr (ν n)^0.6 [N·m] of SKF's variable Grr [N·mm]."""
    product = np.asarray(viscosity, float) * 1e6 * _rpm(speed)
    return np.asarray(1e-3 * np.asarray(factor, float) * product**0.6)


def sliding_moment(
    factor: ArrayLike,
    viscosity: ArrayLike,
    speed: ArrayLike,
    pitch_diameter: float,
    ehl_friction: float,
) -> Array:
    """Msl = Gsl (φbl μbl + (1 − φbl) μEHL) [N·m] of SKF's variable Gsl [N·mm]; φbl is the share of
    boundary lubrication, exp(−2.6e-8 (n ν)^1.4 dm)."""
    product = np.asarray(viscosity, float) * 1e6 * _rpm(speed)
    boundary = np.exp(-2.6e-8 * product**1.4 * pitch_diameter * 1e3)
    friction = boundary * _BOUNDARY + (1.0 - boundary) * ehl_friction
    return np.asarray(1e-3 * np.asarray(factor, float) * friction)


@checked
def skf_moment(
    *,
    radial: ArrayLike,
    axial: ArrayLike,
    speed: ArrayLike,
    viscosity: ArrayLike,
    bore: float,
    outside: float,
    supply: str = "oil-air",
    hybrid: bool = False,
    ehl_friction: float = 0.05,
) -> SkfMoment:
    """Friction moment of a single-row angular-contact ball bearing.

    Parameters
    ----------
    radial, axial : loads [N]
    speed : [rad/s]
    viscosity : kinematic, at work [m²/s]
    bore, outside : diameters d, D [m]
    supply : a word of ``REPLENISHMENT``
    hybrid : balls of silicon nitride
    ehl_friction : of the full film, 0.05 of mineral and 0.04 of synthetic oil

    Raises
    ------
    InvalidBearing : n·dm above 0.8 million, an unknown supply, sizes, viscosity or friction that
        no bearing has, a load or a speed that is not finite
    """
    _refuse(
        {"speed": speed, "radial": radial, "axial": axial}, viscosity, bore, outside, ehl_friction
    )
    n, pitch = _rpm(speed), 0.5 * (bore + outside) * 1e3
    fastest = float(np.max(n)) * pitch
    if fastest > FASTEST:
        raise InvalidBearing(
            f"SKF's friction model is valid up to n·dm {FASTEST:.2g} mm/min, got {fastest:.3g}: "
            "take Palmgren's moment or the sliding in the contact ellipses"
        )
    fr, fa = np.abs(np.asarray(radial, float)), np.abs(np.asarray(axial, float))
    centrifugal = (_HYBRID if hybrid else 1.0) * pitch**4 * n**2
    grr = _R1 * pitch**1.97 * (fr + _R3 * centrifugal + _R2 * fa) ** 0.54
    gsl = _S1 * pitch**0.26 * ((fr + _S3 * centrifugal) ** (4.0 / 3.0) + _S2 * fa ** (4.0 / 3.0))
    inlet = inlet_shear(speed, 0.5 * (bore + outside), viscosity)
    starved = starvation(speed, viscosity, bore, outside, supply)
    rolling = inlet * starved * rolling_moment(grr, viscosity, speed)
    sliding = sliding_moment(gsl, viscosity, speed, 0.5 * (bore + outside), ehl_friction)
    turning = np.where(n > 0.0, 1.0, 0.0)
    return SkfMoment(turning * rolling, turning * sliding, inlet, starved)


def _refuse(
    numbers: dict[str, ArrayLike],
    viscosity: ArrayLike,
    bore: float,
    outside: float,
    friction: float,
) -> None:
    """Raise InvalidBearing for values that no bearing and no oil has."""
    for name, value in numbers.items():
        if not np.isfinite(np.asarray(value, float)).all():
            raise InvalidBearing(f"{name} must be finite, got {shown(value)}")
    nu = np.asarray(viscosity, float)
    if not ((nu >= 0.0) & (nu < THICKEST)).all():
        raise InvalidBearing(
            f"viscosity must be from 0 to below {THICKEST:g} m²/s, got {shown(viscosity)}: is the "
            "unit right?"
        )
    if not 0.0 < bore < outside < LARGEST:
        raise InvalidBearing(
            f"bore and outside: allowed 0 < bore < outside < {LARGEST:g} m, got {bore:g} and "
            f"{outside:g} m"
        )
    if not 0.0 <= friction <= 1.0:
        raise InvalidBearing(f"ehl_friction must be from 0 to 1, got {friction:g}")


def _rpm(speed: ArrayLike) -> Array:
    return np.asarray(np.abs(np.asarray(speed, float)) * 30.0 / np.pi)
