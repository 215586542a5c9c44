"""Ball bearings with one or two arcs a groove, written to judge ``bearings`` and nothing else.

Nothing is shared with the product. Displacement of the ring and centres of all balls are sought
together: with the centrifugal force frozen they minimise one convex energy

    E = Σ 2/5 k δ₊^2.5 − Σ Fc X2 − f·d

over (d, all X), by Newton's method with a shifted Hessian and step halving. With forces that follow
the resultant of each race (``dynamics="resultant"``) there is no energy: the balances of balls and
ring are solved together, their Jacobian by differences, in a few steps that lead from the frozen
forces to the full ones. Lengths are in µm and angles are multiplied by the groove circle's radius,
so that all unknowns are alike. Contacts are ``ir``, ``il`` (inner ring, −x and +x side of the
ball), ``or``, ``ol`` (outer ring, −x and +x side); with one arc a groove, one a race.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tests.oracles.ball_bearing import rolling
from tests.oracles.ball_equations import contact

Array = NDArray[np.float64]
MICROMETRE = 1e-6
LONGEST = 40.0  # µm, of one Newton step
STEPS = 4  # from frozen to full dynamics


class OracleFailure(RuntimeError):
    """An iteration of the oracle did not arrive."""


@dataclass(frozen=True)
class Solid:
    """Elastic constants and density (SI)."""

    young_modulus: float = 200e9
    poisson_ratio: float = 0.3
    density: float = 7850.0


@dataclass(frozen=True)
class Found:
    """One state, SI; ball values by contact (balls, contacts), or by ball (balls,)."""

    load: Array
    displacement: Array
    contact_load: Array
    contact_angle: Array
    inner_force: Array  # (balls, 2): axial, radial normal force of the inner race on the ball
    centrifugal_force: Array
    gyroscopic_moment: Array
    orbit: Array
    residual: float
    ball_centre: Array
    stiffness: Array  # with the forces of the state frozen

    @property
    def contacts(self) -> NDArray[np.intp]:
        """How many contacts of each ball carry."""
        return np.count_nonzero(self.contact_load > 0.0, axis=-1)


@dataclass(frozen=True)
class Actions:
    """What the balls do at given unknowns; leading batch dimensions, then balls."""

    load: Array  # (…, balls, contacts)
    normal: Array  # (…, balls, contacts, 2)
    inner: Array  # (…, balls, 2) normal force of the inner race
    balance: Array  # (…, balls, 2)
    ring: Array  # (…, 5), moments over the groove circle's radius
    push: Array
    moment: Array
    orbit: Array


@dataclass(frozen=True)
class Drawing:
    """Numbers of a bearing (SI); shims of None: a single arc in each groove."""

    ball_diameter: float
    pitch_diameter: float
    balls: int
    contact_angle: float
    inner_conformity: float
    outer_conformity: float
    inner_shim: float | None = None
    outer_shim: float | None = None
    ball_material: Any = field(default_factory=Solid)
    ring_material: Any = field(default_factory=Solid)

    @property
    def free_distance(self) -> float:
        """BD [m]."""
        return (self.inner_conformity + self.outer_conformity - 1.0) * self.ball_diameter

    @property
    def axial_play(self) -> float:
        """Whole axial travel of the unloaded rings, 2 BD sin αf − gi − go [m]."""
        shims = (self.inner_shim or 0.0) + (self.outer_shim or 0.0)
        return 2.0 * self.free_distance * math.sin(self.contact_angle) - shims


class GrooveOracle:
    """One bearing under one set of assumptions."""

    def __init__(
        self, drawing: Drawing, *, kinematics: str = "hybrid", moment_sharing: str = "equal"
    ) -> None:
        self.drawing, self.kinematics, self.moment_sharing = drawing, kinematics, moment_sharing
        b, d = drawing, drawing.ball_diameter / MICROMETRE
        li, lo = (b.inner_conformity - 0.5) * d, (b.outer_conformity - 0.5) * d
        inner, outer = contact(b, +1), contact(b, -1)
        xi, xo = _sides(b.inner_shim), _sides(b.outer_shim)
        ni, no = len(xi), len(xo)
        self.races, self.ni = (inner, outer), ni
        self.offset = np.array([*xi, *xo])
        self.side = np.array([1.0, -1.0][:ni] + ([-1.0, 1.0] if no == 2 else [1.0]))
        self.free = np.array([li] * ni + [lo] * no)
        self.k = np.array([inner.k] * ni + [outer.k] * no) * MICROMETRE**1.5
        self.peak = np.array([inner.pressure] * ni + [outer.pressure] * no)
        self.gap = (li + lo) * math.cos(b.contact_angle)
        self.radius = 0.5 * b.pitch_diameter / MICROMETRE + li * math.cos(b.contact_angle)
        self.gamma = b.ball_diameter / b.pitch_diameter
        self.mass = b.ball_material.density * math.pi / 6.0 * b.ball_diameter**3
        self.balls = b.balls
        self.psi = 2.0 * math.pi / b.balls * np.arange(b.balls)
        self.lean = _leverage(self.psi, self.offset[:ni], self.radius)
        turn = 1.0 / self.radius
        self.scale = np.array([MICROMETRE, MICROMETRE, MICROMETRE, turn, turn])
        self.lever = np.array([1.0, 1.0, 1.0, *[self.radius * MICROMETRE] * 2])

    # --- geometry -----------------------------------------------------------------------------

    def frozen_push(self, speed: Any) -> Any:
        """Fc at the free contact angle [N]."""
        ratio = 0.5 * (1.0 - self.gamma * math.cos(self.drawing.contact_angle))
        return 0.5 * self.mass * self.drawing.pitch_diameter * (ratio * speed) ** 2

    def pressure(self, load: Array) -> Array:
        """Largest pressure of each contact [Pa]."""
        return np.asarray(self.peak * load ** (1.0 / 3.0))

    def _reach(self, d: Array, x: Array) -> tuple[Array, Array, Array]:
        """Lengths |u| [µm], directions n, approaches δ [µm] of all contacts of all balls."""
        ni = self.ni
        rest = np.stack([self.offset, np.where(np.arange(len(self.offset)) < ni, self.gap, 0.0)])
        centre = np.broadcast_to(rest.T, (*x.shape[:-1], *rest.T.shape)).copy()
        centre[..., :ni, :] += np.einsum("jcak,...k->...jca", self.lean, d)
        sign = np.where(np.arange(len(self.offset)) < ni, 1.0, -1.0)[:, None]
        u = sign * (centre - x[..., None, :])
        length = np.hypot(u[..., 0], u[..., 1])
        return length, u / length[..., None], length - self.free

    # --- the convex problem -------------------------------------------------------------------

    def _derivatives(self, d: Array, x: Array, push: float) -> tuple[float, Array, Array, Array]:
        """Energy without −f·d, gradient, Hessian over (d, all X), and contact loads."""
        length, n, delta = self._reach(d, x)
        open_ = np.maximum(delta, 0.0)
        q = self.k * open_**1.5
        along = n[..., :, None] * n[..., None, :]
        block = 1.5 * (self.k * np.sqrt(open_))[..., None, None] * along
        block += (q / length)[..., None, None] * (np.eye(2) - along)
        z, ni = self.balls, self.ni
        size = 5 + 2 * z
        gradient, hessian = np.zeros(size), np.zeros((size, size))
        force = q[..., None] * n
        gradient[:5] = np.einsum("jcak,jca->k", self.lean, force[:, :ni])
        gradient[5:] = (force[:, ni:].sum(1) - force[:, :ni].sum(1) - [0.0, push]).ravel()
        turned = np.einsum("jcab,jcbk->jcak", block[:, :ni], self.lean)
        hessian[:5, :5] = np.einsum("jcal,jcak->lk", self.lean, turned)
        cross = -turned.sum(1)  # (z, 2, 5)
        hessian[5:, :5] = cross.reshape(2 * z, 5)
        hessian[:5, 5:] = hessian[5:, :5].T
        own = block.sum(1)
        for j in range(z):
            hessian[5 + 2 * j : 7 + 2 * j, 5 + 2 * j : 7 + 2 * j] = own[j]
        energy = float(0.4 * (self.k * open_**2.5).sum() - push * x[:, 1].sum())
        return energy, gradient, hessian, q

    def _minimise(
        self, load: Array, free: NDArray[np.bool_], d: Array, x: Array, push: float
    ) -> tuple[Array, Array]:
        """(d, X) in µm of the least energy, the components of d that are not free held."""
        moving = np.concatenate([np.flatnonzero(free), 5 + np.arange(2 * self.balls)])
        v, shift, still = np.concatenate([d, x.ravel()]), 1e-3, 0

        def slopes(v: Array) -> tuple[Array, Array, Array]:
            _, g, h, q = self._derivatives(v[:5], v[5:].reshape(-1, 2), push)
            g[:5] -= np.where(free, load, 0.0)
            return g[moving], h[np.ix_(moving, moving)], q

        g, h, q = slopes(v)
        best = math.inf
        for _ in range(2000):
            size = max(q.max(), push, float(np.abs(load[free]).max(initial=0.0)) / self.balls, 1e-6)
            error = float(np.abs(g).max()) / size
            still = 0 if error < 0.5 * best else still + 1
            best = min(best, error)
            if error < 3e-15 or (error < 1e-12 and still > 3):
                return v[:5], v[5:].reshape(-1, 2)
            stiff = max(float(np.diag(h).max()), 1e-3 * size)
            p = -np.linalg.solve(h + shift * stiff * np.eye(len(g)), g)
            p *= min(1.0, LONGEST / max(float(np.abs(p).max()), 1e-300))
            slope, step = float(g @ p), 1.0
            for _ in range(40):
                trial = v.copy()
                trial[moving] += step * p
                g2, h2, q2 = slopes(trial)
                if g2 @ p <= -0.5 * slope or step * np.abs(p).max() < 1e-11:
                    break
                step *= 0.5
            v, g, h, q = trial, g2, h2, q2
            shift = max(0.1 * shift, 1e-13) if step == 1.0 else min(4.0 * shift, 1.0)
        if best < 1e-9:
            return v[:5], v[5:].reshape(-1, 2)
        raise OracleFailure(f"the energy is not at its minimum: {best:g} of the load")

    # --- forces that follow the resultants ----------------------------------------------------

    def motion(
        self, qi: Array, qo: Array, ai: Array, ao: Array, speed: Any, blend: float = 1.0
    ) -> tuple[Array, Array, Array, Array]:
        """(Fc, Mg, λi, ωm/ω) of balls from size and direction of the resultant on each race.

        A ball without load on the inner race rolls about an axis parallel to the bearing's.
        """
        lost = qi <= 0.0
        rate = self.races[0].torque / self.races[1].torque
        c = (qi / np.maximum(qo, 1e-30)) ** (4.0 / 3.0) * rate
        orbit, spin, beta = rolling(ai, ao, self.gamma, c, self.kinematics)
        alone = rolling(ai, 0.0 * ao, self.gamma, 0.0 * c, "outer")[0]
        orbit = np.where(lost, alone, orbit)
        inertia = self.mass * self.drawing.ball_diameter**2 / 10.0
        mg = np.where(lost, 0.0, blend * inertia * speed**2 * orbit * spin * np.sin(beta))
        full = 0.5 * self.mass * self.drawing.pitch_diameter * (speed * orbit) ** 2
        share = {"equal": 1.0, "outer": 0.0, "inner": 2.0, "hybrid": 2.0 * c / (1.0 + c)}
        fc = blend * full + (1.0 - blend) * self.frozen_push(speed)
        return fc, mg, share[self.moment_sharing] + 0.0 * c, orbit

    def _actions(self, d: Array, x: Array, speed: float, blend: float) -> Actions:
        """All forces at given unknowns; ``blend`` 0: frozen, 1: full."""
        ni, b = self.ni, self.drawing
        _, n, delta = self._reach(d, x)
        q = self.k * np.maximum(delta, 0.0) ** 1.5
        force = q[..., None] * n
        inner, outer = force[..., :ni, :].sum(-2), force[..., ni:, :].sum(-2)
        qi, qo = np.hypot(inner[..., 0], inner[..., 1]), np.hypot(outer[..., 0], outer[..., 1])
        lost = qi <= 0.0
        nearest = np.argmax(delta[..., :ni], axis=-1)[..., None, None]
        idle = np.take_along_axis(n[..., :ni, :], nearest, axis=-2)[..., 0, :]
        ai = np.where(
            lost, np.arctan2(idle[..., 0], idle[..., 1]), np.arctan2(inner[..., 0], inner[..., 1])
        )
        ao = np.where(lost, 0.0, np.arctan2(outer[..., 0], outer[..., 1]))
        fc, mg, li, orbit = self.motion(qi, qo, ai, ao, speed, blend)
        ti, to = li * mg / b.ball_diameter, (2.0 - li) * mg / b.ball_diameter
        grip = np.stack([ti * np.cos(ai), -ti * np.sin(ai)], -1)
        balance = inner - outer + grip - np.stack([to * np.cos(ao), -to * np.sin(ao)], -1)
        balance[..., 1] += fc
        # friction acts on the line of the resultant: shared as the radial forces of the arcs
        radial = force[..., :ni, 1]
        part = radial / np.where(lost, 1.0, radial.sum(-1))[..., None]
        pressed = force[..., :ni, :] + part[..., None] * grip[..., None, :]
        ring = np.einsum("jcak,...jca->...k", self.lean, pressed)
        twist = li * b.inner_conformity * mg / (self.radius * MICROMETRE)
        ring[..., 3] -= (twist * np.sin(self.psi)).sum(-1)
        ring[..., 4] += (twist * np.cos(self.psi)).sum(-1)
        return Actions(q, n, inner, balance, ring, fc, mg, orbit)

    def _balance(
        self,
        load: Array,
        free: NDArray[np.bool_],
        v: Array,
        speed: float,
        blend: float,
    ) -> Array:
        """The balances in the free components of the ring and of all balls at ``v`` by Newton."""
        moving = np.concatenate([np.flatnonzero(free), 5 + np.arange(2 * self.balls)])

        def faults(v: Array) -> Array:
            got = self._actions(v[..., :5], v[..., 5:].reshape(*v.shape[:-1], -1, 2), speed, blend)
            ring = (load - got.ring)[..., free]
            return np.concatenate([ring, got.balance.reshape(*v.shape[:-1], -1)], axis=-1)

        r = faults(v)
        size = max(float(np.abs(load[free]).max(initial=0.0)) / self.balls, self.frozen_push(speed))
        still, best = 0, math.inf
        for _ in range(100):
            error = float(np.abs(r).max()) / size
            still = 0 if error < 0.5 * best else still + 1
            best = min(best, error)
            if error < 3e-14 or (error < 1e-11 and still > 3):
                return v
            jacobian = self._differences(faults, v, moving)
            p = -np.linalg.solve(jacobian, r)
            p *= min(1.0, LONGEST / float(np.abs(p).max()))
            step = 1.0
            for _ in range(30):
                trial = v.copy()
                trial[moving] += step * p
                r2 = faults(trial)
                if np.linalg.norm(r2) < (1.0 - 0.1 * step) * np.linalg.norm(r):
                    break
                step *= 0.5
            v, r = trial, r2
        raise OracleFailure(f"balls are out of balance: {best:g} of the load")

    @staticmethod
    def _differences(faults: Any, v: Array, moving: NDArray[np.intp], step: float = 1e-4) -> Array:
        """Central differences over the moving unknowns, all points in one call."""
        moves = np.zeros((len(moving), v.size))
        moves[np.arange(len(moving)), moving] = step
        return np.asarray((faults(v + moves) - faults(v - moves)).T / (2.0 * step))

    # --- questions ----------------------------------------------------------------------------

    def solve(
        self,
        *,
        load: ArrayLike | None = None,
        displacement: ArrayLike | None = None,
        speed: float = 0.0,
        dynamics: str = "frozen",
        steps: int = STEPS,
    ) -> Found:
        """One state; of each pair of load and displacement one is a number, the other NaN."""
        nothing = np.full(5, np.nan)
        f = np.asarray(nothing if load is None else load, float) / self.lever
        held = np.asarray(nothing if displacement is None else displacement, float) / self.scale
        free = np.isnan(held)
        d, f = np.where(free, 0.0, held), np.where(free, f, 0.0)
        push = self.frozen_push(speed)
        x = np.tile([0.0, self._seat()], (self.balls, 1))
        d, x = self._minimise(f, free, d, x, push)
        blend = 0.0
        if dynamics == "resultant" and speed != 0.0:
            v = np.concatenate([d, x.ravel()])
            for blend in np.arange(1, steps + 1) / steps:
                v = self._balance(f, free, v, speed, blend)
            d, x = v[:5], v[5:].reshape(-1, 2)
        return self._found(f, free, d, x, speed, blend)

    def _seat(self) -> float:
        """X2 of a ball that just touches the centred outer ring [µm]."""
        return math.sqrt(self.free[-1] ** 2 - self.offset[-1] ** 2)

    def _found(
        self, f: Array, free: NDArray[np.bool_], d: Array, x: Array, speed: float, blend: float
    ) -> Found:
        got = self._actions(d, x, speed, blend)
        ring = np.where(free, f - got.ring, 0.0)
        size = max(got.load.max(), got.push.max(), 1e-300)
        worst = max(np.abs(got.balance).max() / size, np.abs(ring).max() / size / self.balls)
        angle = np.arctan2(self.side * got.normal[..., 0], got.normal[..., 1])
        h = self._derivatives(d, x, self.frozen_push(speed))[2]
        k = h[:5, :5] - h[:5, 5:] @ np.linalg.pinv(h[5:, 5:], rcond=1e-13) @ h[5:, :5]
        return Found(
            load=got.ring * self.lever,
            displacement=d * self.scale,
            contact_load=got.load,
            contact_angle=np.where(got.load > 0.0, angle, np.nan),
            inner_force=got.inner,
            centrifugal_force=got.push,
            gyroscopic_moment=got.moment,
            orbit=got.orbit,
            residual=float(worst),
            ball_centre=x * MICROMETRE,
            stiffness=k * self.lever[:, None] / self.scale,
        )


def _sides(shim: float | None) -> tuple[float, ...]:
    """Axial places of the groove centres [µm]: the arc on the −x side has its centre on the +x."""
    return (0.0,) if shim is None else (0.5 * shim / MICROMETRE, -0.5 * shim / MICROMETRE)


def _leverage(psi: Array, offset: Array, radius: float) -> Array:
    """∂(inner groove centre)/∂d (balls, inner contacts, 2, 5), angles times ``radius``."""
    c, s = np.cos(psi), np.sin(psi)
    lean = np.zeros((len(psi), len(offset), 2, 5))
    lean[:, :, 0, 0] = 1.0
    lean[:, :, 0, 3], lean[:, :, 0, 4] = s[:, None], -c[:, None]
    lean[:, :, 1, 1], lean[:, :, 1, 2] = c[:, None], s[:, None]
    lean[:, :, 1, 3] = -np.outer(s, offset) / radius
    lean[:, :, 1, 4] = np.outer(c, offset) / radius
    return lean
