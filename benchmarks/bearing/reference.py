"""Load and K of a state by the plain equations, in extended precision where available."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings import AngularContactBallBearing
from benchmarks.bearing.plain import PlainBearing

Array = NDArray[np.float64]
Wide = NDArray[np.longdouble]
STEP = 1e-8  # m
ROUNDS = 12
FIVE_POINTS = ((1.0, 8.0), (-1.0, -8.0), (2.0, -1.0), (-2.0, 1.0))


class Reference:
    """The plain equations solved by Newton's method with a Jacobian kept from the start."""

    def __init__(self, bearing: AngularContactBallBearing, speed: float) -> None:
        self.plain = PlainBearing(bearing, speed)

    def load_and_stiffness(self, d: Array, centre: Array) -> tuple[Array, Array]:
        """(5,) and (5, 5) at a displacement, from known ball centres (2, balls)."""
        first = self.plain.unknowns(*self.plain.centres(d), *centre)
        load, balls = self._load(d.astype(np.longdouble), first.T.astype(np.longdouble))
        r = self.plain.radius
        columns = []
        for step in STEP * np.diag([1.0, 1.0, 1.0, 1.0 / r, 1.0 / r]):
            parts = [w * self._load(d + np.longdouble(k) * step, balls)[0] for k, w in FIVE_POINTS]
            columns.append(sum(parts) / (12.0 * step.max()))
        return load.astype(float), np.array(columns).T.astype(float)

    def displacement(self, load: Array, d: Array, centre: Array, stiffness: Array) -> Array:
        """(5,) under a load, from a state close by and its K."""
        first = self.plain.unknowns(*self.plain.centres(d), *centre)
        at, balls = d.astype(np.longdouble), first.T.astype(np.longdouble)
        for _ in range(ROUNDS):
            carried, balls = self._load(at, balls)
            at = at + np.linalg.solve(stiffness, (load - carried).astype(float))
        return at.astype(float)

    def _load(self, d: Wide, start: Wide) -> tuple[Wide, Wide]:
        a1, a2 = self.plain.centres(d)
        jacobian = self._jacobian(start.astype(float), a1.astype(float), a2.astype(float))
        u = start
        for _ in range(ROUNDS):
            residual = np.array(self.plain.ball(u, a1, a2)[0])
            u = u - np.linalg.solve(jacobian, residual.astype(float).T[..., None])[..., 0].T
        return self.plain.ring_load(self.plain.ball(u, a1, a2)[1]), u

    def _jacobian(self, u: Array, a1: Array, a2: Array) -> Any:
        """(balls, 4, 4) by differences: accurate enough for a simplified Newton iteration."""
        columns = []
        for step in 1e-4 * np.eye(4)[:, :, None]:
            up, down = (np.array(self.plain.ball(v, a1, a2)[0]) for v in (u + step, u - step))
            columns.append((up - down) / 2e-4)
        return np.array(columns).transpose(2, 1, 0)


def largest(difference: Array, whole: Array, lever: Array) -> float:
    """Largest entry over the largest, all DOF scaled to lengths by ``lever`` (5,)."""
    return float(np.abs(difference * lever).max() / np.abs(whole * lever).max())
