"""A lubricating oil: viscosity over temperature, and the properties that films depend on."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike

from bearings.arguments import check_fields, checked
from bearings.arrays import Array
from bearings.errors import InvalidBearing, shown

KELVIN = 273.15
THICKEST = 0.1  # m²/s at 40 °C; the thickest gear oils have 0.0032
_MOST_DECADES = 50.0  # of ν + 0.7 [mm²/s]; colder, the line of ASTM D341 soon overflows
_SHIFT = 0.7  # mm²/s, of ASTM D341


@dataclass(frozen=True, slots=True)
class Lubricant:
    """An oil, or the base oil of a grease.

    Parameters
    ----------
    viscosity_40, viscosity_100 : kinematic, at 40 and 100 °C [m²/s]
    density : [kg/m³]
    pressure_viscosity : α_p, of the film [1/Pa]; about 2e-8 of mineral oils
    conductivity : of heat [W/(m·K)]

    Raises
    ------
    InvalidBearing : values that are not positive, viscosity that does not fall with temperature
    """

    viscosity_40: float
    viscosity_100: float
    density: float = 870.0
    pressure_viscosity: float = 2.0e-8
    conductivity: float = 0.14

    def __post_init__(self) -> None:
        check_fields(self)
        for item in fields(self):
            value = getattr(self, item.name)
            if not (math.isfinite(value) and value > 0.0):
                raise InvalidBearing(f"lubricant: {item.name} must be positive, got {shown(value)}")
        if not self.viscosity_100 < self.viscosity_40:
            raise InvalidBearing(
                f"lubricant: viscosity_100 {self.viscosity_100 * 1e6:g} mm²/s must be below "
                f"viscosity_40, {self.viscosity_40 * 1e6:g} mm²/s: are the two swapped?"
            )
        if self.viscosity_40 > THICKEST:
            raise InvalidBearing(
                f"lubricant: viscosity_40 must be up to {THICKEST:g} m²/s, got "
                f"{self.viscosity_40:g} m²/s: is the unit right?"
            )
        if self.viscosity_100 <= 0.5e-6:  # near 0.3 mm²/s log log(ν + 0.7) ends
            raise InvalidBearing(
                f"lubricant: viscosity_100 must be above 0.5 mm²/s, got "
                f"{self.viscosity_100 * 1e6:g} mm²/s: is the unit right?"
            )

    @checked
    def kinematic(self, celsius: ArrayLike) -> Array:
        """ν [m²/s] at a temperature [°C] after ASTM D341: log log(ν + 0.7) linear in log T."""
        slope, level = self._line()
        kelvin = np.asarray(celsius, float) + KELVIN
        coldest = 10.0 ** ((level - math.log10(_MOST_DECADES)) / slope)
        if (cold := kelvin[~(kelvin > coldest)]).size:
            raise InvalidBearing(
                f"lubricant: too cold for this oil: given {cold[0] - KELVIN:.6g} °C; allowed: "
                f"above {coldest - KELVIN:.6g} °C, below which this oil has no viscosity"
            )
        return np.asarray(1e-6 * (10.0**10.0 ** (level - slope * np.log10(kelvin)) - _SHIFT))

    @checked
    def dynamic(self, celsius: ArrayLike) -> Array:
        """η = ρ ν [Pa·s] at a temperature [°C]."""
        return np.asarray(self.density * self.kinematic(celsius))

    @checked
    def thinning(self, celsius: ArrayLike) -> Array:
        """−d ln η/dT [1/K] at a temperature [°C]."""
        step = 0.01
        low, high = (self.kinematic(np.asarray(celsius, float) + d) for d in (-step, step))
        return np.asarray(np.log(low / high) / (2.0 * step))

    def _line(self) -> tuple[float, float]:
        """Slope and level of log log(ν + 0.7) = level − slope log T, by both viscosities."""
        low, high = (
            math.log10(math.log10(v * 1e6 + _SHIFT))
            for v in (self.viscosity_40, self.viscosity_100)
        )
        t40, t100 = (math.log10(t + KELVIN) for t in (40.0, 100.0))
        slope = (low - high) / (t100 - t40)
        return slope, low + slope * t40
