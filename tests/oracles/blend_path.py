"""The path from the convex problem to the full one, followed by pseudo-arclength.

With the blend t as one more unknown a path can be followed through a fold, where it turns back; so
a missing end is seen for what it is. All Jacobians are differences. Slow on purpose.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tests.oracles.ball_equations import Balls

Array = NDArray[np.float64]
CLOSE = 1e-3  # of the deflection: a contact this near to nothing is about to open or close

STEP = 2e-6  # of the differences, in deflections
HALVINGS = 30
UNLIKE = 1e-5  # of the reference load


@dataclass
class Path:
    """How a path went.

    ``end``: ``"arrived"`` at t = 1; ``"fold"``: t turns back, or would if the ring were held: the
    determinant of a ball changes its sign; ``"jump"``: an inner contact opens or closes and the
    equations jump; ``"lifted"``: a ball leaves the outer race;
    ``"stuck"`` or ``"no start"``: not decided. ``d`` (5,) and ``x`` (2, balls) belong to the last
    point, ``t`` is the largest reached, ``changes`` counts inner contacts opened and closed.
    """

    end: str
    t: float
    d: Array
    x: Array
    steps: int = 0
    changes: int = 0


class Blend:
    """One turning bearing, or one ball, as equations in u = (free displacements, X) and t.

    ``number``: the type the equations are evaluated in; linear systems are solved in double.
    """

    def __init__(
        self,
        equations: Balls,
        centre: Callable[[Array], Array],
        speed: float,
        load: Array,
        free: NDArray[np.bool_],
        displacement: Array,
        number: Any = np.float64,
    ) -> None:
        self.eq, self.centre, self.speed, self.number = equations, centre, speed, number
        self.free, self.given = np.flatnonzero(free), displacement.astype(number)
        self.lever = np.array([1.0, 1.0, 1.0, equations.radius, equations.radius])
        self.push = float(equations.frozen_push(speed))
        self.n = centre(self.given).shape[-1]
        self.load = load
        pressed = float(np.abs(load / self.lever)[self.free].max(initial=0.0)) / self.n
        self.q = max(self.push, pressed)
        if not self.free.size:
            reach = np.hypot(*centre(self.given)) - equations.li - equations.lo
            series = 0.3 * equations.inner.k * np.maximum(reach, 0.0) ** 1.5
            self.q = max(self.q, float(series.max()))
        self.size = (self.q / equations.outer.k) ** (2.0 / 3.0)

    def split(self, u: Array) -> tuple[Array, Array]:
        """(d, X) of the unknowns."""
        d, m = self.given.copy(), self.free.size
        d[self.free] = u[:m] * self.size / self.lever[self.free]
        return d, u[m:].reshape(2, self.n) * self.size

    def join(self, d: Array, x: Array) -> Array:
        """The unknowns of (d, X)."""
        return np.concatenate([(d * self.lever)[self.free], x.ravel()]) / self.size

    def _parts(self, u: Array, t: float) -> tuple[Array, Array]:
        d, x = self.split(u)
        ball, action = self.eq.forces(self.eq.loads(self.centre(d), x, self.speed, t))
        return ball / self.q, action

    def fault(self, u: Array, t: float) -> Array:
        """Ring, then balls, in units of the reference load."""
        ball, action = self._parts(u, t)
        return np.concatenate([self._ring(action), ball.ravel()])

    def _ring(self, action: Array) -> Array:
        if not self.free.size:
            return np.zeros(0)
        return ((self.eq.ring_load(action) - self.load) / self.lever)[self.free] / self.q

    def slopes(self, u: Array, t: float) -> tuple[Array, Array]:
        """∂fault/∂u, ∂fault/∂t by central differences; all balls move at once, each its own X."""
        m, n = self.free.size, self.n
        jac, h = np.zeros((u.size, u.size)), STEP
        for k in range(m):
            step = h * (np.arange(u.size) == k)
            jac[:, k] = (self.fault(u + step, t) - self.fault(u - step, t)) / (2.0 * h)
        for c in range(2):
            columns = m + c * n + np.arange(n)
            step = np.zeros(u.size)
            step[columns] = h
            up, down = self._parts(u + step, t), self._parts(u - step, t)
            ball = (up[0] - down[0]) / (2.0 * h)
            jac[m + np.arange(n), columns], jac[m + n + np.arange(n), columns] = ball
            if m:
                action = (up[1] - down[1]) / (2.0 * h)
                one = np.zeros((3, n, n))
                one[:, np.arange(n), np.arange(n)] = action
                jac[:m, columns] = (self.eq.ring_load(one) / self.lever)[:, self.free].T / self.q
        dt = 1e-6
        by_t = (self.fault(u, t + dt) - self.fault(u, t - dt)) / (2.0 * dt)
        return jac, by_t.astype(float)

    def determinants(self, u: Array, t: float) -> Array:
        """Of ∂fault/∂X of every ball (balls,), the ring held."""
        slope = np.zeros((2, 2, self.n))
        for c in range(2):
            step = np.zeros(u.size)
            step[self.free.size + c * self.n + np.arange(self.n)] = STEP
            up, down = self._parts(u + step, t)[0], self._parts(u - step, t)[0]
            slope[:, c] = (up - down) / (2.0 * STEP)
        return np.asarray(slope[0, 0] * slope[1, 1] - slope[0, 1] * slope[1, 0])

    def energy(self, u: Array) -> float:
        """The potential at t = 0, in units of reference load times deflection."""
        d, x = self.split(u)
        b = self.eq.loads(self.centre(d), x, self.speed, 0.0)
        springs = 0.4 * (b["qi"] * np.maximum(b["di"], 0.0) + b["qo"] * np.maximum(b["do"], 0.0))
        work = (self.load * d)[self.free].sum()
        ball = springs - self.push * (x[1] - self.eq.lo)
        return float((ball.sum() - work) / (self.q * self.size))

    def gaps(self, u: Array) -> Array:
        """Approaches (2, balls) of inner and outer contact over the reference deflection."""
        d, x = self.split(u)
        v = self.centre(d) - x
        return np.array([np.hypot(*v) - self.eq.li, np.hypot(*x) - self.eq.lo]) / self.size

    def first(self) -> Array:
        """Balls seated for a first guess: on the line of centres where pressed, else outside."""
        d = self.given.copy()
        if self.free.size:
            d[0] = self._thrust() if 0 in self.free else d[0]
        a = self.centre(d)
        reach = np.hypot(*a)
        bottom = np.array([0.0, self.eq.lo + (self.push / self.eq.outer.k) ** (2.0 / 3.0)])
        pressed = reach > self.eq.li + self.eq.lo
        deep = 0.5 * np.maximum(reach - self.eq.li - self.eq.lo, 0.0)
        on_line = a / reach * (self.eq.lo + deep)
        return self.join(d, np.where(pressed, on_line, bottom[:, None]))

    def _thrust(self) -> float:
        """δx that presses every ball by the reference deflection."""
        a = self.centre(self.given).mean(axis=-1)
        length = self.eq.li + self.eq.lo + self.size
        side = -1.0 if self.load[0] < 0.0 else 1.0
        return float(side * np.sqrt(max(length**2 - a[1] ** 2, (0.05 * length) ** 2)) - a[0])

    def convex(self) -> Array | None:
        """The minimum at t = 0: Newton steps shortened until the potential falls."""
        u = self.first()
        m, noise = self.free.size, self.noise()
        for _ in range(400):
            g = self.fault(u, 0.0)
            g[:m], scale = g[:m], np.abs(g).max()
            g[m:] *= -1.0  # sum of forces on a ball is minus the slope of the potential
            if scale < noise:
                return u
            h = self.slopes(u, 0.0)[0]
            h[m:] *= -1.0
            values, vectors = np.linalg.eigh(0.5 * (h + h.T))
            values = np.maximum(values, 1e-9 * values.max())
            step = -vectors @ ((vectors.T @ g) / values)
            step *= min(1.0, 0.3 * (self.eq.li + self.eq.lo) / self.size / np.abs(step).max())
            before, length = self.energy(u), 1.0
            slack = 1e-13 * (1.0 + abs(before))
            while length > 1e-12 and not self.energy(u + length * step) <= before + slack:
                length *= 0.5
            u = u + length * step
        return u if np.abs(self.fault(u, 0.0)).max() < 1e-6 else None

    def noise(self) -> float:
        """Below this a residual is rounding."""
        return 1e-9 + 400.0 * np.finfo(self.number).eps * (self.eq.li + self.eq.lo) / self.size


def follow(blend: Blend, *, longest: float = 0.04, most: int = 6000) -> Path:
    """The path from t = 0 until it arrives, folds back, or ends."""
    u = blend.convex()
    if u is None:
        d, x = blend.split(blend.first())
        return Path("no start", 0.0, d, x)
    weight = np.full(u.size + 1, (blend.size / (0.1 * (blend.eq.li + blend.eq.lo))) ** 2)
    weight[-1] = 1.0
    point = np.append(u, 0.0).astype(blend.number)
    way = _direction(blend, point, weight, None)
    path = Path("stuck", 0.0, *blend.split(u))
    ds, touching = 0.01, blend.gaps(u)[0] > 0.0
    upright = blend.determinants(u, 0.0) > 0.0
    low = 0
    while path.steps < most and ds > 1e-9:
        reach = min(ds, (1.0 - point[-1]) / way[-1]) if way[-1] > 1e-3 else ds
        found = _corrected(blend, point, way, reach, weight)
        new_way = None if found is None else _direction(blend, found, weight, way)
        if found is None or new_way is None or (weight * new_way) @ way < 0.97:
            ds *= 0.35
            continue
        path.steps += 1
        now = blend.gaps(found[:-1])[0] > 0.0
        changed = np.flatnonzero(now != touching)
        path.changes += changed.size
        ended = any(
            _jumps(blend, _opening(blend, point, way, reach, weight, k), k) for k in changed
        )
        point, way, touching = found, new_way, now
        ds = min(ds * 1.4, longest)
        path.t = max(path.t, float(point[-1]))
        path.d, path.x = blend.split(point[:-1])
        if ended:
            path.end = "jump"
            return path
        if ((blend.determinants(point[:-1], point[-1]) > 0.0) != upright).any():
            path.end = "fold"
            return path
        low = low + 1 if way[-1] < 0.0 else 0
        if low >= 3 and point[-1] < path.t - 1e-7:
            path.end = "fold"
            return path
        if point[-1] >= 1.0 - 1e-9:
            return _landed(blend, point, path)
    path.end = _stop(blend, point)
    return path


def _landed(blend: Blend, point: Array, path: Path) -> Path:
    """The last point put on t = 1 exactly."""
    u = point[:-1]
    for _ in range(4):
        u = u - np.linalg.solve(blend.slopes(u, 1.0)[0], blend.fault(u, 1.0).astype(float))
    path.end, path.t = "arrived", 1.0
    path.d, path.x = blend.split(u)
    return path


def _stop(blend: Blend, point: Array) -> str:
    """Why no further point is found."""
    inner, outer = blend.gaps(point[:-1])
    if outer.min() < CLOSE:
        return "lifted"
    ball = int(np.abs(inner).argmin())
    if abs(inner[ball]) > CLOSE:
        return "stuck"
    return "jump" if _jumps(blend, point, ball) else "stuck"


def _opening(blend: Blend, point: Array, way: Array, ds: float, weight: Array, ball: int) -> Array:
    """The last point between here and ``ds`` ahead at which the inner contact is as it is here."""
    held, low, high = blend.gaps(point[:-1])[0, ball] > 0.0, 0.0, ds
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        found = _corrected(blend, point, way, middle, weight)
        if found is not None and (blend.gaps(found[:-1])[0, ball] > 0.0) == held:
            low, near = middle, found
        else:
            high = middle
    return point if low == 0.0 else near


def _jumps(blend: Blend, point: Array, ball: int) -> bool:
    """Whether the equations differ on both sides of the opening of an inner contact."""
    ends = (_shifted(blend, point[:-1], ball, gap) for gap in (1e-9, -1e-9))
    sides = [blend.fault(end, point[-1]) for end in ends]
    return bool(np.abs(sides[0] - sides[1]).max() > UNLIKE)


def _shifted(blend: Blend, u: Array, ball: int, gap: float) -> Array:
    """The same with the inner contact of one ball set to ``gap`` deflections."""
    d, x = blend.split(u)
    v = blend.centre(d)[:, ball] - x[:, ball]
    length = np.hypot(*v)
    x = x.copy()
    x[:, ball] += v / length * (length - blend.eq.li - gap * blend.size)
    return blend.join(d, x)


def _direction(blend: Blend, point: Array, weight: Array, last: Array | None) -> Array | None:
    """Unit tangent in the weighted norm, along ``last``; towards larger t at the start."""
    jac, by_t = blend.slopes(point[:-1], point[-1])
    border = np.zeros(point.size) if last is None else weight * last
    if last is None:
        border[-1] = 1.0
    matrix = np.vstack([np.column_stack([jac, by_t]), border])
    try:
        way = np.linalg.solve(matrix, np.eye(point.size)[-1])
    except np.linalg.LinAlgError:
        return None
    return way / np.sqrt((weight * way) @ way) if np.isfinite(way).all() else None


def _corrected(blend: Blend, point: Array, way: Array, ds: float, weight: Array) -> Array | None:
    """The point of the path at weighted distance ``ds`` along ``way``, or None."""
    target = point + ds * way
    new, size = target.copy(), np.inf
    for _ in range(8):
        fault = blend.fault(new[:-1], new[-1])
        if not np.isfinite(fault).all():
            return None
        size = np.abs(fault).max()
        if size < blend.noise():
            return new if (blend.gaps(new[:-1])[1] > 0.0).all() else None
        jac, by_t = blend.slopes(new[:-1], new[-1])
        matrix = np.vstack([np.column_stack([jac, by_t]), weight * way])
        try:
            gap = np.append(fault, (weight * way) @ (new - target))
            step = np.linalg.solve(matrix, -gap.astype(float))
        except np.linalg.LinAlgError:
            return None
        new = new + step
    return None
