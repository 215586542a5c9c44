"""A conical length of shaft as frusta so short that in figures and weight they pass for cylinders.

Between two of them outer diameter and wall change by ``STEP`` at most. Elements integrate the taper
of each exactly.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

from bearings.materials import Material
from rotordyn.errors import InvalidInput
from rotordyn.machine.shaft import Section

STEP = 0.01  # relative change of outer diameter or wall from one cylinder to the next
MOST = 400  # cylinders of one cone


def cone(
    length: float,
    outer: tuple[float, float],
    inner: tuple[float, float],
    material: Material,
    name: str = "",
    step: float = STEP,
) -> tuple[Section, ...]:
    """Frusta from front to rear; ``outer`` and ``inner`` diameters [m] at front and rear end.

    A single one bears ``name``, of several the first.

    Raises
    ------
    InvalidInput : an end has no wall, or more than ``MOST`` cylinders are needed
    """
    wall = (outer[0] - inner[0], outer[1] - inner[1])
    for sentence in cone_faults(outer, inner, step):
        raise InvalidInput(sentence)
    leading, count = _steps(outer, wall, step)
    if count == 0:
        return (Section(length, outer[0], inner[0], material, name),)
    return tuple(
        Section(
            (b - a) * length,
            _mean(_at(outer, a), _at(outer, b)),
            _mean(_at(inner, a), _at(inner, b)),
            material,
            name if a == 0.0 else "",
            _at(outer, b) - _at(outer, a),
            _at(inner, b) - _at(inner, a),
        )
        for a, b in pairwise(_cuts(leading, count))
    )


def cone_faults(
    outer: tuple[float, float], inner: tuple[float, float], step: float = STEP
) -> Iterator[str]:
    """What is wrong with the ends of a cone."""
    for place, do, di in zip(("front", "rear"), outer, inner, strict=True):
        if not 0.0 <= di < do:
            yield (
                f"no wall left at the {place} end: inner_diameter {di:.6g} m; allowed: below the "
                f"outer_diameter, {do:.6g} m"
            )
            return
    wall = (outer[0] - inner[0], outer[1] - inner[1])
    if _steps(outer, wall, step)[1] > MOST:
        yield (
            f"a cone too steep for {MOST} cylinders: outer diameter {outer[0]:.6g} m to "
            f"{outer[1]:.6g} m, wall {wall[0] / 2.0:.6g} m to {wall[1] / 2.0:.6g} m; divide it"
        )


def _steps(
    outer: tuple[float, float], wall: tuple[float, float], step: float
) -> tuple[tuple[float, float], int]:
    """Which of both changes more from end to end, and in how many steps; none for a cylinder."""
    leading = max((outer, wall), key=lambda ends: abs(math.log(ends[1] / ends[0])))
    return leading, math.ceil(abs(math.log(leading[1] / leading[0])) / step)


def _cuts(ends: tuple[float, float], count: int) -> list[float]:
    """Shares of the length between which a diameter or wall changes by one and the same ratio."""
    ratio = ends[1] / ends[0]
    inside = [(ratio ** (k / count) - 1.0) / (ratio - 1.0) for k in range(1, count)]
    return [0.0, *inside, 1.0]


def _at(ends: tuple[float, float], share: float) -> float:
    return ends[0] + share * (ends[1] - ends[0])


def _mean(a: float, b: float) -> float:
    """Diameter of the cylinder as heavy as a frustum of end diameters a and b."""
    return math.sqrt((a * a + a * b + b * b) / 3.0)
