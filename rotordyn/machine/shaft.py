"""The turning shaft as a row of cylindrical sections."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import accumulate
from typing import Annotated

from bearings.materials import Material
from rotordyn.description import Description, doubled
from rotordyn.quantity import (
    SHEAR_COEFFICIENT,
    Bore,
    Choice,
    Diameter,
    Length,
    OptionalName,
    Station,
    Taper,
)

WHOLE = 1.0 + 1e-9  # of a taper that begins at nothing, and may round
SHEAR_COEFFICIENTS = ("cowper", "hutchinson")


@dataclass(frozen=True, slots=True)
class Section(Description):
    """A hollow cylinder or frustum, homogeneous [m].

    Diameters are those of the cylinder of the same length and mass; ``outer_taper`` and
    ``inner_taper``: by how much they are larger at the rear end than at the front one.
    """

    length: Length
    outer_diameter: Diameter
    inner_diameter: Bore
    material: Material
    name: OptionalName = ""
    outer_taper: Taper = 0.0
    inner_taper: Taper = 0.0

    def _faults(self) -> Iterator[str]:
        yield from no_wall(self.inner_diameter, self.outer_diameter)
        for diameter, taper in self._walls:
            if taper**2 > 3.0 * WHOLE * diameter**2:
                yield f"a taper of {taper:.6g} m leaves no end of {diameter:.6g} m: allowed: less"
                return
        for outer, inner in zip(*(_ends(*wall) for wall in self._walls), strict=True):
            yield from no_wall(inner, outer)

    @property
    def _walls(self) -> tuple[tuple[float, float], tuple[float, float]]:
        return (self.outer_diameter, self.outer_taper), (self.inner_diameter, self.inner_taper)

    def between(self, begin: float, end: float) -> tuple[float, float, float, float]:
        """Diameters, outer and inner, and tapers of the part from ``begin`` to ``end``, shares of
        the length."""
        found = []
        for mean, taper in self._walls:
            if taper == 0.0:
                found.append((mean, 0.0))
                continue
            front, rear = _ends(mean, taper)
            own = taper * (end - begin)
            middle = front + (rear - front) * (begin + end) / 2.0
            found.append((math.sqrt(middle**2 + own**2 / 12.0), own))
        (outer, outer_taper), (inner, inner_taper) = found
        return outer, inner, outer_taper, inner_taper


@dataclass(frozen=True, slots=True)
class Shaft(Description):
    """Sections laid end to end from ``start`` towards +x.

    ``shear_coefficient`` is ``"cowper"``, ``"hutchinson"`` or a number.
    """

    start: Station
    sections: tuple[Section, ...]
    shear_coefficient: (
        Annotated[str, Choice(SHEAR_COEFFICIENTS)] | Annotated[float, SHEAR_COEFFICIENT]
    ) = "cowper"

    def _faults(self) -> Iterator[str]:
        if not self.sections:
            yield "a shaft needs at least one section"
        for name in doubled(section.name for section in self.sections):
            yield f"two sections are named '{name}'"

    @property
    def boundaries(self) -> tuple[float, ...]:
        """Section ends from ``start`` on, one more than there are sections [m]."""
        return tuple(accumulate((s.length for s in self.sections), initial=self.start))

    @property
    def end(self) -> float:
        """Last boundary [m]."""
        return self.boundaries[-1]

    def section_at(self, x: float) -> Section:
        """The section that covers ``x``; at a step, the one after it."""
        return self.sections_at((x,))[0]

    def sections_at(self, stations: Iterable[float]) -> list[Section]:
        """The same at each of ``stations``."""
        rights, last = self.boundaries[1:], len(self.sections) - 1
        return [self.sections[min(bisect_right(rights, x), last)] for x in stations]

    def preceded_by(self, sections: tuple[Section, ...]) -> Shaft:
        """This shaft with ``sections`` put in front of its start (a tool in the nose)."""
        start = self.start - sum(s.length for s in sections)
        return replace(self, start=start, sections=sections + self.sections)


def _ends(mean: float, taper: float) -> tuple[float, float]:
    """Diameters at both ends of a frustum as heavy as a cylinder of diameter ``mean``."""
    middle = math.sqrt(max(mean**2 - taper**2 / 12.0, 0.0))
    return middle - taper / 2.0, middle + taper / 2.0


def no_wall(inner_diameter: float, outer_diameter: float) -> Iterator[str]:
    """What is wrong with a hollow cylinder of these diameters [m]: nothing, or no wall left."""
    if inner_diameter >= outer_diameter:
        yield (
            f"no wall left: inner_diameter {inner_diameter:.6g} m; "
            f"allowed: below the outer_diameter, {outer_diameter:.6g} m"
        )
