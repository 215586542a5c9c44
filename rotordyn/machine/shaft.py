"""The turning shaft as a row of cylindrical sections."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import accumulate

from bearings.materials import Material


@dataclass(frozen=True, slots=True)
class Section:
    """A hollow cylinder, homogeneous [m]."""

    length: float
    outer_diameter: float
    inner_diameter: float
    material: Material
    name: str = ""


@dataclass(frozen=True, slots=True)
class Shaft:
    """Sections laid end to end from ``start`` towards +x.

    ``shear_coefficient`` is ``"cowper"``, ``"hutchinson"`` or a number.
    """

    start: float
    sections: tuple[Section, ...]
    shear_coefficient: str | float = "cowper"

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
        edges = self.boundaries
        for section, right in zip(self.sections, edges[1:], strict=True):
            if x < right:
                return section
        return self.sections[-1]

    def preceded_by(self, sections: tuple[Section, ...]) -> Shaft:
        """This shaft with ``sections`` put in front of its start (a tool in the nose)."""
        start = self.start - sum(s.length for s in sections)
        return replace(self, start=start, sections=sections + self.sections)
