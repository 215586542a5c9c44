"""A linear ball guide: balls between a round column and a bore, pressed by interference.

A ball at the azimuth ψ is pressed by δ = max(δy cos ψ + s, 0), s the interference, where the column
moves by δy; both contacts bear the same load, Q = K δ^1.5 with K = (Ki^(−2/3) + Ko^(−2/3))^(−3/2).
The radial force is F = Σ Q cos ψ, and at the centre dF/dδy = ¾ N K √s.

Noël's thesis (IRCCyN, Nantes, 2013), eqs. 4.2 to 4.5, with two corrections: its eq. 4.4 has a
factor Ko/Ki too many, and its |…| is max(…, 0), else balls with clearance push on both sides.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from bearings.arguments import check_fields, checked
from bearings.arrays import Array
from bearings.contact.hertz import contact
from bearings.errors import InvalidBearing, shown
from bearings.materials import STEEL, Material


@dataclass(frozen=True, slots=True)
class LinearBallGuide:
    """A sleeve of balls between a column and a bore, both smooth cylinders.

    Parameters
    ----------
    balls : number of balls that carry, of all rows
    ball_diameter, column_diameter : D, d [m]; the bore has d + 2 D less the interference
    interference : s, on the radius, of both contacts of a ball together [m]; negative: clearance
    ball_material, column_material : elastic constants; that of the column is the bore's as well

    Raises
    ------
    InvalidBearing : a size or the number of balls is impossible
    """

    balls: int
    ball_diameter: float
    column_diameter: float
    interference: float
    ball_material: Material = STEEL
    column_material: Material = STEEL

    def __post_init__(self) -> None:
        check_fields(self)
        sizes = (self.ball_diameter, self.column_diameter)
        if not all(math.isfinite(size) and size > 0.0 for size in sizes):
            raise InvalidBearing(f"ball_diameter and column_diameter must be above 0, got {sizes}")
        if self.balls < 3 or self.balls != int(self.balls):
            raise InvalidBearing(f"balls must be a whole number from 3 up, got {shown(self.balls)}")
        if not abs(self.interference) < 0.1 * self.ball_diameter:
            raise InvalidBearing(
                f"interference {self.interference * 1e6:g} µm must be far below the balls' "
                f"diameter, {self.ball_diameter * 1e3:g} mm"
            )

    @property
    def contact_stiffness(self) -> float:
        """K of Q = K δ^1.5 of a ball, both contacts in series [N/m^1.5]."""
        compliance = self.ball_material.contact_compliance
        compliance += self.column_material.contact_compliance
        ball = 4.0 / self.ball_diameter
        column = 2.0 / self.column_diameter
        bore = -2.0 / (self.column_diameter + 2.0 * self.ball_diameter)
        races = [contact(ball + c, abs(c) / (ball + c), compliance) for c in (column, bore)]
        series: float = sum(race.stiffness ** (-2.0 / 3.0) for race in races)
        return series**-1.5

    @property
    def stiffness(self) -> float:
        """Radial stiffness at the centre, ¾ N K √s [N/m]; 0 with clearance."""
        return 0.75 * self.balls * self.contact_stiffness * math.sqrt(max(self.interference, 0.0))

    @checked
    def force(self, displacement: Array | float) -> Array:
        """Radial force that moves the column by ``displacement`` [m], of its shape (…) [N]."""
        cosine, pressed = self._pressed(displacement)
        force: Array = self.contact_stiffness * (pressed**1.5 * cosine).sum(axis=-1)
        return force

    @checked
    def tangent(self, displacement: Array | float) -> Array:
        """dF/dδy at a displacement [m], of its shape (…) [N/m]."""
        cosine, pressed = self._pressed(displacement)
        slope = 1.5 * self.contact_stiffness * np.sqrt(pressed) * cosine**2
        tangent: Array = slope.sum(axis=-1)
        return tangent

    @checked
    def linear_range(self, share: float = 0.01) -> float:
        """Displacement up to which F/δy is within ``share`` of the stiffness [m]; 0 with clearance.

        It is 0.55 s for 1 %, and s for 4 %, where the first ball lifts off; at most 2 s.
        """
        from scipy.optimize import brentq

        s, stiffness = self.interference, self.stiffness
        if s <= 0.0:
            return 0.0

        def excess(x: float) -> float:
            return abs(float(self.force(x * s)) / (x * s * stiffness) - 1.0) - share

        if excess(2.0) < 0.0:
            return 2.0 * s
        return s * float(brentq(excess, 1e-3, 2.0))

    def _pressed(self, displacement: Array | float) -> tuple[Array, Array]:
        """Cos ψ of the balls, shape (balls,), and their compression, shape (…, balls) [m]."""
        cosine = np.cos(2.0 * np.pi * np.arange(self.balls) / self.balls)
        approach = np.asarray(displacement, dtype=float)[..., None] * cosine
        return cosine, np.maximum(approach + self.interference, 0.0)
