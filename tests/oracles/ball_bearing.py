"""An independent angular-contact ball bearing, written to judge ``bearings`` and nothing else.

Nothing is shared with the product: four unknowns per ball (X1, X2, δi, δo) in the long form of
Jones and Harris, the displacement of the ring added as further unknowns when a load is given, all
solved together by MINPACK's hybrid Powell method with numerical Jacobians; rolling from the
no-slip equations themselves; elliptic integrals by numerical quadrature; the physical root by
brute force, in many small steps of speed from rest. Slow on purpose.

``moment_sign=-1`` is the literal, wrong sign of the gyroscopic moment that part of the published
results need (Noël 2013); it exists only here.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import quad
from scipy.optimize import brentq, root

MICROMETRE = 1e-6
FORCE = 100.0


class OracleFailure(RuntimeError):
    """The brute-force continuation did not arrive."""


@lru_cache
def elliptic(kappa: float) -> tuple[float, float]:
    """Complete integrals (first, second kind) of modulus² 1 − 1/κ², by quadrature."""
    m = 1.0 - kappa**-2
    first = quad(lambda t: (1.0 - m * math.sin(t) ** 2) ** -0.5, 0.0, math.pi / 2, epsabs=1e-13)
    second = quad(lambda t: (1.0 - m * math.sin(t) ** 2) ** 0.5, 0.0, math.pi / 2, epsabs=1e-13)
    return first[0], second[0]


def hertz(curvature_sum: float, difference: float) -> tuple[float, float, float, float]:
    """κ, a*, b*, δ* of Harris ch. 6 for a curvature difference F(ρ)."""

    def fault(kappa: float) -> float:
        f, e = elliptic(kappa)
        return ((kappa**2 + 1.0) * e - 2.0 * f) / ((kappa**2 - 1.0) * e) - difference

    kappa = float(brentq(fault, 1.0 + 1e-6, 200.0, xtol=1e-13, rtol=1e-14))
    f, e = elliptic(kappa)
    a = (2.0 * kappa**2 * e / math.pi) ** (1 / 3)
    b = (2.0 * e / (math.pi * kappa)) ** (1 / 3)
    delta = 2.0 * f / math.pi * (math.pi / (2.0 * kappa**2 * e)) ** (1 / 3)
    return kappa, a, b, delta


@dataclass(frozen=True)
class Race:
    """k [N/m^1.5], a/Q^(1/3) [m/N^(1/3)] and E of one contact."""

    k: float
    a1: float
    e: float
    b1: float


def race(bearing: Any, side: int) -> Race:
    """Ball on the inner (+1) or outer (−1) race of a described bearing."""
    d, alpha = bearing.ball_diameter, bearing.contact_angle
    f = bearing.inner_conformity if side > 0 else bearing.outer_conformity
    g = d * math.cos(alpha) / bearing.pitch_diameter
    rolling = 2.0 / d * g / (1.0 - g) if side > 0 else -2.0 / d * g / (1.0 + g)
    groove = -1.0 / (f * d)
    total = 4.0 / d + rolling + groove
    kappa, a, b, delta = hertz(total, (rolling - groove) / total)
    compliance = sum(
        (1.0 - m.poisson_ratio**2) / m.young_modulus
        for m in (bearing.ball_material, bearing.ring_material)
    )
    size = (3.0 * compliance / (2.0 * total)) ** (1 / 3)
    k = (delta * size**2 * total / 2.0) ** -1.5
    return Race(k, a * size, elliptic(kappa)[1], b * size)


def rolling(
    ai: Any, ao: Any, g: float, c: Any, kinematics: str
) -> tuple[NDArray, NDArray, NDArray]:
    """(ωm/ω, |ωR/ω|, β) from no slip at both contacts and one hypothesis on the axis of the ball.

    Seen from the cage, no slip says  ωm (1 + γ cos αo) = γ ωR cos(αo − β)  and
    (ω − ωm)(1 − γ cos αi) = γ ωR cos(αi − β); no spin at a race says that the relative rotation
    there lies in the tangent plane.
    """
    if kinematics == "outer":
        beta = ao - np.arctan2(g * np.sin(ao), 1.0 + g * np.cos(ao))
    elif kinematics == "inner":
        beta = ai + np.arctan2(g * np.sin(ai), 1.0 - g * np.cos(ai))
    elif kinematics == "geometric":
        beta = 0.5 * (ai + ao)
    else:
        s = (1.0 + g * np.cos(ao)) / (1.0 - g * np.cos(ai))
        extra = g * c * (np.cos(ai - ao) - s)
        beta = np.arctan2(
            c * (s + 1.0) * np.sin(ai) + 2.0 * np.sin(ao),
            c * (s + 1.0) * np.cos(ai) + 2.0 * (np.cos(ao) + g) + extra,
        )
    outer = g * np.cos(ao - beta) / (1.0 + g * np.cos(ao))
    inner = g * np.cos(ai - beta) / (1.0 - g * np.cos(ai))
    spin = 1.0 / (outer + inner)
    return outer * spin, spin, beta


@dataclass(frozen=True)
class OracleState:
    """What the oracle found; per-ball arrays of shape (balls,), SI."""

    load: NDArray
    displacement: NDArray
    inner_load: NDArray
    outer_load: NDArray
    inner_angle: NDArray
    outer_angle: NDArray
    centrifugal_force: NDArray
    gyroscopic_moment: NDArray
    outer_ring_load: NDArray
    unknowns: NDArray


class BallBearingOracle:
    """One bearing under one set of assumptions; ``bearing`` is read for its numbers only."""

    def __init__(
        self,
        bearing: Any,
        *,
        kinematics: str = "hybrid",
        moment_sharing: str = "equal",
        static_growth: float = 0.0,
        growth: float | None = None,
        moment_sign: int = 1,
        frozen_loads: OracleState | None = None,
    ) -> None:
        self.bearing, self.kinematics, self.sharing = bearing, kinematics, moment_sharing
        self.sign, self.frozen = moment_sign, frozen_loads
        d, fi, fo = bearing.ball_diameter, bearing.inner_conformity, bearing.outer_conformity
        self.d, self.g = d, d / bearing.pitch_diameter
        self.li, self.lo, self.bd = (fi - 0.5) * d, (fo - 0.5) * d, (fi + fo - 1.0) * d
        self.inner, self.outer = race(bearing, +1), race(bearing, -1)
        self.kn = (self.inner.k ** (-2 / 3) + self.outer.k ** (-2 / 3)) ** -1.5
        alpha = bearing.contact_angle
        self.ri = bearing.pitch_diameter / 2 + self.li * math.cos(alpha)
        start = math.acos(math.cos(alpha) + static_growth / self.bd)
        self.a1, self.a2 = self.bd * math.sin(start), self.bd * math.cos(alpha)
        self.du = static_growth if growth is None else growth
        self.mass = bearing.ball_material.density * math.pi * d**3 / 6.0
        self.inertia = self.mass * d**2 / 10.0

    def azimuths(self, single: bool = False) -> NDArray:
        """ψ of the balls, or of one ball that represents all."""
        return (
            np.zeros(1)
            if single
            else 2 * np.pi / self.bearing.balls * np.arange(self.bearing.balls)
        )

    def centres(self, d: NDArray, psi: NDArray) -> tuple[NDArray, NDArray]:
        """(A1, A2): inner groove centre from the outer one at every ball."""
        c, s = np.cos(psi), np.sin(psi)
        a1 = self.a1 + d[0] - d[4] * self.ri * c + d[3] * self.ri * s
        return a1, self.a2 + d[1] * c + d[2] * s + self.du

    def ball(self, x: NDArray, a1: NDArray, a2: NDArray, speed: float) -> dict[str, NDArray]:
        """Everything at the balls from X1, X2, δi, δo (rows of ``x``)."""
        x1, x2, di, do = x
        ai, ao = np.arctan2(a1 - x1, a2 - x2), np.arctan2(x1, x2)
        qi = self.inner.k * np.maximum(di, 0.0) ** 1.5
        qo = self.outer.k * np.maximum(do, 0.0) ** 1.5
        # C = Qi ai Ei / (Qo ao Eo), a = a1 Q^(1/3)
        c = (
            (qi / np.maximum(qo, 1e-30)) ** (4 / 3)
            * (self.inner.a1 * self.inner.e)
            / (self.outer.a1 * self.outer.e)
        )
        orbit, spin, beta = rolling(ai, ao, self.g, c, self.kinematics)
        lost = qi <= 0.0
        free_orbit, _, _ = rolling(ai, 0.0 * ao, self.g, 0.0 * c, "outer")
        orbit = np.where(lost, free_orbit, orbit)
        fc = 0.5 * self.mass * self.bearing.pitch_diameter * (speed * orbit) ** 2
        mg = self.sign * self.inertia * speed**2 * orbit * spin * np.sin(beta)
        mg = np.where(lost, 0.0, mg)
        if self.frozen is not None:
            fc, mg = self.frozen.centrifugal_force, self.frozen.gyroscopic_moment
        share = {"equal": 1.0, "outer": 0.0, "inner": 2.0, "hybrid": 2.0 * c / (1.0 + c)}
        return dict(ai=ai, ao=ao, qi=qi, qo=qo, fc=fc, mg=mg, lam=share[self.sharing] + 0.0 * c)

    def residual(self, x: NDArray, a1: NDArray, a2: NDArray, speed: float) -> NDArray:
        """Two Pythagoras and two force equations per ball, scaled; shape (4, balls)."""
        x1, x2, di, do = x
        b = self.ball(x, a1, a2, speed)
        li, lo = b["lam"], 2.0 - b["lam"]
        t = b["mg"] / self.d
        si, ci, so, co = np.sin(b["ai"]), np.cos(b["ai"]), np.sin(b["ao"]), np.cos(b["ao"])
        axial = b["qi"] * si - b["qo"] * so + t * (li * ci - lo * co)
        radial = b["qi"] * ci - b["qo"] * co - t * (li * si - lo * so) + b["fc"]
        return np.array(
            [
                ((a1 - x1) ** 2 + (a2 - x2) ** 2 - (self.li + di) ** 2)
                / (2 * self.li * MICROMETRE),
                (x1**2 + x2**2 - (self.lo + do) ** 2) / (2 * self.lo * MICROMETRE),
                axial / FORCE,
                radial / FORCE,
            ]
        )

    def ring_load(self, b: dict[str, NDArray], psi: NDArray) -> NDArray:
        """(Fx, Fy, Fz, My, Mz) on the inner ring, summed ball by ball as forces and moments."""
        t = b["lam"] * b["mg"] / self.d
        fa = b["qi"] * np.sin(b["ai"]) + t * np.cos(b["ai"])
        fr = b["qi"] * np.cos(b["ai"]) - t * np.sin(b["ai"])
        m = self.ri * fa - b["lam"] * self.bearing.inner_conformity * b["mg"]
        c, s = np.cos(psi), np.sin(psi)
        return np.array([fa.sum(), fr @ c, fr @ s, m @ s, -(m @ c)])

    def outer_ring_load(self, b: dict[str, NDArray], psi: NDArray) -> NDArray:
        """(Fx, Fy, Fz) on the outer ring."""
        t = (2.0 - b["lam"]) * b["mg"] / self.d
        fa = b["qo"] * np.sin(b["ao"]) + t * np.cos(b["ao"])
        fr = b["qo"] * np.cos(b["ao"]) - t * np.sin(b["ao"])
        return np.array([fa.sum(), fr @ np.cos(psi), fr @ np.sin(psi)])

    def seated(self, a1: NDArray, a2: NDArray, first_speed: float = 0.0) -> NDArray:
        """X1, X2, δi, δo near rest: on the line of centres where loaded, else see ``_loose``."""
        reach = np.hypot(a1, a2)
        series = np.maximum(reach - self.bd, 0.0)
        di = series * (self.kn / self.inner.k) ** (2 / 3)
        do = series * (self.kn / self.outer.k) ** (2 / 3)
        along = np.where(series > 0, self.lo + do, 0.0)
        x = np.array([along * a1 / reach, along * a2 / reach, di, do])
        for j in np.flatnonzero(series <= 0.0):
            x[:, j] = self._loose(a1[j], a2[j], first_speed)
        return x

    def _loose(self, a1: float, a2: float, speed: float) -> NDArray:
        """A ball that only Fc loads: at the bottom of the outer groove if the inner race lets it,
        else where both races hold it; lengths and loads by fixed point, Mg neglected."""
        fc = 0.5 * self.mass * self.bearing.pitch_diameter * (0.42 * speed) ** 2
        di = do = 0.0
        for _ in range(60):
            li, lo, r = self.li + di, self.lo + do, math.hypot(a1, a2)
            if math.hypot(a1, a2 - lo) <= li:
                do = (fc / self.outer.k) ** (2 / 3)
                x = np.array([0.0, self.lo + do])
                return np.array([*x, math.hypot(a1, a2 - x[1]) - self.li, do])
            along = (r**2 + lo**2 - li**2) / (2 * r)
            across = math.sqrt(max(lo**2 - along**2, 0.0))
            ends = ((along * a1 - n * across * a2, along * a2 + n * across * a1) for n in (1, -1))
            x = np.array(max(ends, key=lambda p: p[1])) / r
            ai, ao = math.atan2(a1 - x[0], a2 - x[1]), math.atan2(x[0], x[1])
            forces = np.array([[math.sin(ai), -math.sin(ao)], [math.cos(ai), -math.cos(ao)]])
            qi, qo = np.maximum(np.linalg.solve(forces, [0.0, -fc]), 0.0)
            di, do = (qi / self.inner.k) ** (2 / 3), (qo / self.outer.k) ** (2 / 3)
        return np.array([*x, di, do])

    def from_displacement(self, d: ArrayLike, speed: float, steps: int = 40) -> OracleState:
        """Every ball on its own, followed from rest to ``speed``."""
        d, psi = np.asarray(d, float), self.azimuths()
        a1, a2 = self.centres(d, psi)
        x = self.seated(a1, a2, speed / steps)
        for j in range(len(psi)):
            x[:, j] = self._follow_ball(x[:, j], a1[j : j + 1], a2[j : j + 1], speed, steps)
        return self._state(x, d, psi, speed)

    def _follow_ball(
        self, x: NDArray, a1: NDArray, a2: NDArray, speed: float, steps: int
    ) -> NDArray:
        def fault(u: NDArray, w: float) -> NDArray:
            return self.residual((u * MICROMETRE)[:, None], a1, a2, w)[:, 0]

        if speed == 0.0:
            return x
        return _march(fault, x / MICROMETRE, speed, steps) * MICROMETRE

    def from_load(
        self, load: ArrayLike, speed: float, steps: int = 40, free: str = "xyzbc"
    ) -> OracleState:
        """Balls and ring together, followed from rest to ``speed`` under a constant load.

        ``free`` names the free displacements among x, y, z, b (θy), c (θz); the rest is blocked.
        """
        load, psi = np.asarray(load, float), self.azimuths(free == "x")
        count = self.bearing.balls / len(psi)
        index = ["xyzbc".index(k) for k in free]
        scale = np.array([1, 1, 1, 1 / self.ri, 1 / self.ri]) * MICROMETRE
        d = self._rest_displacement(load, psi, index, scale, count)
        a1, a2 = self.centres(d, psi)
        balls = self.seated(a1, a2, speed / steps)
        start = np.concatenate([balls.ravel() / MICROMETRE, (d / scale)[index]])

        def split(u: NDArray) -> tuple[NDArray, NDArray]:
            d = np.zeros(5)
            d[index] = u[4 * len(psi) :] * scale[index]
            return u[: 4 * len(psi)].reshape(4, -1) * MICROMETRE, d

        def fault(u: NDArray, w: float) -> NDArray:
            x, d = split(u)
            a1, a2 = self.centres(d, psi)
            got = count * self.ring_load(self.ball(x, a1, a2, w), psi) - load
            balls = self.residual(x, a1, a2, w).ravel()
            return np.concatenate([balls, (got * scale / MICROMETRE / FORCE)[index]])

        end = start if speed == 0.0 else _march(fault, start, speed, steps)
        x, d = split(end)
        return self._state(x, d, psi, speed)

    def _rest_displacement(
        self, load: NDArray, psi: NDArray, index: list[int], scale: NDArray, count: float
    ) -> NDArray:
        """Ring displacement at rest, balls eliminated: Q = kn (|A| − BD)^1.5 along A."""

        def fault(u: NDArray, share: float) -> NDArray:
            d = np.zeros(5)
            d[index] = u * scale[index]
            a1, a2 = self.centres(d, psi)
            reach = np.hypot(a1, a2)
            q = self.kn * np.maximum(reach - self.bd, 0.0) ** 1.5
            angle = np.arctan2(a1, a2)
            b = dict(qi=q, ai=angle, mg=0.0 * q, lam=1.0 + 0.0 * q)
            got = count * self.ring_load(b, psi) - load * share
            return (got * scale / MICROMETRE / FORCE)[index]

        u = np.array([30.0 if i == 0 else 0.0 for i in index])
        thrust = np.array([load[0], 0, 0, 0, 0])
        return self._expand(_rest_march(fault, u, load, thrust), index, scale)

    @staticmethod
    def _expand(u: NDArray, index: list[int], scale: NDArray) -> NDArray:
        d = np.zeros(5)
        d[index] = u * scale[index]
        return d

    def _state(self, x: NDArray, d: NDArray, psi: NDArray, speed: float) -> OracleState:
        a1, a2 = self.centres(d, psi)
        b = self.ball(x, a1, a2, speed)
        count = self.bearing.balls / len(psi)
        return OracleState(
            load=count * self.ring_load(b, psi),
            displacement=d,
            inner_load=b["qi"],
            outer_load=b["qo"],
            inner_angle=b["ai"],
            outer_angle=b["ao"],
            centrifugal_force=b["fc"],
            gyroscopic_moment=b["mg"],
            outer_ring_load=count * self.outer_ring_load(b, psi),
            unknowns=x,
        )

    def stiffness(self, at: OracleState, speed: float) -> NDArray:
        """∂f/∂d (5, 5) by central differences of the balls' balance about a known state."""
        psi = self.azimuths()
        x0 = np.broadcast_to(at.unknowns, (4, len(psi)))
        step = np.array([1, 1, 1, 1 / self.ri, 1 / self.ri]) * 2e-9
        columns = []
        for j in range(5):
            ends = []
            for sign in (1.0, -1.0):
                d = at.displacement + sign * step * (np.arange(5) == j)
                a1, a2 = self.centres(d, psi)
                x = self._polish(x0.copy(), a1, a2, speed)
                ends.append(self.ring_load(self.ball(x, a1, a2, speed), psi))
            columns.append((ends[0] - ends[1]) / (2 * step[j]))
        return np.array(columns).T

    def _polish(self, x: NDArray, a1: NDArray, a2: NDArray, speed: float) -> NDArray:
        """Newton per ball with numerical Jacobians, from a point next to the solution."""
        for _ in range(6):
            r = self.residual(x, a1, a2, speed)
            jac = np.empty((len(a1), 4, 4))
            for k in range(4):
                h = 1e-10
                up, down = x.copy(), x.copy()
                up[k] += h
                down[k] -= h
                slope = self.residual(up, a1, a2, speed) - self.residual(down, a1, a2, speed)
                jac[:, :, k] = slope.T / (2 * h)
            x = x - np.linalg.solve(jac, r.T[:, :, None])[:, :, 0].T
        return x


