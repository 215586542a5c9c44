"""The hollow circular section of a shaft, and its means over a cone; for floats and arrays."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TypeVar

from rotordyn.arrays import Array

Number = TypeVar("Number", float, Array)


def area(outer_diameter: Number, inner_diameter: Number) -> Number:
    """Return A = π (do² − di²) / 4 [m²]."""
    return math.pi / 4.0 * (outer_diameter - inner_diameter) * (outer_diameter + inner_diameter)


def second_moment(outer_diameter: Number, inner_diameter: Number) -> Number:
    """Return I = π (do⁴ − di⁴) / 64 about a diameter [m⁴]; about the axis it is twice that."""
    squares = outer_diameter**2 + inner_diameter**2
    return area(outer_diameter, inner_diameter) * squares / 16.0


def mean_area(outer: Iterable[Number], inner: Iterable[Number]) -> Number:
    """Return the mean of A over a cone of diameters ``outer`` and ``inner`` at its ends [m²]."""
    (do, ro), (di, ri) = _middle(*outer), _middle(*inner)
    return area(do, di) + math.pi / 48.0 * (ro**2 - ri**2)


def mean_second_moment(outer: Iterable[Number], inner: Iterable[Number]) -> Number:
    """Return the mean of I over a cone of diameters ``outer`` and ``inner`` at the ends [m⁴]."""
    more, less = (d**2 * r**2 / 2.0 + r**4 / 80.0 for d, r in (_middle(*outer), _middle(*inner)))
    (do, _), (di, _) = _middle(*outer), _middle(*inner)
    return second_moment(do, di) + math.pi / 64.0 * (more - less)


def area_moments(outer: Iterable[Number], inner: Iterable[Number]) -> tuple[Number, Number]:
    """Return ∫ A t dt and ∫ A t² dt [m²] over a cone, t from −½ at its front to ½ at its rear."""
    (do, ro), (di, ri) = _middle(*outer), _middle(*inner)
    first = math.pi / 24.0 * (do * ro - di * ri)
    return first, area(do, di) / 12.0 + math.pi / 320.0 * (ro**2 - ri**2)


def _middle(front: Number, rear: Number) -> tuple[Number, Number]:
    """Return the diameter in the middle, and its increase from end to end."""
    return (front + rear) / 2.0, rear - front
