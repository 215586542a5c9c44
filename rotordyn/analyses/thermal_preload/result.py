"""Preload over temperature difference."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Words
from rotordyn.results.declaration import coordinate, quantity

OVER = ("speed", "difference", "bearing")


@dataclass(frozen=True)
class ThermalPreloadResult:
    """Axial load and ring growth of every bearing; NaN where ``state`` says why."""

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    difference: Array = coordinate("difference", unit="K", label="temperature difference")
    bearing: Words = coordinate("bearing", unit="", label="bearing")
    outcome: Words = quantity("speed", unit="", label="outcome")
    state: NDArray[np.str_] = quantity("speed", "difference", unit="", label="state")
    axial_load: Array = quantity(*OVER, unit="N", label="axial load")
    growth: Array = quantity(*OVER, unit="m", label="ring growth")
