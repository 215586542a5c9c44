"""Damping of the rotor in proportion to its mass and its stiffness."""

from __future__ import annotations

from dataclasses import dataclass

from rotordyn.description import Description
from rotordyn.quantity import MassDamping, StiffnessDamping


@dataclass(frozen=True, slots=True)
class RayleighDamping(Description):
    """C = α M + β K of the rotor alone: ``mass`` α [1/s], ``stiffness`` β [s]."""

    mass: MassDamping = 0.0
    stiffness: StiffnessDamping = 0.0

    def __bool__(self) -> bool:
        return bool(self.mass or self.stiffness)
