"""The angular-contact ball bearing: one groove a ring, thrust one way."""

from __future__ import annotations

import math
from dataclasses import dataclass

from bearings.bearing import (
    BALL_DIAMETER,
    BALLS,
    CONFORMITY,
    MATERIAL,
    PITCH_DIAMETER,
    SHOULDER,
    BallBearing,
    Measure,
    measured,
)
from bearings.grooves import Grooves
from bearings.materials import SILICON_NITRIDE, STEEL, Material

CONTACT_ANGLE = Measure("angle", "free contact angle", 0.0, math.radians(60.0), unit="deg")


@dataclass(frozen=True, slots=True)
class AngularContactBallBearing(BallBearing):
    """A single-row angular-contact ball bearing with rigid rings.

    Parameters
    ----------
    ball_diameter, pitch_diameter : D, dm [m]
    balls : number of balls, at least 3
    contact_angle : free contact angle α [rad]
    inner_conformity, outer_conformity : groove radius over ball diameter, above 0.5
    ball_material, ring_material : elastic constants and density
    inner_shoulder_diameter, outer_shoulder_diameter : where the grooves end [m]

    Raises
    ------
    InvalidBearing : the geometry is impossible (balls overlap, groove tighter than the ball …)
    """

    ball_diameter: float = measured(BALL_DIAMETER)
    pitch_diameter: float = measured(PITCH_DIAMETER)
    balls: int = measured(BALLS)
    contact_angle: float = measured(CONTACT_ANGLE)
    inner_conformity: float = measured(CONFORMITY, 0.52)
    outer_conformity: float = measured(CONFORMITY, 0.52)
    ball_material: Material = measured(MATERIAL, SILICON_NITRIDE)
    ring_material: Material = measured(MATERIAL, STEEL)
    inner_shoulder_diameter: float | None = measured(SHOULDER, None)
    outer_shoulder_diameter: float | None = measured(SHOULDER, None)

    @property
    def grooves(self) -> Grooves:
        """Inner and outer groove centre lie BD apart along the contact angle."""
        return Grooves.of(self, free_angle=float(self.contact_angle), touching=True)
