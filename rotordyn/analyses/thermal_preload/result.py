"""Preload over temperature difference."""

from __future__ import annotations

from dataclasses import dataclass

from rotordyn.results.declaration import coordinate, quantity
from rotordyn.results.kinds import Array, Words

OVER = ("speed", "difference", "bearing")


@dataclass(frozen=True)
class ThermalPreloadResult:
    """Axial load and ring growth of every bearing; NaN where there is no usable state."""

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    difference: Array = coordinate("difference", unit="K", label="temperature difference")
    bearing: Words = coordinate("bearing", unit="", label="bearing")
    outcome: Words = quantity("speed", unit="", label="outcome")
    axial_load: Array = quantity(*OVER, unit="N", label="axial load")
    growth: Array = quantity(*OVER, unit="m", label="ring growth")
