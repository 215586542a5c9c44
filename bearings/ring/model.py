"""A bearing together with what is assumed of its balls."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from bearings.ball.balance import LawNumbers
from bearings.ball.constants import BallConstants, ball_constants
from bearings.ball.law import KINEMATICS, MOMENT_SHARING, Law
from bearings.geometry import Geometry

Array = NDArray[np.float64]
SLOW = 2e-9  # of the groove reach: a ball pressed in less by its own motion is at rest


@dataclass(frozen=True, eq=False)
class BallModel:
    """Geometry and assumptions, and both as plain numbers."""

    geometry: Geometry
    law: Law

    @cached_property
    def constants(self) -> BallConstants:
        """Numbers for the balance of a ball."""
        return ball_constants(self.geometry, self.law.friction)

    @cached_property
    def numbers(self) -> LawNumbers:
        """Assumptions for the balance of a ball."""
        return LawNumbers(
            kinematics=KINEMATICS.index(self.law.kinematics),
            sharing=MOMENT_SHARING.index(self.law.moment_sharing),
            limited=self.law.friction is not None,
        )

    def nominal_centrifugal(self, speed: Array) -> Array:
        """Fc at equal nominal angles, where every hypothesis gives ωm/ω = (1 − γ cos α)/2 [N]."""
        return self.constants.orbit * self.constants.nominal * speed**2

    @cached_property
    def scale(self) -> Array:
        """What makes the five freedoms of a ring lengths: 1, 1, 1, Ri, Ri [m]."""
        radius = self.geometry.centre_radius
        return np.array([1.0, 1.0, 1.0, radius, radius])

    @property
    def full(self) -> float:
        """Blend at which the problem is the one asked for: 1, or 0 with Fc frozen and no Mg."""
        return 0.0 if self.law.dynamics == "frozen" else 1.0

    @property
    def single(self) -> bool:
        """Whether a ball has one contact a race."""
        return len(self.geometry.inner_offsets) == len(self.geometry.outer_offsets) == 1

    @property
    def one_branch(self) -> bool:
        """See ``Law``."""
        return self.law.one_branch

    def turns(self, speed: Array) -> NDArray[np.bool_]:
        """False where the centrifugal force does not press a ball measurably into its race."""
        g = self.geometry
        depth = (self.nominal_centrifugal(speed) / g.outer.stiffness) ** (2.0 / 3.0)
        return np.asarray(depth > SLOW * g.outer_reach)
