"""What is asked of a bearing: states to find under given loads or displacements."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bearings.ball.law import Law
from bearings.geometry import Geometry, groove_origin
from bearings.ring.data import Cause
from bearings.ring.sums import Ring

Array = NDArray[np.float64]
Index = NDArray[np.intp]

TOLERANCE = 1e-11  # of the largest ball load (ball balance) and ring load (ring balance)
SLOW = 2e-9  # of the groove reach: a ball pressed in less by its own motion is at rest
ROUNDING = 16.0  # of the lengths, granted above that

# first stage
CONVEX_STEPS = 100
HALVINGS = 40
SETTLED = 1e-6  # of the loads: enough to start the second stage from
SOFTEST = 1e-7  # of the ring's stiffness, added to it
SOFT = 1e-13  # of a bearing's stiffness at a thousandth of its free distance, where none is held
LONGEST_STEP = 0.2  # of the free distance

# second stage
NEWTON_STEPS = 5  # more lead to other states across a fold
QUICK_STEPS = 3  # a stride that took no more is followed by a longer one
ON_THE_WAY = 1e-7  # scaled residual of a state that is only followed further
FIRST_BLEND = 0.5  # tried from the convex problem
LONGEST_TURN = 0.15  # rad that the way from a ball to the middle of a groove may turn in one stride
JUMP = 1e-5  # of the largest ball load: what the moment of a ball may change by at once
FIRST_FREE = 1e-4  # stride after a free motion
MOST_FREE_MOTIONS = 4  # on the way of one state
SHORTEST_BLEND = 2.0**-17  # paths of light balls may begin steeply


@dataclass(frozen=True, eq=False, slots=True)
class Problem:
    """States to find: all at rest or all turning.

    ``origin`` (2, s): A at zero displacement; ``speed`` (s,) [rad/s]; ``load`` (s, 5) is met on
    the freedoms where ``free`` (5,) is true, the displacement is kept on the others. ``loose``: not
    every motion of the ring need be held.
    """

    geometry: Geometry
    law: Law
    ring: Ring
    origin: Array
    speed: Array
    load: Array
    free: NDArray[np.bool_]
    turning: bool
    loose: bool = False

    @classmethod
    def of(cls, cause: Cause, ring: Callable[[Geometry], Ring]) -> Problem:
        """All states of a question, taken to turn; ``ring`` says which balls are solved."""
        asked, g = cause.question, cause.geometry
        origin = groove_origin(g, asked.static_growth, asked.growth)
        return cls(g, cause.law, ring(g), origin, asked.speed, asked.load, asked.free, turning=True)

    def centres(self, displacement: Array) -> Array:
        """A (m, s, n) at a displacement (s, 5); m is 3 with two inner grooves, else 2."""
        return self.ring.centres(self.origin, displacement)

    @property
    def placed(self) -> bool:
        """Whether ball centres are unknowns: not at rest between one groove a ring."""
        return self.turning or not self.geometry.single

    @property
    def full(self) -> float:
        """Blend at which a state is found: 1, or 0 at rest and with Fc frozen and no Mg."""
        return 1.0 if self.turning and self.law.dynamics != "frozen" else 0.0

    @property
    def squared(self) -> Array:
        """ω² (s,), 0 for states at rest."""
        return self.speed**2 if self.turning else 0.0 * self.speed

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
        radius = self.geometry.centre_radius
        return np.array([1.0, 1.0, 1.0, radius, radius])


def turns(g: Geometry, speed: Array) -> NDArray[np.bool_]:
    """False where the centrifugal force does not press a ball measurably into its race."""
    depth = (g.orbit * g.nominal * speed**2 / g.outer.stiffness) ** (2.0 / 3.0)
    return np.asarray(depth > SLOW * g.outer_reach)


def first_displacement(problem: Problem, given: Array) -> Array:
    """Displacement to start from: as ``given`` (s, 5), else all balls under their likely share."""
    d = given.copy()
    if not problem.free[0]:
        return d
    g = problem.geometry
    thrust = np.abs(problem.load[:, :3]).max(axis=1) + np.abs(problem.load[:, 3:]).max(axis=1) / (
        g.pitch_diameter / 2.0
    )
    share = thrust / (g.balls * max(np.sin(g.contact_angle), 0.2))
    length = g.free_distance + (share / g.series_stiffness) ** (2.0 / 3.0)
    radial = np.minimum(np.abs(problem.origin[1]), 0.999 * length)
    side = np.where(problem.load[:, 0] < 0.0, -1.0, 1.0)
    if g.both_ways:
        side *= problem.load[:, 0] != 0.0
    shims = g.inner_grooves[0].offset - g.outer_grooves[-1].offset  # of the arcs thrust loads
    d[:, 0] = side * (np.sqrt(length**2 - radial**2) - shims) - problem.origin[0]
    return d
