"""The thrust ball bearing: one groove a washer, contact at 90°, thrust in one direction."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from bearings.bearing import CONFORMITY, BallBearing
from bearings.grooves import Grooves
from bearings.measure import measured


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
        """Sentence on a radial load, or on thrust or a moment that separates the washers."""
        thrust, *radial = load[:3]
        if any(force != 0.0 and flag for force, flag in zip(radial, free[1:3], strict=True)):
            return (
                f"a thrust ball bearing carries no radial load: got {math.hypot(*radial):g} N; "
                "give its radial displacement instead, and a radial bearing beside it"
            )
        if reverse := BallBearing.refusal(self, load, free):  # super() is lost with slots
            return reverse
        moment = [part if flag else 0.0 for part, flag in zip(load[3:], free[3:], strict=True)]
        if free[0] and (size := math.hypot(*moment)) > (most := self._tipping(thrust, *moment)):
            return (
                f"under {thrust:g} N of thrust a thrust ball bearing carries a moment up to "
                f"{most:.4g} N·m in this direction, where one side of it lifts off: got {size:g} "
                "N·m; raise the thrust, or restrain the tilt of the shaft by another bearing"
            )
        return ""

    def _tipping(self, thrust: float, my: float, mz: float) -> float:
        """Largest moment under a thrust: its line of action stays within the polygon of the balls.

        Ball k at ψ puts (Mz, My) = thrust · dm/2 · (−cos ψ, sin ψ) on the ring.
        """
        part = math.pi / self.balls
        aside = math.fmod(math.atan2(my, -mz) + 2.0 * math.pi, 2.0 * part) - part  # from an edge
        return thrust * self.pitch_diameter / 2.0 * math.cos(part) / math.cos(aside)

    @property
    def grooves(self) -> Grooves:
        """Grooves whose centres are BD apart along the axis."""
        return Grooves.of(self, free_angle=math.pi / 2.0, radial_gap=0.0, touching=True)
