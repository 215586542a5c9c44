"""Load ratings of a bearing from its grooves: dynamic (ISO 281), static (ISO 76).

The table of ISO 281 is Lundberg and Palmgren's formula with grooves of 0.52 (radial) or 0.535
(thrust); here it has the grooves of the bearing, so that open grooves lose load rating. The
formulas are those of the standards from memory [M]; ``docs/theory/life.md`` lists the checks of
them.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from bearings.arguments import checked
from bearings.errors import InvalidBearing, shown
from bearings.geometry import geometry
from bearings.grooves import Grooves

if TYPE_CHECKING:
    from bearings.bearing import BallBearing

STATIC_PRESSURE = 4.2e9  # [Pa], ISO 76: a dent of 1e-4 of the ball diameter
STEEPEST_RADIAL = math.radians(45.0)  # ISO 281: above it a bearing is a thrust bearing
LARGE_BALL = 25.4e-3  # [m], above which the exponent of size is smaller
_RADIAL, _THRUST, _MATERIAL = 0.95, 0.90, 1.3  # λ of both kinds, bm
_LUNDBERG = 98.0665  # 10 kgf in N, of lengths in mm
RADIAL_FACTOR, REFERENCE_FACTOR = 1.04, 1.044  # before ρ of ISO 281, before R of ISO/TS 16281
WEIBULL_SLOPE = 10.0 / 9.0  # of the lives of ball bearings
EXPONENT = 3.0 * WEIBULL_SLOPE  # of loads where probabilities of survival multiply, L ~ Q⁻³


def nominal_angle(grooves: Grooves) -> float:
    """Contact angle of ratings [rad]: the free one; 0 for a deep groove, where it is clearance."""
    return 0.0 if len(grooves.raceways) == 2 and grooves.both_ways else grooves.free_angle


def is_thrust(grooves: Grooves) -> bool:
    """Whether ISO 281 rates the bearing by axial load: contact angle above 45°."""
    return steep(nominal_angle(grooves))


def steep(contact_angle: float) -> bool:
    """Whether a contact angle [rad] is beyond 45°, with a tolerance for rounding."""
    return contact_angle > STEEPEST_RADIAL + 1e-9


class Insides(NamedTuple):
    """Internal geometries of a bearing: balls, pitch circle and conformities; numbers, or arrays
    that broadcast, lengths in m, ``contact_angle`` in rad."""

    ball_diameter: Any
    balls: Any
    pitch_diameter: Any
    inner_conformity: Any
    outer_conformity: Any
    contact_angle: float

    @classmethod
    def of(cls, grooves: Grooves) -> Insides:
        """Internal geometry of one bearing, at its nominal angle."""
        return cls(
            grooves.ball_diameter,
            grooves.balls,
            grooves.pitch_diameter,
            grooves.inner_conformity,
            grooves.outer_conformity,
            nominal_angle(grooves),
        )

    def at(self, place: int) -> Insides:
        """Select one geometry by index."""
        return Insides._make([*(values[place] for values in self[:-1]), self.contact_angle])

    def spread_over(self, shape: tuple[int, ...]) -> Insides:
        """All geometries of a grid of this shape, as flat arrays of equal length."""
        flat = (np.broadcast_to(values, shape).ravel() for values in self[:-1])
        return Insides._make([*flat, self.contact_angle])

    @property
    def gamma(self) -> Any:
        """γ = D cos α/dm."""
        return self.ball_diameter * math.cos(self.contact_angle) / self.pitch_diameter

    @property
    def free_distance(self) -> Any:
        """BD, between the groove centres of a ball that just touches both [m]."""
        return (self.inner_conformity + self.outer_conformity - 1.0) * self.ball_diameter

    @property
    def strength_ratio(self) -> Any:
        """ρ: strength of the inner race over that of the outer one under equal ball loads, of
        radial bearings without its leading factor."""
        inner, outer = self.inner_conformity, self.outer_conformity
        osculation = (inner / outer * (2.0 * outer - 1.0) / (2.0 * inner - 1.0)) ** 0.41
        return ((1.0 - self.gamma) / (1.0 + self.gamma)) ** 1.72 * osculation


@checked
def geometry_factor(bearing: BallBearing | Grooves) -> float:
    """fc of ISO 281 [N, mm] from the bearing's grooves, without bm = 1.3 of modern steel."""
    grooves = bearing if isinstance(bearing, Grooves) else bearing.grooves
    return float(_factor(Insides.of(grooves)))


@checked
def dynamic_rating(bearing: BallBearing | Grooves) -> float:
    """Basic dynamic load rating C of ISO 281 from the grooves [N].

    Radial load of bearings up to a contact angle of 45°, axial load above. It does not depend on
    materials: hybrid bearings keep it (ISO 20056-1).
    """
    grooves = bearing if isinstance(bearing, Grooves) else bearing.grooves
    return float(rating(Insides.of(grooves)))


def rating(x: Insides) -> Any:
    """C [N] of internal geometries, of radial or, above 45°, of thrust bearings."""
    # fc of thrust bearings has (D/dm)^0.3 instead of γ^0.3, so cos α^0.7 tan α becomes sin α
    alpha, size = x.contact_angle, x.ball_diameter * 1e3
    angle = math.sin(alpha) if steep(alpha) else math.cos(alpha) ** 0.7
    by_size = np.where(x.ball_diameter > LARGE_BALL, 3.647 * size**1.4, size**1.8)
    return _MATERIAL * _factor(x) * angle * x.balls ** (2.0 / 3.0) * by_size


def _factor(x: Insides) -> Any:
    """fc [N, mm]."""
    f = x.inner_conformity
    groove = _LUNDBERG * (2.0 * f / (2.0 * f - 1.0)) ** 0.41
    race = groove * (1.0 - x.gamma) ** 1.39 / (1.0 + x.gamma) ** (1.0 / 3.0)
    if steep(x.contact_angle):
        both = (1.0 + x.strength_ratio**EXPONENT) ** -0.3
        sine = 1.0 - math.sin(x.contact_angle) / 3.0
        return _THRUST * sine * (x.ball_diameter / x.pitch_diameter) ** 0.3 * race * both
    both = (1.0 + (RADIAL_FACTOR * x.strength_ratio) ** EXPONENT) ** -0.3
    return 0.41 * _RADIAL * race * x.gamma**0.3 * both


@checked
def static_rating(bearing: BallBearing | Grooves, pressure: float = STATIC_PRESSURE) -> float:
    """Basic static load rating C0 of ISO 76 from the grooves [N].

    The radial load, above 45° the axial load, that presses the most loaded ball with ``pressure``
    [Pa] against the worse race; of a radial load that ball carries 5/(z cos α). Balls of silicon
    nitride have higher pressures than steel ones under equal load and lose about 30 %.

    Raises
    ------
    InvalidBearing : a pressure that is not positive
    """
    if not pressure > 0.0:
        raise InvalidBearing(f"pressure of a static rating must be positive, got {shown(pressure)}")
    grooves = bearing if isinstance(bearing, Grooves) else bearing.grooves
    alpha, g = nominal_angle(grooves), geometry(grooves)
    ball = min(
        (pressure * race.semi_axis_major * race.semi_axis_minor * math.pi / 1.5) ** 3
        for race in (g.inner, g.outer)
    )
    if is_thrust(grooves):
        return grooves.balls * ball * math.sin(alpha)
    return grooves.balls * ball * math.cos(alpha) / 5.0
