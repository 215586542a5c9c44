"""Rings that deform under their balls, with the shaft and the housing they sit on."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Annotated, NamedTuple

from bearings.bearing import BallBearing
from bearings.flexible_rings.describe import (
    ENDS,
    TOUCHING,
    ElasticRing,
    FlexibleRings,
    Neighbour,
)
from bearings.materials import STEEL, Material
from rotordyn.description import Description, Faults
from rotordyn.machine.fits import AROUND, Fits, InnerSize, OuterSize, RingWidth, no_housing
from rotordyn.quantity import Bore, Choice, Diameter
from rotordyn.units import format_quantity

WHICH = ("both", "inner", "outer")
SIZES = ("bore_diameter", "outside_diameter", "width")
NEIGHBOURS = ("alike", "apart")


class Beside(NamedTuple):
    """An adjacent bearing of the same kind and size: its ``rings``, its ``place`` relative to the
    first, and whether one sleeve or housing carries both."""

    rings: FlexibleRings
    place: Neighbour
    carried_alike: bool


@dataclass(frozen=True, slots=True)
class RingBodies(Description):
    """Rings of a bearing as elastic bodies, one with the shaft and the housing they sit on.

    Against rigid rings they make the bearing softer; the radial growth of fits and speed is not
    theirs.
    """

    which: Annotated[str, Choice(WHICH), "flexible rings: `both`, `inner` or `outer`"] = "both"
    bore_diameter: InnerSize = None
    outside_diameter: OuterSize = None
    width: RingWidth = None
    shaft_bore: Annotated[
        Bore | None,
        "hole in the shaft under the inner ring, 0 for a solid one; in a spindle by default that "
        "of the shaft there",
    ] = None
    housing_diameter: Annotated[
        Diameter | None,
        "outside of the housing or sleeve around the outer ring, by default 1.5 times that of the "
        "ring; with fits, give it there",
    ] = None
    housing_material: Annotated[
        Material | None, "name, path or mapping; steel by default; with fits, give it there"
    ] = None
    shaft_material: Annotated[
        Material | None, "name, path or mapping; by default that of the shaft there, or steel"
    ] = None
    length: Annotated[
        Diameter | None,
        "length of the piece of shaft and housing that deforms, the ring at its middle; "
        "by default its diameter beyond the ring on either side",
    ] = None
    ends: Annotated[
        str,
        Choice(ENDS),
        "`free`: grooves move against the mean motion of the shaft or housing at the ring; "
        "`clamped`: against the clamped ends of that piece, as in a test rig",
    ] = ENDS[0]
    neighbours: Annotated[
        str,
        Choice(NEIGHBOURS),
        "rings of equal bearings on the same wall within `length`: `alike`: they deform it "
        "together, under equal ball loads; `apart`: each has a separate wall",
    ] = NEIGHBOURS[0]

    @property
    def inner(self) -> bool:
        """Whether the inner ring deforms."""
        return self.which != "outer"

    @property
    def outer(self) -> bool:
        """Whether the outer ring deforms."""
        return self.which != "inner"

    @property
    def sound(self) -> bool:
        """Whether every value is valid; faults of the others are reported by their keys."""
        named = (*SIZES, "shaft_bore", "housing_diameter", "length")
        sizes = [getattr(self, name) for name in named]
        choices = self.which in WHICH and self.ends in ENDS and self.neighbours in NEIGHBOURS
        return choices and all(size == size for size in sizes)

    @property
    def joins(self) -> bool:
        """Whether its rings deform their wall together with their neighbours."""
        return self.neighbours == NEIGHBOURS[0] and self.sound and not any(self._faults())

    def _faults(self) -> Faults:
        for key, needs in zip(SIZES, (self.inner, self.outer, True), strict=True):
            if needs and getattr(self, key) is None:
                yield (
                    (key,),
                    "missing key: a flexible ring needs it; the model of this bearing gives none",
                )
        for key, deforms, other in (
            ("shaft_bore", self.inner, "an inner"),
            ("housing_diameter", self.outer, "an outer"),
        ):
            if getattr(self, key) is not None and not deforms:
                yield (
                    (key,),
                    f"needs {other} ring that is flexible: given {{given}} beside which: "
                    f"{self.which}; leave one of the two out",
                )
        hole, bore = self.shaft_bore, self.bore_diameter
        if self.inner and hole is not None and bore is not None and hole >= bore:
            yield (
                ("shaft_bore",),
                "leaves no shaft under the ring: given {given}; allowed: below "
                f"{format_quantity(bore, 'mm')}",
            )
        if self.length is not None and self.width is not None and self.length < self.width:
            yield (
                ("length",),
                "shorter than the ring: given {given}; allowed: from "
                f"{format_quantity(self.width, 'mm')}",
            )
        if self.outer:
            yield from no_housing(self.housing_diameter, self.outside_diameter)

    def bodies(
        self,
        bearing: BallBearing,
        hole: float = 0.0,
        shaft: Material = STEEL,
        fits: Fits | None = None,
    ) -> FlexibleRings:
        """Return rings of a ``bearing`` on a ``shaft`` with a ``hole`` of that diameter [m].

        ``fits`` of the seat give the housing, where there are any.

        Raises
        ------
        InvalidBearing : rings that are impossible
        """
        inner = outer = None
        assert self.width is not None
        if self.inner:
            assert self.bore_diameter is not None
            inner = ElasticRing(
                self.width,
                self.bore_diameter,
                hole if self.shaft_bore is None else self.shaft_bore,
                self.length,
                self.ends,
                backing_material=self.shaft_material or shaft,
            )
        if self.outer:
            assert self.outside_diameter is not None
            around, material = self.housing_diameter, self.housing_material or STEEL
            if fits is not None:
                around, material = fits.housing_diameter, fits.housing_material
            outer = ElasticRing(
                self.width,
                self.outside_diameter,
                around or AROUND * self.outside_diameter,
                self.length,
                self.ends,
                backing_material=material,
            )
        return FlexibleRings(inner, outer)


def together(rings: FlexibleRings, others: Iterable[Beside]) -> FlexibleRings:
    """Return the rings of a bearing with the adjacent ones that deform the same wall."""
    others = [*others]
    inner, outer = rings.inner, rings.outer
    if inner is not None:
        places = [each.place for each in others if each.rings.inner == inner]
        inner = _with_neighbours(inner, places)
    if outer is not None:
        places = [each.place for each in others if each.rings.outer == outer and each.carried_alike]
        outer = _with_neighbours(outer, places)
    return FlexibleRings(inner, outer)


def _with_neighbours(ring: ElasticRing, places: Iterable[Neighbour]) -> ElasticRing:
    """Return a ring with its neighbours at ``places``, those within its length of wall."""
    nearest, furthest = (1.0 - TOUCHING) * ring.width, 0.5 * (ring.length + ring.width)
    neighbours = [place for place in places if nearest <= abs(place.distance) <= furthest]
    return replace(ring, neighbours=tuple(sorted(neighbours)))
