"""The axial arrangement of the MFW 2310, equation by equation (Noël 2013, chapter III).

    F − Fx1 + Fx2 + Fx3 = 0;  P2 − Kp2 up2 − Fx3 = 0;  P1 − Kp1 up1 − Fx2 = 0
    δx1 = u + δx1,0;  δx2 = up1 − (u + uO2) + δx2,0;  δx3 = up2 − (u + uO3) + δx3,0

Positions 1 and 3 are tandems. The unknowns are the loads Fx2 and Fx3: bearings are solved for the
deflection under a load, where the product asks for the load under a deflection.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import root

Deflection = Callable[[int, float, float, float], float]


@dataclass(frozen=True)
class Arrangement2310:
    """Phase 6 of the thesis, table 3.7 [SI]; growths and shifts are those at ``top`` [rad/s].

    ``deflection(position, load, speed, growth)`` of one bearing at position 1, 2 or 3.
    """

    deflection: Deflection
    preload: tuple[float, float] = (574.0, 528.0)
    stiffness: tuple[float, float] = (6.20e6, 5.49e6)
    travel: float = 52.2e-6
    static_growth: float = 43.2e-6
    growth: float = 7.3e-6
    shift: tuple[float, float] = (-0.305e-6, -42.8e-6)
    top: float = 24000.0 * np.pi / 30.0

    def solve(self, speed: float, force: float = 0.0, *, closed: bool = False) -> Found:
        """Loads and shifts at ``speed``; ``closed``: the front sleeve is at its stop."""
        p1, p2 = self.preload
        rest = [self._one(1, (p1 + p2) / 2, 0.0), self._one(2, p1, 0.0), self._one(3, p2 / 2, 0.0)]

        def parts(unknown: np.ndarray) -> tuple[float, float, float, float, float]:
            f2, f3 = unknown * 100.0
            u = self._one(1, (force + f2 + f3) / 2, speed) - rest[0]
            up1 = -self.travel if closed else (p1 - f2) / self.stiffness[0]
            return f2, f3, u, up1, (p2 - f3) / self.stiffness[1]

        def fault(unknown: np.ndarray) -> list[float]:
            f2, f3, u, up1, up2 = parts(unknown)
            o2, o3 = (s * (speed / self.top) ** 2 for s in self.shift)
            second = self._one(2, f2, speed) - rest[1] - (up1 - u - o2)
            third = self._one(3, f3 / 2, speed) - rest[2] - (up2 - u - o3)
            return [second * 1e6, third * 1e6]

        found = root(fault, np.array([p1, p2]) / 100.0, tol=1e-12)
        assert np.abs(found.fun).max() < 1e-7, found.message
        f2, f3, u, up1, up2 = parts(found.x)
        loads = np.array([(force + f2 + f3) / 2, f2, f3 / 2])
        return Found(loads, np.array([u, up1, up2]), p1 - self.stiffness[0] * up1 - f2)

    def _one(self, position: int, load: float, speed: float) -> float:
        growth = self.static_growth + self.growth * (speed / self.top) ** 2
        return self.deflection(position, load, speed, growth)


@dataclass(frozen=True)
class Found:
    """``load`` of one bearing at positions 1, 2, 3 [N]; ``shift`` u, up1, up2 [m]; ``stop`` [N]."""

    load: np.ndarray
    shift: np.ndarray
    stop: float
