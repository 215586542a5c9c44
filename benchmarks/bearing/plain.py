"""The plain equations of a bearing, solved by ``scipy.optimize`` without changes.

Four unknowns a ball (X1, X2, δi, δo) in µm, forces in hundreds of newtons; hybrid kinematics,
moment shared equally. As a careful user would write them: plain numbers per ball, numpy where all
balls are solved together, no Jacobian, differences for K.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import fsolve, root

from tests.oracles.ball_equations import contact

Array = NDArray[np.float64]
MICROMETRE = 1e-6
XTOL = 1e-12


class PlainBearing:
    """One bearing at a speed [rad/s]."""

    def __init__(self, bearing: Any, speed: float) -> None:
        b, d = bearing, bearing.ball_diameter
        self.d, self.dm, self.speed, self.balls = d, b.pitch_diameter, speed, b.balls
        self.li, self.lo = (b.inner_conformity - 0.5) * d, (b.outer_conformity - 0.5) * d
        self.fi, self.g = b.inner_conformity, d / b.pitch_diameter
        self.inner, self.outer = contact(b, +1), contact(b, -1)
        self.ratio = self.inner.torque / self.outer.torque
        self.mass = b.ball_material.density * math.pi * d**3 / 6.0
        self.axial = (self.li + self.lo) * math.sin(b.contact_angle)
        self.radial = (self.li + self.lo) * math.cos(b.contact_angle)
        self.radius = self.dm / 2.0 + self.li * math.cos(b.contact_angle)
        self.angle = b.contact_angle
        self.psi = 2.0 * math.pi / b.balls * np.arange(b.balls)

    def centres(self, d: Array) -> tuple[Array, Array]:
        """A of all balls at a displacement."""
        c, s = np.cos(self.psi), np.sin(self.psi)
        a1 = self.axial + d[0] + self.radius * (d[3] * s - d[4] * c)
        return a1, self.radial + d[1] * c + d[2] * s

    def ball(self, u: Any, a1: Any, a2: Any) -> tuple[Any, ...]:
        """Four residuals of one ball (or of all), and its action (fa, fr, m) on the inner ring."""
        x1, x2, di, do = (v * MICROMETRE for v in u)
        v1, v2, g = a1 - x1, a2 - x2, self.g
        ei, eo = self.li + di, self.lo + do
        si, ci, so, co = v1 / ei, v2 / ei, x1 / eo, x2 / eo
        qi, qo = self.inner.k * abs(di) ** 1.5, self.outer.k * abs(do) ** 1.5
        c = self.ratio * (qi / qo) ** (4.0 / 3.0)
        s = (1.0 + g * co) / (1.0 - g * ci)
        lean, with_race = c * (s + 1.0), ci * co + si * so
        tan = (lean * si + 2.0 * so) / (lean * ci + 2.0 * (co + g) + g * c * (with_race - s))
        near, far = (co + tan * so) / (1.0 + g * co), (ci + tan * si) / (1.0 - g * ci)
        orbit = near / (near + far) * self.speed
        spin = self.speed / (g * (near + far))  # times 1/cos β
        fc = 0.5 * self.mass * self.dm * orbit**2
        mg = 0.1 * self.mass * self.d**2 * orbit * spin * tan  # sin β / cos β
        t = mg / self.d
        fa, fr = qi * si + t * ci, qi * ci - t * si
        residual = (
            (v1 * v1 + v2 * v2 - ei * ei) / (MICROMETRE * self.li),
            (x1 * x1 + x2 * x2 - eo * eo) / (MICROMETRE * self.lo),
            (fa - qo * so - t * co) / 100.0,
            (fr - qo * co + t * so + fc) / 100.0,
        )
        return residual, (fa, fr, self.radius * fa - t * self.d * self.fi)

    def unloaded(self) -> Array:
        """(balls, 4) from the unloaded geometry, one µm pressed in."""
        one = np.array([self.lo * math.sin(self.angle), self.lo * math.cos(self.angle), 1e-6, 1e-6])
        return np.tile(one / MICROMETRE, (self.balls, 1))

    def unknowns(self, a1: Array, a2: Array, x1: Array, x2: Array) -> Array:
        """(balls, 4) of known ball centres."""
        di, do = np.hypot(a1 - x1, a2 - x2) - self.li, np.hypot(x1, x2) - self.lo
        return np.column_stack([x1, x2, di, do]) / MICROMETRE

    def settled(self, d: Array, start: Array) -> tuple[Array, Array]:
        """Load (5,) and the balls' unknowns at a displacement: a ``fsolve`` per ball."""
        a1, a2 = self.centres(d)
        found, action = np.empty_like(start), np.empty((3, self.balls))
        for j in range(self.balls):
            at = float(a1[j]), float(a2[j])
            found[j] = fsolve(_residual, start[j], (self, *at), xtol=XTOL, full_output=True)[0]
            action[:, j] = self.ball(found[j].tolist(), *at)[1]
        return self.ring_load(action), found

    def ring_load(self, action: Any) -> Array:
        """(5,) of the actions of all balls."""
        c, s = np.cos(self.psi), np.sin(self.psi)
        fa, fr, m = action
        return np.array([fa.sum(), (fr * c).sum(), (fr * s).sum(), (m * s).sum(), -(m * c).sum()])

    @property
    def steps(self) -> Array:
        """A hundredth of a µm, tilts at the ring's radius."""
        return 1e-8 / np.array([1.0, 1.0, 1.0, self.radius, self.radius])

    def load_and_stiffness(self, d: Array, start: Array) -> tuple[Array, Array]:
        """Load and K by central differences: eleven solves of all balls."""
        load, balls = self.settled(d, start)
        columns = [
            (self.settled(d + step, balls)[0] - self.settled(d - step, balls)[0])
            / (2.0 * step.max())
            for step in np.diag(self.steps)
        ]
        return load, np.array(columns).T

    def displacement_nested(self, load: Array, d: Array, start: Array) -> tuple[Array, Array]:
        """Displacement and balls under a load: nested solutions of five and of four unknowns."""
        unit = MICROMETRE / np.array([1.0, 1.0, 1.0, self.radius, self.radius])
        lever = np.array([1.0, 1.0, 1.0, self.radius, self.radius])
        balls = start

        def fault(q: Array) -> Array:
            nonlocal balls
            carried, balls = self.settled(q * unit, balls)
            return (carried - load) / lever

        found = root(fault, d / unit, method="hybr", tol=1e-10)
        return np.asarray(found.x * unit), balls

    def displacement_together(self, load: Array, d: Array, start: Array) -> tuple[Array, Array]:
        """Displacement and balls under a load: ring and balls in one system."""
        unit = MICROMETRE / np.array([1.0, 1.0, 1.0, self.radius, self.radius])
        lever = np.array([1.0, 1.0, 1.0, self.radius, self.radius])

        def fault(q: Array) -> Array:
            a1, a2 = self.centres(q[:5] * unit)
            residual, action = self.ball(q[5:].reshape(4, -1), a1, a2)
            return np.concatenate([(self.ring_load(action) - load) / lever, *residual])

        first = np.concatenate([d / unit, start.T.ravel()])
        found = root(fault, first, method="hybr", tol=XTOL)
        return np.asarray(found.x[:5] * unit), found.x[5:].reshape(4, -1).T


def _residual(u: Array, bearing: PlainBearing, a1: float, a2: float) -> tuple[Any, ...]:
    return bearing.ball(u.tolist(), a1, a2)[0]
