"""Values of a ball with derivatives by angle and approach of the resultants of both races.

Plain expressions of floats or arrays, which compile as they stand.
"""

from __future__ import annotations

from typing import Any, NamedTuple


class Polar(NamedTuple):
    """A value with its derivatives by αi, δi, αo and δo, of the races' resultants."""

    value: Any
    by_inner_angle: Any
    by_inner_approach: Any
    by_outer_angle: Any
    by_outer_approach: Any


def exchanged(p: Polar) -> Polar:
    """Seen with the races exchanged."""
    return Polar(
        p.value, p.by_outer_angle, p.by_outer_approach, p.by_inner_angle, p.by_inner_approach
    )


def times(p: Polar, q: Polar) -> Polar:
    """Product of two values."""
    return Polar(
        p.value * q.value,
        p.value * q.by_inner_angle + q.value * p.by_inner_angle,
        p.value * q.by_inner_approach + q.value * p.by_inner_approach,
        p.value * q.by_outer_angle + q.value * p.by_outer_angle,
        p.value * q.by_outer_approach + q.value * p.by_outer_approach,
    )


def scaled(vary: float, factor: float, p: Polar) -> Polar:
    """A value times ``factor``, its derivatives times ``vary`` as well."""
    slope = vary * factor
    return Polar(
        factor * p.value,
        slope * p.by_inner_angle,
        slope * p.by_inner_approach,
        slope * p.by_outer_angle,
        slope * p.by_outer_approach,
    )


def more_by(p: Polar, q: Polar) -> Polar:
    """Sum of two values."""
    return Polar(
        p.value + q.value,
        p.by_inner_angle + q.by_inner_angle,
        p.by_inner_approach + q.by_inner_approach,
        p.by_outer_angle + q.by_outer_angle,
        p.by_outer_approach + q.by_outer_approach,
    )


def less_by(p: Polar, q: Polar) -> Polar:
    """Difference of two values."""
    return Polar(
        p.value - q.value,
        p.by_inner_angle - q.by_inner_angle,
        p.by_inner_approach - q.by_inner_approach,
        p.by_outer_angle - q.by_outer_angle,
        p.by_outer_approach - q.by_outer_approach,
    )
