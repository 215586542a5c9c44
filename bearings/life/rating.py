"""Load ratings of a bearing from its grooves: dynamic (ISO 281), static (ISO 76).

The table of ISO 281 is Lundberg and Palmgren's formula with grooves of 0.52 (radial) or 0.535
(thrust); here it has the grooves of the bearing, so that open grooves lose load rating. The
formulas are those of the standards from memory [M]; ``docs/theory/life.md`` lists the checks of
them.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

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
    one_arc = len(grooves.inner_offsets) == len(grooves.outer_offsets) == 1
    return 0.0 if one_arc and grooves.both_ways else grooves.free_angle


def is_thrust(grooves: Grooves) -> bool:
    """Whether ISO 281 rates the bearing by axial load: contact angle above 45°."""
    return steep(nominal_angle(grooves))


def steep(contact_angle: float) -> bool:
    """Whether a contact angle [rad] is beyond 45°, with a tolerance for rounding."""
    return contact_angle > STEEPEST_RADIAL + 1e-9


def race_ratio(grooves: Grooves, front: float = RADIAL_FACTOR) -> float:
    """ρ: strength of the inner race over that of the outer one under equal ball loads, with the
    leading factor ``front`` for radial bearings and 1 for thrust bearings."""
    factor = 1.0 if is_thrust(grooves) else front
    return factor * _strength_ratio(
        _gamma(grooves), grooves.inner_conformity, grooves.outer_conformity
    )


@checked
def geometry_factor(bearing: BallBearing | Grooves) -> float:
    """fc of ISO 281 [N, mm] from the bearing's grooves, without bm = 1.3 of modern steel."""
    grooves = bearing if isinstance(bearing, Grooves) else bearing.grooves
    gamma, alpha = _gamma(grooves), nominal_angle(grooves)
    conformities = grooves.inner_conformity, grooves.outer_conformity
    if not is_thrust(grooves):
        factor: float = _radial_factor(gamma, *conformities)
        return factor
    size = grooves.ball_diameter / grooves.pitch_diameter
    return float(_thrust_factor(gamma, *conformities, size, alpha))


def rating(x: Any) -> Any:
    """C [N] of many internal geometries, of radial or, above 45°, of thrust bearings.

    ``x`` has what ``radial_rating`` takes and ``pitch_diameter`` [m]; one contact angle.
    """
    if not steep(x.contact_angle):
        return radial_rating(x)
    size = x.ball_diameter / x.pitch_diameter
    factor = _thrust_factor(x.gamma, x.inner_conformity, x.outer_conformity, size, x.contact_angle)
    balls = x.balls ** (2.0 / 3.0)
    return _MATERIAL * factor * math.sin(x.contact_angle) * balls * _size_factor(x.ball_diameter)


def radial_rating(x: Any) -> Any:
    """C of radial bearings [N], numbers or arrays that broadcast; up to 45°.

    ``x`` has ``gamma`` = D cos α/dm, ``inner_conformity``, ``outer_conformity``, ``balls``,
    ``ball_diameter`` [m] and ``contact_angle`` α [rad].
    """
    factor = _radial_factor(x.gamma, x.inner_conformity, x.outer_conformity)
    angle = math.cos(x.contact_angle) ** 0.7
    return _MATERIAL * factor * angle * x.balls ** (2.0 / 3.0) * _size_factor(x.ball_diameter)


def _radial_factor(gamma: Any, inner: Any, outer: Any) -> Any:
    """fc up to 45°."""
    both = (1.0 + (RADIAL_FACTOR * _strength_ratio(gamma, inner, outer)) ** EXPONENT) ** -0.3
    return 0.41 * _RADIAL * _race_factor(gamma, inner) * gamma**0.3 * both


def _thrust_factor(gamma: Any, inner: Any, outer: Any, size: Any, angle: float) -> Any:
    """fc above 45°; ``size``: D/dm."""
    both = (1.0 + _strength_ratio(gamma, inner, outer) ** EXPONENT) ** -0.3
    sine = 1.0 - math.sin(angle) / 3.0
    return _THRUST * sine * size**0.3 * _race_factor(gamma, inner) * both


def _strength_ratio(gamma: Any, inner: Any, outer: Any) -> Any:
    """ρ without its leading factor."""
    osculation = (inner / outer * (2.0 * outer - 1.0) / (2.0 * inner - 1.0)) ** 0.41
    return ((1.0 - gamma) / (1.0 + gamma)) ** 1.72 * osculation


def _race_factor(gamma: Any, f: Any) -> Any:
    """Factor of the inner race in fc: its osculation f and curvature along rolling [N, mm]."""
    groove = _LUNDBERG * (2.0 * f / (2.0 * f - 1.0)) ** 0.41
    return groove * (1.0 - gamma) ** 1.39 / (1.0 + gamma) ** (1.0 / 3.0)


def _size_factor(ball_diameter: Any) -> Any:
    """D^1.8 of small balls, 3.647 D^1.4 of large ones, D in mm."""
    import numpy as np

    size = ball_diameter * 1e3
    return np.where(ball_diameter > LARGE_BALL, 3.647 * size**1.4, size**1.8)


@checked
def dynamic_rating(bearing: BallBearing | Grooves) -> float:
    """Basic dynamic load rating C of ISO 281 from the grooves [N].

    Radial load of bearings up to a contact angle of 45°, axial load above. It does not depend on
    materials: hybrid bearings keep it (ISO 20056-1).
    """
    grooves = bearing if isinstance(bearing, Grooves) else bearing.grooves
    alpha, size = nominal_angle(grooves), float(_size_factor(grooves.ball_diameter))
    # fc of thrust bearings has (D/dm)^0.3 instead of γ^0.3, so cos α^0.7 tan α becomes sin α
    angle = math.sin(alpha) if is_thrust(grooves) else math.cos(alpha) ** 0.7
    return _MATERIAL * geometry_factor(grooves) * angle * grooves.balls ** (2.0 / 3.0) * size


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


def _gamma(grooves: Grooves) -> float:
    """γ = D cos α/dm at the nominal angle."""
    return grooves.ball_diameter * math.cos(nominal_angle(grooves)) / grooves.pitch_diameter
