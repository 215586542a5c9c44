"""Balls as rigid bodies in space: points, forces, velocities and angular momentum as 3-vectors.

Written from the motion of rigid bodies, for single states that a bearing has solved. Components
are (x, y, z) of the bearing; the origin is the centre of the circle of outer groove centres.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tests.oracles.ball_bearing import BallBearingOracle, rolling

AXIS = np.array([1.0, 0.0, 0.0])


@dataclass(frozen=True)
class RigidBalls:
    """One state; vectors (balls, 3), scalars (balls,)."""

    oracle: BallBearingOracle
    state: Any

    def across(self, axial: NDArray, radial: NDArray) -> NDArray:
        """Vectors in the planes through the axis and each ball."""
        return axial[:, None] * AXIS + radial[:, None] * self.radial

    @property
    def radial(self) -> NDArray:
        """Outward unit vectors."""
        psi = self.oracle.azimuths()
        return np.column_stack([0.0 * psi, np.cos(psi), np.sin(psi)])

    @property
    def onward(self) -> NDArray:
        """Unit vectors the way a positive rotation about x moves the balls."""
        return np.cross(AXIS, self.radial)

    def line(self, angle: NDArray) -> NDArray:
        """Unit vectors along a contact line, towards the outer race."""
        return self.across(np.sin(angle), np.cos(angle))

    def slide(self, angle: NDArray) -> NDArray:
        """Unit vectors across a contact line in the plane of the axis."""
        return self.across(np.cos(angle), -np.sin(angle))

    @property
    def approach(self) -> tuple[NDArray, NDArray]:
        """δi, δo."""
        o, s = self.oracle, self.state
        return (s.inner_load / o.inner.k) ** (2 / 3), (s.outer_load / o.outer.k) ** (2 / 3)

    @property
    def weight(self) -> NDArray:
        """Qi ai Ei/(Qo ao Eo)."""
        o, s = self.oracle, self.state
        outer = np.maximum(s.outer_load, 1e-300)
        size = o.inner.a1 * o.inner.e / (o.outer.a1 * o.outer.e)
        return (s.inner_load / outer) ** (4 / 3) * size

    @property
    def share(self) -> NDArray:
        """λi."""
        c = self.weight
        shares = {"equal": 1.0, "outer": 0.0, "inner": 2.0, "hybrid": 2.0 * c / (1.0 + c)}
        return shares[self.oracle.sharing] + 0.0 * c

    @property
    def outer_groove(self) -> NDArray:
        """Outer groove centres."""
        o, b = self.oracle, self.oracle.bearing
        return (b.pitch_diameter / 2 - o.lo * np.cos(b.contact_angle)) * self.radial

    @property
    def centre(self) -> NDArray:
        """Ball centres."""
        length = self.oracle.lo + self.approach[1]
        return self.outer_groove + length[:, None] * self.line(self.state.outer_angle)

    @property
    def inner_groove(self) -> NDArray:
        """Inner groove centres, from the displacement of the ring."""
        a1, a2 = self.oracle.centres(self.state.displacement, self.oracle.azimuths())
        return self.outer_groove + self.across(a1, a2)

    @property
    def inner_contact(self) -> NDArray:
        """Where the balls press the inner race."""
        reach = self.oracle.bearing.inner_conformity * self.oracle.d
        return self.inner_groove - reach * self.line(self.state.inner_angle)

    @property
    def outer_contact(self) -> NDArray:
        """Where the balls press the outer race."""
        reach = self.oracle.bearing.outer_conformity * self.oracle.d
        return self.outer_groove + reach * self.line(self.state.outer_angle)

    @property
    def inner_force(self) -> NDArray:
        """Of the inner ring on the balls: pressure and friction."""
        s, friction = self.state, self.share * self.state.gyroscopic_moment / self.oracle.d
        along, across = self.line(s.inner_angle), self.slide(s.inner_angle)
        return s.inner_load[:, None] * along + friction[:, None] * across

    @property
    def outer_force(self) -> NDArray:
        """Of the balls on the outer ring: pressure and friction."""
        s = self.state
        friction = (2.0 - self.share) * s.gyroscopic_moment / self.oracle.d
        along, across = self.line(s.outer_angle), self.slide(s.outer_angle)
        return s.outer_load[:, None] * along + friction[:, None] * across

    def motion(self) -> tuple[NDArray, NDArray]:
        """(ωm, W): orbital speeds and angular velocities of the balls, per unit of ring speed.

        From no slip at both contacts and the hypothesis on the attitude of the axis.
        """
        s = self.state
        orbit, spin, beta = rolling(
            s.inner_angle, s.outer_angle, self.oracle.g, self.weight, self.oracle.kinematics
        )
        own = spin[:, None] * self.across(-np.cos(beta), np.sin(beta))
        return orbit, own + orbit[:, None] * AXIS


def pair(load: NDArray) -> tuple[NDArray, NDArray]:
    """(Fx, Fy, Fz, My, Mz) as force and moment vectors."""
    return load[:3], np.array([0.0, *load[3:]])
