"""The ball guide in which a sleeve slides, and its radial stiffness."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Annotated

from rotordyn.description import Description, Faults, known
from rotordyn.quantity import Diameter, Interference, Whole

if TYPE_CHECKING:
    from bearings import LinearBallGuide


@dataclass(frozen=True)
class BallGuide(Description):
    """Balls of steel between a sleeve and the bore of the housing, pressed by interference.

    The sleeve is held by its radial stiffness at the centre. Lengths [m].
    """

    balls: Annotated[int, Whole(3, 100_000), "number of balls that carry load, in all rows"]
    ball_diameter: Annotated[Diameter, "diameter of a ball"]
    column_diameter: Annotated[Diameter, "diameter of the sleeve below the balls"]
    interference: Annotated[Interference, "radial interference of both contacts of a ball together"]

    def _faults(self) -> Faults:
        if self.interference == 0.0:
            yield (
                ("interference",),
                "a ball guide without interference has no stiffness at its centre: given {given}; "
                "allowed: above 0 um, or leave the guide out",
            )
        elif self.interference >= 0.1 * self.ball_diameter:
            yield (
                ("interference",),
                "too large for a ball: given {given}; allowed: below a tenth of "
                "{given:ball_diameter}",
            )

    @property
    def stiffness(self) -> float:
        """Radial stiffness at the centre [N/m]; NaN where a value is reported as faulty."""
        sizes = self.ball_diameter, self.column_diameter, self.interference
        return self.law.stiffness if self.balls and all(map(known, sizes)) else math.nan

    @cached_property
    def law(self) -> LinearBallGuide:
        """Law of its radial force."""
        from bearings import LinearBallGuide

        sizes = self.ball_diameter, self.column_diameter
        return LinearBallGuide(self.balls, *sizes, self.interference)
