"""How bearings are lubricated, for analyses of their heat, films and life (SI; °C)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from rotordyn.description import Description, Faults, known
from rotordyn.quantity import (
    Choice,
    Cleanness,
    OilViscosity,
    Roughness,
    SlidingFriction,
    Temperature,
)

if TYPE_CHECKING:
    from bearings.arrays import Array
    from bearings.lubricant import Lubricant

SUPPLIES = ("oil-air", "mist", "grease", "bath", "jet")  # f0 in bearings.heat.OIL_FACTORS
THICKEST = 0.1  # m²/s, kinematic
ELLIPSE = "ellipse"
LOSS_MODELS = (ELLIPSE, "palmgren")


@dataclass(frozen=True, slots=True)
class Lubrication(Description):
    """The oil of the bearings, or the base oil of their grease."""

    viscosity_40: Annotated[OilViscosity, "kinematic, at 40 °C"]
    viscosity_100: Annotated[OilViscosity, "kinematic, at 100 °C"]
    temperature: Annotated[Temperature, "temperature of the oil in the bearings"]
    supply: Annotated[str, Choice(SUPPLIES), "oil supply, for the viscous loss"] = "oil-air"
    contamination: Annotated[
        Cleanness, "factor eC of ISO 281: 1 extreme cleanness, 0.5 slight contamination, 0 severe"
    ] = 0.5
    friction: Annotated[
        SlidingFriction, "coefficient μ of the lubricated contacts, 0.03 to 0.07 in traction"
    ] = 0.05
    ball_roughness: Annotated[Roughness, "Rq of the balls"] = 0.02e-6
    race_roughness: Annotated[Roughness, "Rq of the raceways"] = 0.06e-6

    def _faults(self) -> Faults:
        if self.viscosity_100 >= self.viscosity_40:
            yield (
                ("viscosity_100",),
                "not below viscosity_40: given {given}; allowed: below {given:viscosity_40}",
            )
        elif known(self.viscosity_100) and known(self.viscosity_40) and known(self.temperature):
            viscosity = float(self.oil.kinematic(self.temperature))
            if viscosity > THICKEST:
                yield (
                    ("temperature",),
                    f"at {{given}} this oil does not flow, by its {viscosity * 1e6:.3g} mm²/s: "
                    f"allowed: a temperature at which it has up to {THICKEST * 1e6:.6g} mm²/s",
                )

    @property
    def oil(self) -> Lubricant:
        """The oil as ``bearings`` takes it."""
        from bearings.lubricant import Lubricant

        return Lubricant(self.viscosity_40, self.viscosity_100)


def hot_rating(celsius: Array) -> Array:
    """Return the factor on C at bearing temperatures [°C] (…): 1 where unknown (NaN), above 300 °C
    that of 300 °C."""
    import numpy as np

    from bearings.life import HOTTEST, temperature_factor

    return temperature_factor(np.minimum(np.where(np.isnan(celsius), -np.inf, celsius), HOTTEST))
