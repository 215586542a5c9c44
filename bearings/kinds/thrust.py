"""The thrust ball bearing: one groove a washer, contact at 90°, thrust one way."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from bearings.bearing import CONFORMITY, BallBearing, measured
from bearings.grooves import Grooves


@dataclass(frozen=True, slots=True, kw_only=True)
class ThrustBallBearing(BallBearing):
    """A single-direction thrust ball bearing with rigid washers.

    The shaft washer is the inner ring, the housing washer the outer one. Nothing but the grooves
    guides it radially: it carries thrust towards +x and moments, no radial load.

    Parameters: those of ``BallBearing``.
    """

    inner_conformity: float = measured(CONFORMITY, 0.54)
    outer_conformity: float = measured(CONFORMITY, 0.54)

    def refusal(self, load: Sequence[float], free: Sequence[bool]) -> str:
        """Radial load, or thrust that lifts the washers off."""
        thrust, *radial = load[:3]
        if any(force != 0.0 and given for force, given in zip(radial, free[1:3], strict=True)):
            return (
                f"a thrust ball bearing carries no radial load: got {math.hypot(*radial):g} N; "
                "give its radial displacement instead, and a radial bearing beside it"
            )
        if free[0] and thrust < 0.0:
            return (
                f"a thrust ball bearing carries thrust towards +x only: got {thrust:g} N; turn it "
                "round, or use one for each direction"
            )
        return ""

    @property
    def grooves(self) -> Grooves:
        """Groove centres BD apart along the axis."""
        return Grooves.of(self, free_angle=math.pi / 2.0, radial_gap=0.0, touching=True)
