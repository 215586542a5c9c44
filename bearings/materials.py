"""Isotropic elastic materials."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NoReturn

from bearings.arguments import finite
from bearings.errors import InvalidBearing, shown

RANGES = {"young_modulus": (1.0, 1e20), "density": (1e-12, 1e12)}  # [Pa], [kg/m³]
LARGEST_EXPANSION = 1e-3  # [1/K], either way
OF_STEEL = 11.5e-6  # [1/K], thermal expansion of bearing steel


@dataclass(frozen=True, slots=True)
class Material:
    """An isotropic elastic material.

    Parameters
    ----------
    name : shown in tables
    young_modulus : E [Pa], from 1 to 1e20
    poisson_ratio : ν, above -1 and below 0.5
    density : ρ [kg/m³], from 1e-12 to 1e12
    thermal_expansion : linear, α [1/K]; None where it is not known

    Raises
    ------
    InvalidBearing : a value is not finite or out of its range
    """

    name: str
    young_modulus: float
    poisson_ratio: float
    density: float
    thermal_expansion: float | None = None

    def __post_init__(self) -> None:
        for key in ("young_modulus", "density", "poisson_ratio", "thermal_expansion"):
            unknown = key == "thermal_expansion" and self.thermal_expansion is None
            if not (unknown or finite(getattr(self, key))):
                self._refuse(key, "be a number")
        for key, (low, high) in RANGES.items():
            value = getattr(self, key)
            if value <= 0.0:
                self._refuse(key, "be positive")
            if not low <= value <= high:
                self._refuse(key, f"lie between {low:g} and {high:g}")
        if not -1.0 < self.poisson_ratio < 0.5:
            self._refuse("poisson_ratio", "lie between -1 and 0.5")
        if abs(self.expansion) > LARGEST_EXPANSION:
            self._refuse("thermal_expansion", f"lie within ±{LARGEST_EXPANSION:g}")

    def _refuse(self, key: str, rule: str) -> NoReturn:
        raise InvalidBearing(
            f"material {str(self.name)[:60]}: {key} must {rule}, got {shown(getattr(self, key))}"
        )

    @property
    def expansion(self) -> float:
        """α [1/K], that of steel where it is not known."""
        return OF_STEEL if self.thermal_expansion is None else self.thermal_expansion

    @property
    def shear_modulus(self) -> float:
        """G = E / (2 (1 + ν)) [Pa]."""
        return self.young_modulus / (2.0 * (1.0 + self.poisson_ratio))

    @property
    def contact_compliance(self) -> float:
        """(1 − ν²) / E, the share of this body in a Hertzian contact [1/Pa]."""
        return (1.0 - self.poisson_ratio**2) / self.young_modulus


STEEL = Material("bearing steel", 206e9, 0.3, 7800.0, OF_STEEL)
SILICON_NITRIDE = Material("silicon nitride", 315e9, 0.26, 3190.0, 3.2e-6)
