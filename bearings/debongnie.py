"""Closed approximation of a radially loaded ball bearing at high speed, after Debongnie (1992).

Balls feel their centrifugal force and touch both races in the middle plane; the load of a ball is
a power of its approach, and an integral around the ring replaces the sum over balls. Theory,
corrections and limits: ``docs/theory/debongnie.md``. Equation numbers are those of the report.

One ball: x = δ/δc − 1 and y = Qi/Fc, with δ approach of the rings at the ball, Qi load on the inner
race, Fc centrifugal force, δc = ke Fc^(2/3) the approach at which the ball just meets the inner
race. The compliances ki, ke are those of δ = k Q^(2/3).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from bearings.arguments import finite, real_numbers
from bearings.arrays import Array
from bearings.ball.law import check_name
from bearings.bearing import BALL_DIAMETER, BALLS, CONFORMITY, PITCH_DIAMETER, BallBearing
from bearings.errors import InvalidBearing, shown
from bearings.geometry import geometry
from bearings.life.rating import RADIAL_FACTOR, Insides
from bearings.measure import Measure, measured, refusals
from bearings.ring.operation import LARGEST

LOWEST, HIGHEST = 1e-2, 1e2  # range of x in which A and n hold
LIFE = 10.0 / 3.0  # w, exponent of load for a race that stands still under passing balls
VARIANTS = ("corrected", "original")
FITTED = 0.5527  # A at ki = ke as the report has it (8)
LEAST_SPEED = 1e-3  # rad/s
COMPLIANCE = Measure("number", "k of δ = k Q^(2/3), in m/N^(2/3)", 1e-12, 1e-3)
MASS = Measure("number", "mass of a ball, in kg", 1e-9, 1e3)
CLEARANCE = Measure("length", "diametral clearance, negative: interference", -0.1, 0.1, unit="mm")
SIZE_RATIO = Measure("number", "D/dm", 0.0, 1.0, open_low=True, open_high=True)


class PowerLaw(NamedTuple):
    """Factor A and exponent n of y = A xⁿ."""

    factor: Array | float
    exponent: Array | float

    def __call__(self, x: ArrayLike) -> Array:
        """y at x, 0 where x ≤ 0."""
        return np.asarray(self.factor * np.maximum(x, 0.0) ** self.exponent)


def deflection(y: ArrayLike, ratio: ArrayLike) -> Array:
    """x of a ball that carries ``y`` ≥ 0, exact (6); ``ratio`` is ki/ke. Broadcasts.

    InvalidBearing for y < 0, ratios not above zero, and non-finite numbers.
    """
    return _deflection(np.cbrt(_numbers("y", y, 0.0)) ** 2, _numbers("ratio", ratio))


def load(x: ArrayLike, ratio: ArrayLike) -> Array:
    """y of a ball pressed by ``x``, the inverse of ``deflection``; 0 where x ≤ 0. Broadcasts.

    InvalidBearing for ratios not above zero, and non-finite numbers.
    """
    from scipy.optimize import elementwise

    pressed = np.maximum(_numbers("x", x, -math.inf), 0.0)
    target, k = np.broadcast_arrays(pressed, _numbers("ratio", ratio))
    top = target / k * (1.0 + 1e-12)  # y^(2/3) if the outer race were rigid, beyond rounding
    root = elementwise.find_root(
        lambda t, x, k: _deflection(t, k) - x, (np.zeros_like(top), top), args=(target, k)
    )
    return np.asarray(root.x) ** 1.5


def _deflection(t: Array, ratio: Array) -> Array:
    """x at t = y^(2/3)."""
    return np.asarray(ratio * t + np.expm1(np.log1p(t**1.5) * (2.0 / 3.0)))


def power_law(ratio: ArrayLike, variant: str = "corrected") -> PowerLaw:
    """A and n for ki/ke = ``ratio`` > 0 in closed form (12 to 14); InvalidBearing for others.

    ``variant`` "original": with the digits of the report's table, at ki = ke those of its fit (8).
    """
    check_name("variant", variant, VARIANTS)
    k = _numbers("ratio", ratio)
    b = k + 0.537
    n = 1.0 / (2.0 / 3.0 + 0.08904 / b)
    if variant == "corrected":
        return PowerLaw(b**-n, n)
    n = np.round(n, 3)  # 1.380 at ki = ke as well
    factor = b**-n
    digit = 10.0 ** (3.0 - np.floor(np.log10(factor)))  # the last of four
    factor = np.round(factor * digit) / digit
    return PowerLaw(np.where(np.isclose(k, 1.0, rtol=1e-9), FITTED, factor), n)


class Distribution(NamedTuple):
    """Loads around a ring, each over Fc, of shape (…).

    ``zone`` θ0: half the angle of the loaded balls [rad]; ``inner_peak``: largest Qi; ``radial``:
    Fr/z; ``inner_mean``, ``outer_mean``: steady ball loads of the same life on either race.
    """

    zone: Array
    inner_peak: Array
    radial: Array
    inner_mean: Array
    outer_mean: Array


def distribution(peak: ArrayLike, law: PowerLaw, gap: float = 1.0) -> Distribution:
    """Loads of a ring whose most loaded ball has x = ``peak`` > 0, shape (…) (15 to 18, 31, 32).

    ``law`` may hold arrays that broadcast with ``peak``. ``gap`` > 0 is the displacement over δc
    at which the first ball is loaded: 1 without clearance, so that δc/δr = 1/(1 + peak);
    1 + clearance/(2 δc) with it. InvalidBearing where either is not above zero.
    """
    x = _numbers("peak", peak)[..., None]
    _check_positive("gap", gap)
    nodes, weights = np.polynomial.legendre.leggauss(48)
    turn = (nodes + 1.0) * math.pi / 4.0  # θ = θ0 sin(turn): smooth where the load zone ends
    zone = np.arccos(gap / (gap + x))
    angle, weight = zone * np.sin(turn), weights / 4.0 * zone * np.cos(turn)
    ball_law = PowerLaw(*(np.asarray(part)[..., None] for part in law))
    y = ball_law(x - (x + gap) * 2.0 * np.sin(angle / 2.0) ** 2)
    outside = 1.0 - zone[..., 0] / math.pi
    return Distribution(
        zone=zone[..., 0],
        inner_peak=law(x[..., 0]),
        radial=np.sum(weight * y * np.cos(angle), axis=-1),
        inner_mean=np.sum(weight * y**3, axis=-1) ** (1.0 / 3.0),
        outer_mean=(np.sum(weight * (1.0 + y) ** LIFE, axis=-1) + outside) ** (1.0 / LIFE),
    )


def peak(radial: ArrayLike, law: PowerLaw, gap: float = 1.0) -> Array:
    """x of the most loaded ball under Fr/(z Fc) = ``radial``, shape (…).

    NaN where it lies outside ``LOWEST`` to ``HIGHEST``, the range in which the power law holds.
    """
    from scipy.optimize import elementwise

    target, factor, exponent = np.broadcast_arrays(np.asarray(radial, float), *law)
    ends = (np.full_like(target, math.log(end)) for end in (LOWEST, HIGHEST))
    root = elementwise.find_root(
        lambda u, f, a, n: distribution(np.exp(u), PowerLaw(a, n), gap).radial / f - 1.0,
        tuple(ends),
        args=(target, factor, exponent),
    )
    return np.where(root.success, np.exp(root.x), np.nan)


def equivalent_factors(exponent: float = 1.5) -> tuple[float, float, float]:
    """Factors of z Q in P0, Pi and Pe, for a ring at rest with Q ∝ cosⁿ θ (20, 28).

    Radial loads at rest with the same largest ball load, or with the same life on either race
    (Lundberg and Palmgren 1947). Contacts at rest are Hertz', n = 1.5: 0.2288, 0.4068, 0.3895.
    InvalidBearing where n is not above zero.
    """
    _check_positive("exponent", exponent)
    radial = _mean_of_cosine(exponent + 1.0)
    inner = radial / _mean_of_cosine(3.0 * exponent) ** (1.0 / 3.0)
    return radial, inner, radial / _mean_of_cosine(LIFE * exponent) ** (1.0 / LIFE)


def race_weights(
    size_ratio: float, inner: float = 0.52, outer: float = 0.52
) -> tuple[float, float]:
    """(C/Ci)^w and (C/Ce)^w, which add up to 1 (21 to 26).

    ``size_ratio`` is D/dm; ``inner``, ``outer`` are groove radii over ball diameter. InvalidBearing
    unless 0 < D/dm < 1 and both conformities are above 0.5.
    """
    given = (SIZE_RATIO, "size_ratio", size_ratio), (CONFORMITY, "inner", inner)
    for measure, name, value in (*given, (CONFORMITY, "outer", outer)):
        if why := measure.refusal(name, value):
            raise InvalidBearing(why)
    ratio = RADIAL_FACTOR * Insides(size_ratio, 1, 1.0, inner, outer, 0.0).strength_ratio  # Ci/Ce
    return 1.0 / (1.0 + ratio**LIFE), 1.0 / (1.0 + ratio**-LIFE)


def _mean_of_cosine(power: float) -> float:
    """Mean around the ring of cosᵖ θ over the loaded half."""
    return math.gamma(power / 2.0 + 0.5) / math.gamma(power / 2.0 + 1.0) / math.sqrt(4.0 * math.pi)


@dataclass(frozen=True, slots=True)
class RadialRing:
    """Data of a bearing that the approximation needs.

    ``inner_compliance``, ``outer_compliance``: ki, ke of δ = k Q^(2/3) [m/N^(2/3)]; ``ball_mass``
    [kg]; diameters [m]; conformities: groove radii over ball diameter; ``clearance``: diametral,
    negative for interference [m]. Raises InvalidBearing for impossible numbers.
    """

    inner_compliance: float = measured(COMPLIANCE)
    outer_compliance: float = measured(COMPLIANCE)
    balls: int = measured(BALLS)
    ball_mass: float = measured(MASS)
    ball_diameter: float = measured(BALL_DIAMETER)
    pitch_diameter: float = measured(PITCH_DIAMETER)
    inner_conformity: float = measured(CONFORMITY, 0.52)
    outer_conformity: float = measured(CONFORMITY, 0.52)
    clearance: float = measured(CLEARANCE, 0.0)

    def __post_init__(self) -> None:
        for why in refusals(self):
            raise InvalidBearing(why)
        if self.ball_diameter >= self.pitch_diameter:
            raise InvalidBearing("ball_diameter must be below pitch_diameter: is the unit right?")

    @classmethod
    def of(cls, bearing: BallBearing) -> RadialRing:
        """Build from a bearing of any kind; InvalidBearing where balls do not run mid-groove."""
        grooves = bearing.grooves
        if len(grooves.raceways) != 2 or (grooves.touching and grooves.free_angle > 0.0):
            raise InvalidBearing(
                "the approximation applies to balls that run in the middle of one groove per ring: "
                "give a deep-groove bearing, or a contact angle of 0"
            )
        g = geometry(grooves)
        return cls(
            inner_compliance=g.inner.stiffness ** (-2.0 / 3.0),
            outer_compliance=g.outer.stiffness ** (-2.0 / 3.0),
            balls=g.balls,
            ball_mass=g.ball_mass,
            ball_diameter=g.ball_diameter,
            pitch_diameter=g.pitch_diameter,
            inner_conformity=g.inner_conformity,
            outer_conformity=g.outer_conformity,
            clearance=2.0 * (grooves.free_distance - grooves.radial_gap),
        )

    @property
    def size_ratio(self) -> float:
        """γ = D/dm."""
        return self.ball_diameter / self.pitch_diameter

    def centrifugal_force(self, speed: float) -> float:
        """Fc = m ω² dm/2 of a ball, its orbit at ω = (1 − γ)/2 times ``speed`` [rad/s]."""
        orbit = 0.5 * (1.0 - self.size_ratio) * speed
        return self.ball_mass * orbit**2 * self.pitch_diameter / 2.0


@dataclass(frozen=True, slots=True)
class Approximation:
    """Solution for a loaded ring: ``displacement`` δr [m], ``zone`` θ0 [rad], forces [N].

    The displacement of the original variant keeps the misprinted δc and is absurd as a length.

    ``peak``: x of the most loaded ball, whose loads are ``inner_peak`` and ``outer_peak``.
    ``static_equivalent`` P0 and ``dynamic_equivalent`` P: radial loads at rest with the same
    largest ball load and with the same life.
    """

    displacement: float
    zone: float
    peak: float
    centrifugal_force: float
    inner_peak: float
    outer_peak: float
    static_equivalent: float
    dynamic_equivalent: float


def approximate(
    ring: RadialRing | BallBearing, load: float, speed: float, variant: str = "corrected"
) -> Approximation:
    """Solve a ring under a radial ``load`` [N] while its inner ring turns at ``speed`` [rad/s].

    ``variant`` "original" keeps what is wrong in the report: Fc = m ω² D/2, ω half the speed,
    δc = (Fc/ke)^(2/3) and P0 = 0.2334 z Q; it has no clearance. Its displacement keeps the misprint
    of δc and is absurd as a length (metres). Its loads have the digits of the report's tables, of
    which every column is rounded to four significant digits and computed from rounded ones.

    Raises
    ------
    InvalidBearing : unknown variant, numbers not above zero, a clearance that the variant cannot
        take, or a load at which x of the most loaded ball leaves 0.01 to 100
    """
    if not isinstance(ring, RadialRing | BallBearing):
        raise InvalidBearing(f"ring must be a RadialRing or a bearing, got {shown(ring)}")
    ring = ring if isinstance(ring, RadialRing) else RadialRing.of(ring)
    _check_positive("load", load)
    _check_positive("speed", speed)
    if not LEAST_SPEED <= speed <= LARGEST["speed"]:
        raise InvalidBearing(
            f"speed {speed:g} rad/s must lie from {LEAST_SPEED:g} to {LARGEST['speed']:g}: the "
            "approximation applies to balls under centrifugal force"
        )
    check_name("variant", variant, VARIANTS)
    force, seated = _constants(ring, speed, variant)
    gap = 1.0 + ring.clearance / (2.0 * seated)
    if gap <= 0.0:
        raise InvalidBearing(
            f"interference of {-ring.clearance:g} m compresses every ball (2 δc = {2 * seated:g} "
            "m): solve the full ring instead"
        )
    law = power_law(ring.inner_compliance / ring.outer_compliance, variant)
    x = float(peak(load / (ring.balls * force), law, gap))
    if math.isnan(x):
        ends = (distribution(end, law, gap).radial for end in (LOWEST, HIGHEST))
        low, high = (float(end) * ring.balls * force for end in ends)
        raise InvalidBearing(
            f"a load of {load:g} N lies outside {low:g} to {high:g} N, the range of the "
            "approximation at this speed: solve the full ring instead"
        )
    around = distribution(x, law, gap)
    weights = race_weights(ring.size_ratio, ring.inner_conformity, ring.outer_conformity)
    inner, outer, static, dynamic = (_tabulated if variant == "original" else _loads)(
        around, weights
    )
    return Approximation(
        displacement=seated * (gap + x),
        zone=float(around.zone),
        peak=x,
        centrifugal_force=force,
        inner_peak=force * inner,
        outer_peak=force * outer,
        static_equivalent=load * static,
        dynamic_equivalent=load * dynamic,
    )


def _constants(ring: RadialRing, speed: float, variant: str) -> tuple[float, float]:
    """Fc [N] and δc [m] in a variant."""
    if variant == "corrected":
        force = ring.centrifugal_force(speed)
        return force, ring.outer_compliance * force ** (2.0 / 3.0)
    if ring.clearance:
        raise InvalidBearing("the original variant has no clearance: take the corrected one")
    force = ring.ball_mass * (0.5 * speed) ** 2 * ring.ball_diameter / 2.0
    return force, (force / ring.outer_compliance) ** (2.0 / 3.0)


Loads = tuple[float, float, float, float]  # Qi and Qe of the most loaded ball/Fc, P0/Fr, P/Fr


def _loads(around: Distribution, weights: tuple[float, float]) -> Loads:
    """Loads of the corrected variant (17, 19, 20, 27, 28)."""
    static, *factors = equivalent_factors()
    inner, radial = float(around.inner_peak), float(around.radial)
    races = np.array(factors) * [around.inner_mean, around.outer_mean] / radial
    dynamic = float(np.dot(weights, races**LIFE) ** (1.0 / LIFE))
    return inner, 1.0 + inner, static * (1.0 + inner) / radial, dynamic


def _tabulated(around: Distribution, weights: tuple[float, float]) -> Loads:
    """Loads with the factors and the digits of the report: each from columns rounded before."""
    inner, outer = _four(around.inner_peak), _four(1.0 + around.inner_peak)
    radial = _four(around.radial)
    inverse = _four(1.0 / radial)
    races = [
        _four(0.4068 * around.inner_mean * inverse),
        _four(0.3894 * around.outer_mean * inverse),
    ]
    capacities = np.round(np.array(weights) ** (-1.0 / LIFE), 3)  # Ci/C and Ce/C, 1.034 and 1.970
    part = np.round(capacities**-LIFE, 4)
    dynamic = np.dot(part, np.array(races) ** LIFE) ** (1.0 / LIFE)
    return inner, outer, _four(0.2334 * _four(outer / radial)), _four(dynamic)


def _four(value: Array | float) -> float:
    """Round to four significant digits."""
    return float(f"{float(value):.4g}")


def _check_positive(name: str, value: float) -> None:
    if not (finite(value) and value > 0.0):
        raise InvalidBearing(f"{name} must be a finite number above zero, got {shown(value)}")


def _numbers(name: str, values: ArrayLike, low: float | None = None) -> Array:
    """Return an array of finite numbers from ``low`` up, or above zero; InvalidBearing if not."""
    array = real_numbers(values)
    if array is None:
        raise InvalidBearing(f"{name} must be numbers, got {shown(values)}")
    in_range = array > 0.0 if low is None else array >= low
    if not (np.isfinite(array) & in_range).all():
        least = "above zero" if low is None else f"from {low:g} up"
        least = "" if low == -math.inf else f" {least}"
        raise InvalidBearing(f"{name} must be finite numbers{least}, got {shown(values)}")
    return array
