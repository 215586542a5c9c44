"""The deep-groove ball bearing: one groove a ring, thrust both ways, radial clearance."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from bearings.bearing import (
    BALL_DIAMETER,
    BALLS,
    CONFORMITY,
    MATERIAL,
    PITCH_DIAMETER,
    SHOULDER,
    BallBearing,
    Measure,
    exactly_one,
    measured,
)
from bearings.grooves import Grooves
from bearings.materials import STEEL, Material

CONTACT_ANGLE = Measure(
    "angle", "free contact angle under thrust", 0.0, math.radians(45.0), unit="deg"
)
CLEARANCE = Measure(
    "length", "radial clearance of ring against ring, on the diameter; negative: preload",
    -0.2e-3, 2e-3, unit="um",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class DeepGrooveBallBearing(BallBearing):
    """A single-row deep-groove ball bearing with rigid rings.

    Displacement counts from the centred position, where load is zero by symmetry.

    Parameters
    ----------
    ball_diameter, pitch_diameter : D, dm [m]
    balls : number of balls, at least 3
    inner_conformity, outer_conformity : groove radius over ball diameter, above 0.5
    radial_clearance : Pd, how far one ring moves against the other, on the diameter [m]; negative
        where balls are pressed in at rest
    contact_angle : free contact angle [rad], instead: cos α = 1 − Pd/(2 BD)
    ball_material, ring_material : elastic constants and density
    inner_shoulder_diameter, outer_shoulder_diameter : where the grooves end [m]

    Raises
    ------
    InvalidBearing : the geometry is impossible, or not exactly one of clearance and angle is given
    """

    ball_diameter: float = measured(BALL_DIAMETER)
    pitch_diameter: float = measured(PITCH_DIAMETER)
    balls: int = measured(BALLS)
    inner_conformity: float = measured(CONFORMITY, 0.52)
    outer_conformity: float = measured(CONFORMITY, 0.52)
    radial_clearance: float | None = measured(CLEARANCE, None)
    contact_angle: float | None = measured(CONTACT_ANGLE, None)
    ball_material: Material = measured(MATERIAL, STEEL)
    ring_material: Material = measured(MATERIAL, STEEL)
    inner_shoulder_diameter: float | None = measured(SHOULDER, None)
    outer_shoulder_diameter: float | None = measured(SHOULDER, None)

    both_ways: ClassVar[bool] = True

    def _faults(self) -> Iterator[str]:
        yield from exactly_one(self, "radial_clearance", "contact_angle")
        most = 2.0 * self._distance * (1.0 - math.cos(CONTACT_ANGLE.high))
        if self.radial_clearance is not None and self.radial_clearance > most:
            yield (
                f"radial_clearance {self.radial_clearance * 1e6:g} µm makes a contact angle above "
                f"45°: with these grooves allowed up to {most * 1e6:.4g} µm"
            )

    @property
    def _distance(self) -> float:
        return (self.inner_conformity + self.outer_conformity - 1.0) * self.ball_diameter

    @property
    def grooves(self) -> Grooves:
        """Groove centres BD − Pd/2 apart along the radius."""
        if self.contact_angle is not None:
            gap = self._distance * math.cos(self.contact_angle)
        else:
            assert self.radial_clearance is not None
            gap = self._distance - self.radial_clearance / 2.0
        return Grooves.of(
            self, free_angle=math.acos(min(gap / self._distance, 1.0)), radial_gap=gap
        )
