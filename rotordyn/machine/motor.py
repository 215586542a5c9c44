"""The motor that drives the spindle: what it gives at a speed."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from rotordyn.arrays import Array
from rotordyn.description import Description, Faults
from rotordyn.quantity import Quantity

Power = Annotated[float, Quantity("power", above="0 W", at_most="10 MW")]
Torque = Annotated[float, Quantity("moment", above="0 N m", at_most="100 kN m")]


@dataclass(frozen=True, slots=True)
class Motor(Description):
    """Its rated power, its rated torque or both, of which the lesser counts at a speed."""

    power: Annotated[Power | None, "rated power, of the duty that is planned (S1: without end)"] = (
        None
    )
    torque: Annotated[
        Torque | None, "rated torque at the shaft, up to the speed at which it is the power"
    ] = None

    def _faults(self) -> Faults:
        if self.power is None and self.torque is None:
            yield (), "missing key: power, torque or both"

    def torque_at(self, speed: Array) -> Array:
        """Torque that it gives at speeds [rad/s] (s,) above 0: (s,) [N m]."""
        most = math.inf if self.torque is None else self.torque
        if self.power is None:
            return np.full_like(speed, most)
        return np.minimum(most, self.power / speed)

    @property
    def words(self) -> str:
        """What it is rated for."""
        given = [] if self.power is None else [f"{self.power / 1e3:.4g} kW"]
        return ", ".join(given if self.torque is None else [*given, f"{self.torque:.4g} N m"])
