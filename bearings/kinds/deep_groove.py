"""The deep-groove ball bearing: one groove a ring, thrust in both directions, radial clearance."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from bearings.bearing import BallBearing
from bearings.grooves import Grooves
from bearings.measure import Measure, measured

CONTACT_ANGLE = Measure(
    "angle", "free contact angle under thrust", 0.0, math.radians(45.0), unit="deg"
)
CLEARANCE = Measure(
    "length",
    "radial clearance of ring against ring, on the diameter; negative: preload",
    -0.2e-3,
    2e-3,
    unit="um",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class DeepGrooveBallBearing(BallBearing):
    """A single-row deep-groove ball bearing.

    Displacement counts from the centred position, where load is zero by symmetry.

    Parameters
    ----------
    radial_clearance : Pd, free radial travel of one ring against the other, on the diameter [m];
        negative where balls are preloaded at rest
    contact_angle : free contact angle [rad], instead: cos α = 1 − Pd/(2 BD)

    Raises
    ------
    InvalidBearing : the geometry is impossible, or not exactly one of clearance and angle is given
    """

    radial_clearance: float | None = measured(CLEARANCE, None)
    contact_angle: float | None = measured(CONTACT_ANGLE, None)

    both_ways: ClassVar[bool] = True

    def _faults(self) -> Iterator[str]:
        yield from self._exactly_one(("radial_clearance", "contact_angle"))
        most = 2.0 * self.free_distance * (1.0 - math.cos(CONTACT_ANGLE.high))
        if self.radial_clearance is not None and self.radial_clearance > most:
            yield (
                f"{self.drawn('radial_clearance')} gives a contact angle above 45°: with these "
                f"grooves allowed up to {most * 1e6:.4g} µm"
            )

    @property
    def grooves(self) -> Grooves:
        """Grooves whose centres are BD − Pd/2 apart along the radius."""
        if self.contact_angle is not None:
            gap = self.free_distance * math.cos(self.contact_angle)
        else:
            assert self.radial_clearance is not None
            gap = self.free_distance - self.radial_clearance / 2.0
        return Grooves.of(self, radial_gap=gap)

    @property
    def ground(self) -> dict[str, float | None]:
        """The clearance behind a free contact angle."""
        if self.contact_angle is None:
            return {}
        clearance = 2.0 * self.free_distance * (1.0 - math.cos(self.contact_angle))
        return {"contact_angle": None, "radial_clearance": clearance}
