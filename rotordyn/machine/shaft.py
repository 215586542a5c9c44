"""The turning shaft as a row of cylindrical sections."""

from __future__ import annotations

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
)

SHEAR_COEFFICIENTS = ("cowper", "hutchinson")


@dataclass(frozen=True, slots=True)
class Section(Description):
    """A hollow cylinder, homogeneous [m]."""

    length: Length
    outer_diameter: Diameter
    inner_diameter: Bore
    material: Material
    name: OptionalName = ""

    def _faults(self) -> Iterator[str]:
        yield from no_wall(self.inner_diameter, self.outer_diameter)


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


def no_wall(inner_diameter: float, outer_diameter: float) -> Iterator[str]:
    """What is wrong with a hollow cylinder of these diameters [m]: nothing, or no wall left."""
    if inner_diameter >= outer_diameter:
        yield (
            f"no wall left: inner_diameter {inner_diameter:.6g} m; "
            f"allowed: below the outer_diameter, {outer_diameter:.6g} m"
        )
