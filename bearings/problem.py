"""What is asked of a bearing: states to find under given loads or displacements."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bearings.model import BallModel
from bearings.ring import Ring

Array = NDArray[np.float64]
Index = NDArray[np.intp]

TOLERANCE = 1e-11  # of the largest ball load (ball balance) and ring load (ring balance)
EPS = float(np.finfo(float).eps)


@dataclass(frozen=True, eq=False, slots=True)
class Problem:
    """States to find: all at rest or all turning.

    ``origin`` (2, s): A at zero displacement; ``speed`` (s,) [rad/s]; ``load`` (s, 5) is met on
    the freedoms where ``free`` (5,) is true, the displacement is kept on the others.
    """

    model: BallModel
    ring: Ring
    origin: Array
    speed: Array
    load: Array
    free: NDArray[np.bool_]
    turning: bool

    def centres(self, displacement: Array) -> Array:
        """A (2, s, n) at a displacement (s, 5)."""
        return self.ring.centres(self.origin, displacement)

    def take(self, index: Index) -> Problem:
        """The same problem for some of its states."""
        return replace(
            self,
            origin=self.origin[:, index],
            speed=self.speed[index],
            load=self.load[index],
        )

    @property
    def scale(self) -> Array:
        """What makes the five freedoms lengths: 1, 1, 1, Ri, Ri [m]."""
        radius = self.model.geometry.centre_radius
        return np.array([1.0, 1.0, 1.0, radius, radius])