def _march(fault: Any, start: NDArray, speed: float, steps: int) -> NDArray:
    """Follow ``fault(u, w) = 0`` from rest: equal steps of w², tangent by the last two points."""
    last, u = start, start
    for n in range(1, steps + 1):
        w = speed * n / steps
        guess = u if n <= 2 else 2 * u - last
        found = root(fault, guess, args=(w,), method="hybr", options={"xtol": 1e-13})
        if np.abs(found.fun).max() > 1e-7:
            found = root(fault, u, args=(w,), method="lm", options={"xtol": 1e-14, "ftol": 1e-15})
        if np.abs(found.fun).max() > 1e-7:
            raise OracleFailure(f"residual {np.abs(found.fun).max():.2e} at {w:.5g} rad/s")
        last, u = u, found.x
    return u


def _rest_march(fault: Any, u: NDArray, load: NDArray, thrust: NDArray) -> NDArray:
    """At rest the load is brought on from pure thrust, in steps as small as it needs."""
    names = np.where(load == 0.0, 1.0, load)
    done, stride, first = 0.0, 0.05, True
    while first or done < 1.0:
        target = done if first else min(1.0, done + stride)
        share = np.where(load == 0.0, 1.0, (thrust + (load - thrust) * target) / names)
        found = root(fault, u, args=(share,), method="hybr", options={"xtol": 1e-13})
        if np.abs(found.fun).max() < 1e-8:
            u, done, first = found.x, target, False
            stride *= 1.5
        elif first or stride < 1e-4:
            raise OracleFailure("no equilibrium at rest")
        else:
            stride /= 3
    return u
