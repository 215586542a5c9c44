"""Values of a ball with derivatives by angle and approach of the resultants of both races.

Plain expressions of floats or arrays, which compile as they stand.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from bearings.ball.plane import combined, minus, plus

Four = tuple[Any, Any, Any, Any]


class Polar(NamedTuple):
    """A value, and ``by``: its derivatives by αi, δi, αo and δo, of the races' resultants."""

    value: Any
    by: Four


def exchanged(p: Polar) -> Polar:
    """Seen with the races exchanged."""
    return Polar(p.value, (p.by[2], p.by[3], p.by[0], p.by[1]))


def times(p: Polar, q: Polar) -> Polar:
    """Product of two values."""
    return Polar(p.value * q.value, combined(p.value, q.by, q.value, p.by))


def scaled(vary: float, factor: float, p: Polar) -> Polar:
    """A value times ``factor``, its derivatives times ``vary`` as well."""
    f = vary * factor
    return Polar(factor * p.value, (f * p.by[0], f * p.by[1], f * p.by[2], f * p.by[3]))


def more_by(p: Polar, q: Polar) -> Polar:
    """Sum of two values."""
    return Polar(p.value + q.value, plus(p.by, q.by))


def less_by(p: Polar, q: Polar) -> Polar:
    """Difference of two values."""
    return Polar(p.value - q.value, minus(p.by, q.by))
