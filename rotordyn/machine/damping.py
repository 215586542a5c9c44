"""Damping of the rotor in proportion to its mass and its stiffness."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description
from rotordyn.quantity import MassDamping, StiffnessDamping


@dataclass(frozen=True, slots=True)
class RayleighDamping(Description):
    """Damping α M + β K of the rotor alone."""

    mass: Annotated[MassDamping, "α, by which the mass matrix of the rotor is multiplied"] = 0.0
    stiffness: Annotated[StiffnessDamping, "β, by which its stiffness matrix is multiplied"] = 0.0

    def __bool__(self) -> bool:
        return bool(self.mass or self.stiffness)
