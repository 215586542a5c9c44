"""Isotropic elastic materials."""

from __future__ import annotations

import math
from dataclasses import dataclass
from numbers import Real

from bearings.errors import InvalidBearing

RANGES = {"young_modulus": (1.0, 1e20), "density": (1e-12, 1e12)}  # [Pa], [kg/m³]
LARGEST_EXPANSION = 1e-3  # [1/K], either way


@dataclass(frozen=True, slots=True)
class Material:
    """An isotropic elastic material.

    Parameters
    ----------
    name : shown in tables
    young_modulus : E [Pa], from 1 to 1e20
    poisson_ratio : ν, above -1 and below 0.5
    density : ρ [kg/m³], from 1e-12 to 1e12
    thermal_expansion : linear, α [1/K], that of steel by default

    Raises
    ------
    InvalidBearing : a value is not finite or out of its range
    """

    name: str
    young_modulus: float
    poisson_ratio: float
    density: float
    thermal_expansion: float = 11.5e-6

    def __post_init__(self) -> None:
        for key in ("young_modulus", "density", "poisson_ratio", "thermal_expansion"):
            value = getattr(self, key)
            if isinstance(value, bool) or not isinstance(value, Real) or not math.isfinite(value):
                raise InvalidBearing(f"material {self.name}: {key} must be a number, got {value!r}")
        for key, (low, high) in RANGES.items():
            value = getattr(self, key)
            if value <= 0.0:
                raise InvalidBearing(f"material {self.name}: {key} must be positive, got {value!r}")
            if not low <= value <= high:
                raise InvalidBearing(
                    f"material {self.name}: {key} must lie between {low:g} and {high:g}, "
                    f"got {value!r}"
                )
        if not -1.0 < self.poisson_ratio < 0.5:
            raise InvalidBearing(
                f"material {self.name}: poisson_ratio must lie between -1 and 0.5, "
                f"got {self.poisson_ratio!r}"
            )

        if abs(self.thermal_expansion) > LARGEST_EXPANSION:
            raise InvalidBearing(
                f"material {self.name}: thermal_expansion must lie within "
                f"±{LARGEST_EXPANSION:g}, got {self.thermal_expansion!r}"
            )

    @property
    def shear_modulus(self) -> float:
        """G = E / (2 (1 + ν)) [Pa]."""
        return self.young_modulus / (2.0 * (1.0 + self.poisson_ratio))

    @property
    def contact_compliance(self) -> float:
        """(1 − ν²) / E, the share of this body in a Hertzian contact [1/Pa]."""
        return (1.0 - self.poisson_ratio**2) / self.young_modulus


STEEL = Material("bearing steel", 206e9, 0.3, 7800.0)
SILICON_NITRIDE = Material("silicon nitride", 315e9, 0.26, 3190.0, 3.2e-6)
