"""The hollow circle that every section of a shaft has; floats or arrays alike."""

from __future__ import annotations

import math
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Number = TypeVar("Number", float, NDArray[np.float64])


def area(outer_diameter: Number, inner_diameter: Number) -> Number:
    """A = π (do² − di²) / 4 [m²]."""
    return math.pi / 4.0 * (outer_diameter - inner_diameter) * (outer_diameter + inner_diameter)


def second_moment(outer_diameter: Number, inner_diameter: Number) -> Number:
    """I = π (do⁴ − di⁴) / 64 about a diameter [m⁴]; about the axis it is twice that."""
    squares = outer_diameter**2 + inner_diameter**2
    return area(outer_diameter, inner_diameter) * squares / 16.0
