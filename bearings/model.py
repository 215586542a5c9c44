"""A bearing together with what is assumed of its balls."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from bearings.ball import Laws
from bearings.constants import BallConstants, ball_constants
from bearings.geometry import Geometry
from bearings.kinematics import HYPOTHESES, SHARINGS

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class BallModel:
    """Geometry, kinematic hypothesis, sharing of the gyroscopic moment, friction μ or None."""

    geometry: Geometry
    kinematics: str
    moment_sharing: str
    friction: float | None = None

    @cached_property
    def constants(self) -> BallConstants:
        """Numbers for the balance of a ball."""
        return ball_constants(self.geometry, self.friction)

    @cached_property
    def laws(self) -> Laws:
        """Assumptions for the balance of a ball."""
        kinematics, sharing = list(HYPOTHESES), list(SHARINGS)
        return Laws(
            kinematics=kinematics.index(self.kinematics),
            sharing=sharing.index(self.moment_sharing),
            slips=self.friction is not None,
        )

    def nominal_centrifugal(self, speed: Array) -> Array:
        """Fc at equal nominal angles, where every hypothesis gives ωm/ω = (1 − γ cos α)/2 [N]."""
        return self.constants.orbit * self.constants.nominal * speed**2
