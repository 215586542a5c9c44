"""A radially loaded ring in numbers: from a bearing, its load and its speed."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

import numpy as np

from bearings.debongnie.ball import HIGHEST, LOWEST, power_law
from bearings.debongnie.equivalent import LIFE, equivalent_factors, race_weights
from bearings.debongnie.zone import distribution, peak
from bearings.errors import InvalidBearing
from bearings.geometry import geometry

if TYPE_CHECKING:
    from bearings.bearing import BallBearing

VARIANTS = ("corrected", "original")


@dataclass(frozen=True, slots=True)
class RadialRing:
    """What the approximation takes of a bearing.

    ``inner_compliance``, ``outer_compliance``: ki, ke of δ = k Q^(2/3) [m/N^(2/3)]; ``ball_mass``
    [kg]; diameters [m]; conformities: groove radii over ball diameter; ``clearance``: diametral,
    negative for interference [m]. Raises InvalidBearing for impossible numbers.
    """

    inner_compliance: float
    outer_compliance: float
    balls: int
    ball_mass: float
    ball_diameter: float
    pitch_diameter: float
    inner_conformity: float = 0.52
    outer_conformity: float = 0.52
    clearance: float = 0.0

    def __post_init__(self) -> None:
        for name in (f.name for f in fields(self) if f.name != "clearance"):
            _check_positive(name, getattr(self, name))
        if not math.isfinite(self.clearance):
            raise InvalidBearing(f"clearance must be a finite length in m, got {self.clearance!r}")
        if min(self.inner_conformity, self.outer_conformity) <= 0.5:
            raise InvalidBearing("conformities must be above 0.5: grooves are wider than the ball")
        if self.ball_diameter >= self.pitch_diameter:
            raise InvalidBearing("ball_diameter must be below pitch_diameter: is the unit right?")

    @classmethod
    def of(cls, bearing: BallBearing) -> RadialRing:
        """The ring of a bearing of any kind; InvalidBearing where balls do not run mid-groove."""
        grooves = bearing.grooves
        if len(grooves.contacts) != 2 or (grooves.touching and grooves.free_angle > 0.0):
            raise InvalidBearing(
                "the approximation takes balls that run in the middle of one groove a ring: "
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
    """A loaded ring: ``displacement`` δr [m], ``zone`` θ0 [rad], forces [N].

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
    """The ring under a radial ``load`` [N] while its inner ring turns at ``speed`` [rad/s].

    ``variant`` "original" keeps what is wrong in the report: Fc = m ω² D/2, ω half the speed,
    δc = (Fc/ke)^(2/3) and P0 = 0.2334 z Q; it has no clearance.

    Raises
    ------
    InvalidBearing : unknown variant, numbers not above zero, a clearance that the variant cannot
        take, or a load at which x of the most loaded ball leaves 0.01 to 100
    """
    ring = ring if isinstance(ring, RadialRing) else RadialRing.of(ring)
    _check_positive("load", load)
    _check_positive("speed", speed)
    force, seated, factors = _constants(ring, speed, variant)
    gap = 1.0 + ring.clearance / (2.0 * seated)
    if gap <= 0.0:
        raise InvalidBearing(
            f"interference of {-ring.clearance:g} m presses every ball (2 δc = {2 * seated:g} m): "
            "solve the full ring instead"
        )
    law = power_law(ring.inner_compliance / ring.outer_compliance)
    x = float(peak(load / (ring.balls * force), law, gap))
    if math.isnan(x):
        ends = (distribution(end, law, gap).radial for end in (LOWEST, HIGHEST))
        low, high = (float(end) * ring.balls * force for end in ends)
        raise InvalidBearing(
            f"a load of {load:g} N lies outside {low:g} to {high:g} N, for which the approximation "
            "is meant at this speed: solve the full ring instead"
        )
    around = distribution(x, law, gap)
    means = np.array([around.inner_mean, around.outer_mean])
    races = np.array(factors[1:]) * ring.balls * force * means
    weights = race_weights(ring.size_ratio, ring.inner_conformity, ring.outer_conformity)
    inner_peak = force * float(around.inner_peak)
    return Approximation(
        displacement=seated * (gap + x),
        zone=float(around.zone),
        peak=x,
        centrifugal_force=force,
        inner_peak=inner_peak,
        outer_peak=inner_peak + force,
        static_equivalent=factors[0] * ring.balls * (inner_peak + force),
        dynamic_equivalent=float(np.dot(weights, races**LIFE) ** (1.0 / LIFE)),
    )


def _constants(
    ring: RadialRing, speed: float, variant: str
) -> tuple[float, float, tuple[float, float, float]]:
    """Fc [N], δc [m] and the factors of the equivalent loads in a variant."""
    if variant == "corrected":
        force = ring.centrifugal_force(speed)
        return force, ring.outer_compliance * force ** (2.0 / 3.0), equivalent_factors()
    if variant != "original":
        raise InvalidBearing(f"variant must be one of {', '.join(VARIANTS)}, got {variant!r}")
    if ring.clearance:
        raise InvalidBearing("the original variant has no clearance: take the corrected one")
    force = ring.ball_mass * (0.5 * speed) ** 2 * ring.ball_diameter / 2.0
    return force, (force / ring.outer_compliance) ** (2.0 / 3.0), (0.2334, 0.4068, 0.3894)


def _check_positive(name: str, value: float) -> None:
    if not (math.isfinite(value) and value > 0.0):
        raise InvalidBearing(f"{name} must be a finite number above zero, got {value!r}")
