"""Range of modes and critical speeds to compute."""

from __future__ import annotations

import math
from typing import NamedTuple


class Band(NamedTuple):
    """Modes up to ``max_frequency`` [Hz], critical speeds of ``engine_orders``."""

    max_frequency: float
    engine_orders: tuple[float, ...] = (1.0,)

    @property
    def highest(self) -> float:
        """Highest angular frequency [rad/s]."""
        return 2.0 * math.pi * self.max_frequency
