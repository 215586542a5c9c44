"""The equations of a turning ball written once more, for many balls of many states at a time.

Nothing is shared with ``bearings``. Rolling comes from the rigid rotations seen from the cage: the
ball turns with p about an axis (cos β, sin β), each ring with its own rate, and no point of contact
slips. Elliptic integrals are SciPy's. The blend t leads from a frozen centrifugal force and no
gyroscopic moment (0) to the whole problem (1), as the theory page on solving defines it.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

Array = NDArray[np.float64]


class Contact(NamedTuple):
    """k [N/m^1.5], Q a E at unit load [m·N^(-1/3)], p_max at unit load [Pa/N^(1/3)]."""

    k: float
    torque: float
    pressure: float


def contact(bearing: Any, side: int) -> Contact:
    """Ball on the inner (+1) or outer (−1) race, after Johnson, *Contact Mechanics*, ch. 4."""
    d = bearing.ball_diameter
    f = bearing.inner_conformity if side > 0 else bearing.outer_conformity
    across = 1.0 / (d / 2.0) - 1.0 / (f * d)  # relative curvature along the groove's section
    g = d * math.cos(bearing.contact_angle) / bearing.pitch_diameter
    along = (2.0 / d) * (1.0 + side * g / (1.0 - side * g))
    modulus = 1.0 / sum(
        (1.0 - m.poisson_ratio**2) / m.young_modulus
        for m in (bearing.ball_material, bearing.ring_material)
    )

    def ratio(logarithm: float) -> float:
        """ln of B/A of an ellipse a/b = exp(logarithm), less that of the two bodies."""
        q = math.exp(logarithm)  # a/b
        m = 1.0 - q**-2
        first, second = ellipk(m), ellipe(m)
        found = (q**2 * second - first) / (first - second)
        return math.log(found) - math.log(along / across)

    q = math.exp(brentq(ratio, 1e-3, 12.0, xtol=1e-14, rtol=1e-14))
    m = 1.0 - q**-2
    first, second = float(ellipk(m)), float(ellipe(m))
    total = 0.5 * (across + along)
    a = (3.0 * q**2 * second / (2.0 * math.pi * modulus * total)) ** (1.0 / 3.0)
    approach = 3.0 * first / (2.0 * math.pi * modulus * a)
    return Contact(approach**-1.5, a * second, 1.5 * q / (math.pi * a * a))


class Balls:
    """What the balls of one bearing obey; every array has the balls last."""

    def __init__(self, bearing: Any, kinematics: str, sharing: str) -> None:
        b, d = bearing, bearing.ball_diameter
        self.bearing, self.kinematics, self.sharing = bearing, kinematics, sharing
        self.inner, self.outer = contact(b, +1), contact(b, -1)
        self.li, self.lo = (b.inner_conformity - 0.5) * d, (b.outer_conformity - 0.5) * d
        self.gamma = d / b.pitch_diameter
        self.mass = b.ball_material.density * math.pi / 6.0 * d**3
        self.inertia = 0.1 * self.mass * d * d
        self.radius = 0.5 * b.pitch_diameter + self.li * math.cos(b.contact_angle)
        self.psi = 2.0 * math.pi / b.balls * np.arange(b.balls)

    def centres(self, d: Array, static: Any, growth: Any) -> Array:
        """Inner groove centres (2, …, balls) of displacements (…, 5) and growths (…)."""
        b = self.bearing
        free = self.li + self.lo
        start = np.arccos(math.cos(b.contact_angle) + np.asarray(static) / free)
        dx, dy, dz, ty, tz = np.moveaxis(np.asarray(d)[..., None], -2, 0)
        c, s = np.cos(self.psi), np.sin(self.psi)
        axial = (free * np.sin(start))[..., None] + dx + self.radius * (ty * s - tz * c)
        radial = free * math.cos(b.contact_angle) + np.asarray(growth)[..., None] + dy * c + dz * s
        return np.array([axial, radial])

    def frozen_push(self, speed: Any) -> Array:
        """Fc at equal nominal angles."""
        orbit = 0.5 * (1.0 - self.gamma * math.cos(self.bearing.contact_angle)) * np.asarray(speed)
        return 0.5 * self.mass * self.bearing.pitch_diameter * orbit**2

    def loads(self, a: Array, x: Array, speed: Any, t: Any = 1.0) -> dict[str, Array]:
        """Everything a ball at X carries."""
        v = a - x
        ai, ao = np.arctan2(v[0], v[1]), np.arctan2(x[0], x[1])
        di, do = np.hypot(v[0], v[1]) - self.li, np.hypot(x[0], x[1]) - self.lo
        return self.at(ai, ao, di, do, speed, t)

    def at(
        self,
        ai: Array,
        ao: Array,
        di: Array,
        do: Array,
        speed: Any,
        t: Any = 1.0,
        *,
        signed: bool = False,
    ) -> dict[str, Array]:
        """The same from angles and approaches; ``signed``: a stretched contact pulls."""
        pull = np.sign if signed else (lambda q: (q > 0.0).astype(float))
        qi = pull(di) * self.inner.k * np.abs(di) ** 1.5
        qo = pull(do) * self.outer.k * np.abs(do) ** 1.5
        held = di != 0.0 if signed else di > 0.0
        friction_i = np.abs(qi) ** (4.0 / 3.0) * self.inner.torque
        friction_o = np.maximum(np.abs(qo), 1e-30) ** (4.0 / 3.0) * self.outer.torque
        c = friction_i / friction_o
        tan = np.where(held, self._axis(ai, ao, c), 0.0)
        beta = np.arctan(tan)
        # from the cage: the outer ring turns with −ωm, the inner with ω − ωm, the ball with p
        outer = self.gamma * np.cos(ao - beta) / (1.0 + self.gamma * np.cos(ao))  # ωm / p
        inner = self.gamma * np.cos(ai - beta) / (1.0 - self.gamma * np.cos(ai))  # (ω − ωm) / p
        spin = speed / (outer + inner)
        orbit = outer * spin
        full = 0.5 * self.mass * self.bearing.pitch_diameter * orbit**2
        fc = t * full + (1.0 - t) * self.frozen_push(speed)
        mg = t * self.inertia * orbit * spin * np.sin(beta)
        li = {"equal": 1.0 + 0.0 * c, "outer": 0.0 * c, "inner": 2.0 + 0.0 * c}.get(
            self.sharing, 2.0 * c / (1.0 + c)
        )
        return dict(ai=ai, ao=ao, di=di, do=do, qi=qi, qo=qo, fc=fc, mg=mg, share=li)

    def _axis(self, ai: Array, ao: Array, c: Array) -> Array:
        """tan β of the axis a ball turns about."""
        g = self.gamma
        if self.kinematics == "outer":
            return np.sin(ao) / (np.cos(ao) + g)
        if self.kinematics == "inner":
            return np.sin(ai) / (np.cos(ai) - g)
        if self.kinematics == "geometric":
            return np.tan(0.5 * (ai + ao))
        s = (1.0 + g * np.cos(ao)) / (1.0 - g * np.cos(ai))
        lean = c * (s + 1.0)
        below = lean * np.cos(ai) + 2.0 * (np.cos(ao) + g) + g * c * (np.cos(ai - ao) - s)
        return (lean * np.sin(ai) + 2.0 * np.sin(ao)) / below

    def forces(self, b: dict[str, Array]) -> tuple[Array, Array]:
        """Sum of forces on each ball (2, …), and (fa, fr, m) of each on the inner ring (3, …)."""
        d = self.bearing.ball_diameter
        ti, to = b["share"] * b["mg"] / d, (2.0 - b["share"]) * b["mg"] / d
        si, ci, so, co = np.sin(b["ai"]), np.cos(b["ai"]), np.sin(b["ao"]), np.cos(b["ao"])
        fa, fr = b["qi"] * si + ti * ci, b["qi"] * ci - ti * si
        moment = self.radius * fa - ti * d * self.bearing.inner_conformity
        balance = np.array([fa - b["qo"] * so - to * co, fr - b["qo"] * co + to * so + b["fc"]])
        return balance, np.array([fa, fr, moment])

    def ring_load(self, action: Array) -> Array:
        """(…, 5) of the balls' actions (3, …, balls)."""
        c, s = np.cos(self.psi), np.sin(self.psi)
        fa, fr, m = action
        parts = (fa.sum(-1), (fr * c).sum(-1), (fr * s).sum(-1), (m * s).sum(-1), -(m * c).sum(-1))
        return np.stack(parts, axis=-1)
