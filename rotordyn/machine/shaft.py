"""The rotating shaft as a row of cylindrical and conical sections."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import accumulate
from typing import Annotated

from bearings.materials import Material
from rotordyn.description import Description, Faults, named_twice
from rotordyn.quantity import (
    HIDDEN,
    SHEAR_COEFFICIENT,
    Bore,
    Choice,
    Diameter,
    Items,
    Key,
    Length,
    OptionalName,
    Quantity,
    Station,
)

SHEAR_COEFFICIENTS = ("cowper", "hutchinson", "none")
MeanDensity = Annotated[float, Quantity("density", at_least="1 kg/m^3", at_most="50000 kg/m^3")]
STEEPEST = 50.0  # ratio of outer diameters, or of walls, at the ends of one section


@dataclass(frozen=True, slots=True)
class Section(Description):
    """A hollow cylinder, or a cone where diameters at its rear end are given [m].

    Diameters are those of the front end, and of the rear end where none are given for it; they
    change linearly along the axis. ``own``: keys given here, not
    for all sections.
    """

    length: Annotated[Length, "along the axis"]
    outer_diameter: Annotated[Diameter, "above the inner one"]
    inner_diameter: Annotated[Bore, Key(default=0.0), "bore"]
    material: Annotated[
        Material,
        Key(missing="this section has no material, and none is given for all of them"),
        "instead of that of all sections",
    ]
    name: Annotated[OptionalName, "name in messages, overrides and the figure"] = ""
    rear_outer_diameter: Annotated[
        Diameter | None, "outer diameter at the rear end, where it differs: a cone"
    ] = None
    rear_inner_diameter: Annotated[
        Bore | None, "inner diameter at the rear end, where it differs"
    ] = None
    mean_density: Annotated[
        MeanDensity | None,
        "mass over volume, for inertia and weight, where slots, windings or a filled bore make it "
        "differ from the density of the material; centrifugal growth and shortening use that of "
        "the material",
    ] = None
    own: Annotated[tuple[str, ...], HIDDEN] = field(default=(), repr=False, compare=False)

    def _faults(self) -> Faults:
        faults = [*no_wall(self.inner_diameter, self.outer_diameter)]
        yield from faults or _taper_faults(self.outer, self.inner)

    @property
    def density(self) -> float:
        """Mass over volume [kg/m³]: ``mean_density``, or that of the material."""
        return self.material.density if self.mean_density is None else self.mean_density

    @property
    def outer(self) -> tuple[float, float]:
        """Outer diameters at both ends [m]."""
        rear = self.rear_outer_diameter
        return self.outer_diameter, self.outer_diameter if rear is None else rear

    @property
    def inner(self) -> tuple[float, float]:
        """Inner diameters at both ends [m]."""
        rear = self.rear_inner_diameter
        return self.inner_diameter, self.inner_diameter if rear is None else rear


@dataclass(frozen=True)
class Shaft(Description):
    """Sections laid end to end from ``start`` towards +x."""

    start: Annotated[Station, "station of its front end"]
    sections: Annotated[tuple[Section, ...], Items(), "sections from front to rear"]
    shear_coefficient: Annotated[
        Annotated[str, Choice(SHEAR_COEFFICIENTS)] | Annotated[float, SHEAR_COEFFICIENT],
        "formula by Poisson's ratio and diameters, or the coefficient; `none`: no shear "
        "deformation (Euler and Bernoulli's beam)",
    ] = "cowper"

    def _faults(self) -> Faults:
        yield from named_twice("sections", self.sections)

    @cached_property
    def boundaries(self) -> tuple[float, ...]:
        """Stations of the section ends from ``start`` on, one more than sections [m]."""
        return tuple(accumulate((s.length for s in self.sections), initial=self.start))

    @property
    def end(self) -> float:
        """Station of the rear end [m]."""
        return self.boundaries[-1]

    @property
    def largest_diameter(self) -> float:
        """Largest outer diameter of any section [m]."""
        return max(max(section.outer) for section in self.sections)

    @property
    def reach(self) -> tuple[float, float]:
        """First and last station [m]."""
        return self.start, self.end

    def section_at(self, x: float) -> Section:
        """Return the section that covers ``x``; at a step, the one behind it."""
        return self.sections_at((x,))[0]

    def sections_at(self, stations: Iterable[float]) -> list[Section]:
        """Return the section that covers each of ``stations``."""
        ends, last = self.boundaries[1:], len(self.sections) - 1
        return [self.sections[min(bisect_right(ends, x), last)] for x in stations]

    def diameters_at(self, x: float) -> tuple[float, float]:
        """Return outer and inner diameter at ``x`` [m]; at a step, those behind it."""
        index = min(bisect_right(self.boundaries[1:], x), len(self.sections) - 1)
        section, left = self.sections[index], self.boundaries[index]
        share = min(max((x - left) / section.length, 0.0), 1.0)
        outer, inner = (a + share * (b - a) for a, b in (section.outer, section.inner))
        return outer, inner

    def preceded_by(self, sections: tuple[Section, ...]) -> Shaft:
        """Return this shaft with ``sections`` in front of its start (a tool in the nose)."""
        start = self.start - sum(s.length for s in sections)
        front = tuple(replace(s, own=("material",)) for s in sections)
        return replace(self, start=start, sections=front + self.sections)

    def without_first(self, count: int) -> Shaft:
        """Return this shaft without its first ``count`` sections."""
        start = self.start + sum(s.length for s in self.sections[:count])
        return replace(self, start=start, sections=self.sections[count:])


def no_wall(inner_diameter: float, outer_diameter: float) -> Faults:
    """Yield a fault where a hollow cylinder of these diameters [m] has no wall."""
    if inner_diameter >= outer_diameter:
        yield (
            ("inner_diameter",),
            "no wall left: given inner diameter {given}; allowed: below the outer, "
            "{given:outer_diameter}",
        )


def _taper_faults(outer: tuple[float, float], inner: tuple[float, float]) -> Faults:
    """Yield a fault where rear diameters [m] of a section leave no wall or a too steep cone."""
    if any(math.isnan(diameter) for diameter in (*outer, *inner)):
        return
    wall = (outer[0] - inner[0], outer[1] - inner[1])
    if wall[1] <= 0.0:
        yield (
            (),
            f"no wall left at the rear end: inner_diameter {inner[1]:.6g} m; allowed: below the "
            f"outer_diameter, {outer[1]:.6g} m",
        )
    elif max(abs(math.log(b / a)) for a, b in (outer, wall)) > math.log(STEEPEST):
        yield (
            (),
            f"the cone is too steep: outer diameter {outer[0]:.6g} m to {outer[1]:.6g} m, wall "
            f"{wall[0] / 2.0:.6g} m to {wall[1] / 2.0:.6g} m; allowed: a ratio up to "
            f"{STEEPEST:g} of either; divide it",
        )
