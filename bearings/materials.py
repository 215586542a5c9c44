"""Isotropic elastic materials."""

from __future__ import annotations

from dataclasses import dataclass

from bearings.errors import InvalidBearing
from bearings.measure import Measure, measured, refusals

NAME = Measure("text", "name as printed", kind=str)
YOUNG_MODULUS = Measure("pressure", "E", 1e9, 2e12, unit="GPa")
POISSON_RATIO = Measure("number", "ν", -1.0, 0.5, open_low=True, open_high=True)
DENSITY = Measure("density", "ρ", 100.0, 30000.0, unit="kg/m^3")
EXPANSION = Measure(
    "thermal expansion",
    "linear, α; by default that of steel, 1.15e-5 1/K",
    -1e-4,
    1e-3,
    unit="1/K",
)
OF_STEEL = 11.5e-6  # [1/K], thermal expansion of bearing steel


@dataclass(frozen=True, slots=True)
class Material:
    """An isotropic elastic material.

    Parameters
    ----------
    name : shown in tables
    young_modulus : E [Pa], from 1 to 2000 GPa
    poisson_ratio : ν, above -1 and below 0.5
    density : ρ [kg/m³], from 100 to 30 000
    thermal_expansion : linear, α [1/K], from -1e-4 to 1e-3; None where it is not known

    Raises
    ------
    InvalidBearing : a value is not finite or out of its range
    """

    name: str = measured(NAME)
    young_modulus: float = measured(YOUNG_MODULUS)
    poisson_ratio: float = measured(POISSON_RATIO)
    density: float = measured(DENSITY)
    thermal_expansion: float | None = measured(EXPANSION, None)

    def __post_init__(self) -> None:
        for why in refusals(self):
            raise InvalidBearing(f"material {str(self.name)[:60]}: {why}")

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
