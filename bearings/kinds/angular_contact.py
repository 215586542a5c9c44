"""The angular-contact ball bearing: one groove a ring, thrust in one direction."""

from __future__ import annotations

import math
from dataclasses import dataclass

from bearings.bearing import MATERIAL, BallBearing
from bearings.grooves import Grooves
from bearings.materials import SILICON_NITRIDE, Material
from bearings.measure import Measure, measured

CONTACT_ANGLE = Measure("angle", "free contact angle", 0.0, math.radians(60.0), unit="deg")


@dataclass(frozen=True, slots=True, kw_only=True)
class AngularContactBallBearing(BallBearing):
    """A single-row angular-contact ball bearing.

    Parameters
    ----------
    contact_angle : free contact angle α [rad]

    Raises
    ------
    InvalidBearing : the geometry is impossible (balls overlap, groove tighter than the ball …)
    """

    contact_angle: float = measured(CONTACT_ANGLE)
    ball_material: Material = measured(MATERIAL, SILICON_NITRIDE)

    @property
    def grooves(self) -> Grooves:
        """Grooves whose centres are BD apart along the contact angle."""
        return Grooves.of(self, free_angle=float(self.contact_angle), touching=True)
