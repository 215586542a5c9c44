"""Exact whirl of a simply supported, spinning circular Timoshenko beam (Zu and Han 1992).

With u = U sin kx, φ = Φ cos kx and k = n π/L, in the inertial frame:
(ρA ω² − S k²)(−ρI ω² + 2 ρI Ω ω + E I k² + S) + S² k² = 0, S = κ G A: backward and forward whirl of
the bending spectrum and of the second one. An axial force N, tension positive, adds N k² to S k² in
the first factor. Nothing is shared with the product.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class PinnedBeam:
    """A solid beam between pins; SI."""

    length: float
    diameter: float
    young_modulus: float = 2.1e11
    poisson_ratio: float = 0.3
    density: float = 7800.0
    kappa: float = 6 * 1.3 / (7 + 6 * 0.3)
    tension: float = 0.0

    @property
    def line_mass(self) -> float:
        return self.density * math.pi * self.diameter**2 / 4

    @property
    def line_inertia(self) -> float:
        return self.density * math.pi * self.diameter**4 / 64

    @property
    def bending(self) -> float:
        return self.young_modulus * math.pi * self.diameter**4 / 64

    @property
    def shear(self) -> float:
        modulus = self.young_modulus / (2 * (1 + self.poisson_ratio))
        return self.kappa * modulus * math.pi * self.diameter**2 / 4

    def wave_number(self, mode: int) -> float:
        return mode * math.pi / self.length

    def frequencies(self, mode: int, spin: float) -> NDArray[np.float64]:
        """All four roots [rad/s]: second spectrum backward, backward, forward, second forward."""
        k2, rho_i, rho_a = self.wave_number(mode) ** 2, self.line_inertia, self.line_mass
        scale = math.sqrt(
            self.bending * k2**2 / (rho_a + rho_i * k2 + self.bending * k2 / self.shear * rho_a)
        )
        translation = np.array([rho_a * scale**2, 0.0, -(self.shear + self.tension) * k2])
        rotation = np.array(
            [-rho_i * scale**2, 2 * rho_i * spin * scale, self.bending * k2 + self.shear]
        )
        quartic = np.polyadd(np.polymul(translation, rotation), [self.shear**2 * k2])
        # the shear terms cancel in the constant: write what is left of them
        quartic[-1] = -self.shear * self.bending * k2**2
        quartic[-1] -= self.tension * k2 * (self.bending * k2 + self.shear)
        return np.sort(np.roots(quartic).real) * scale

    def bending_whirl(self, mode: int, spin: float) -> tuple[float, float]:
        """(backward, forward) of the bending spectrum, both positive [rad/s]."""
        roots = self.frequencies(mode, spin)
        return -roots[1], roots[2]

    def element_error(self, mode: int, spin: float, frequency: float, h: float) -> float:
        """Relative error of signed ``frequency`` by elements of length ``h``, to leading order.

        The element's shape functions are its static solutions: constant shear force Q_h, moment of
        slope −Q_h. The energy projection of a mode is therefore its nodal interpolant, and
        Rayleigh's quotient errs by the strain energy left over: of the shear force its slope,
        (k h)²/12; of the moment its curvature, (k h)⁴/720; and, since M′ = −Q − m with m the moment
        of rotary inertia and gyroscopic effect, m² h²/12EI · Φ/(1+Φ), Φ = 12EI/Sh². With
        V + ω Ω P − ω² T = 0 stationary, δω = δV/(2 ω T − Ω P); at rest and without rotary inertia
        δω/ω = s (k h)²/24 + (1 − s) (k h)⁴/1440, s the shear share of the strain energy.
        """
        k, rho_i = self.wave_number(mode), self.line_inertia
        # from the first equation of motion, (ρA ω² − S k²) U + S k Φ = 0
        u, slope = self.shear * k, self.shear * k**2 - self.line_mass * frequency**2
        shear, bending = self.shear * (k * u - slope) ** 2, self.bending * (k * slope) ** 2
        moment = rho_i * (frequency**2 - 2 * spin * frequency) * slope
        phi = 12 * self.bending / (self.shear * h**2)
        missed = shear * (k * h) ** 2 / 12 + bending * (k * h) ** 4 / 720
        missed += (moment * h) ** 2 / (12 * self.bending) * phi / (1 + phi)
        kinetic, polar = self.line_mass * u**2 + rho_i * slope**2, 2 * rho_i * slope**2
        return missed / (frequency * (2 * frequency * kinetic - spin * polar))
