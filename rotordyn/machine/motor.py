"""The motor that drives the spindle, and its torque at a speed."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description, Faults
from rotordyn.quantity import Quantity

Power = Annotated[float, Quantity("power", above="0 W", at_most="10 MW")]
Torque = Annotated[float, Quantity("moment", above="0 N m", at_most="100 kN m")]


@dataclass(frozen=True, slots=True)
class Motor(Description):
    """Its rated power, its rated torque or both: it gives the lesser of that torque and the power
    over the speed."""

    power: Annotated[Power | None, "rated power, for the intended duty (S1: continuous)"] = None
    torque: Annotated[Torque | None, "rated torque at the shaft"] = None

    def _faults(self) -> Faults:
        if self.power is None and self.torque is None:
            yield (), "missing key: power, torque or both"

    def torque_at(self, speed: float) -> float:
        """Return the torque at a speed [rad/s] above 0 [N m]."""
        of_power = math.inf if self.power is None else self.power / speed
        return of_power if self.torque is None else min(self.torque, of_power)

    @property
    def words(self) -> str:
        """Rated values as text."""
        ratings = [] if self.power is None else [f"{self.power / 1e3:.4g} kW"]
        return ", ".join(ratings if self.torque is None else [*ratings, f"{self.torque:.4g} N m"])
