"""Fits of a bearing's rings on the shaft and in the housing, as drawings name them (ISO 286)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from bearings.errors import InvalidBearing
from bearings.fits import Interference, bearing_bore, bearing_outside, interference, limits
from bearings.materials import STEEL, Material
from rotordyn.description import Description, Faults
from rotordyn.quantity import Choice, Diameter, Key
from rotordyn.quantity import Interference as Depth
from rotordyn.units import format_quantity

TAKEN = ("mean", "least", "most", "probable_least", "probable_most")
RINGS = ("P4", "normal")
InnerSize = Annotated[
    Diameter | None, "of the inner ring; in files by default that of the bearing model"
]
OuterSize = Annotated[
    Diameter | None, "of the outer ring; in files by default that of the bearing model"
]
RingWidth = Annotated[
    Diameter | None, "of the rings; in files by default that of the bearing model"
]
AROUND = 1.5  # outer diameter of a housing over that of the ring in it, by default


@dataclass(frozen=True, slots=True)
class Fits(Description):
    """Fits from which the growth of both grooves follows, at rest, at speed and at temperature.

    Interferences on the diameter at the reference temperature; without a class a ring is free.
    """

    shaft: Annotated[str, "tolerance class of the seat on the shaft, such as k5"] = ""
    housing: Annotated[str, "tolerance class of the bore of the housing, such as JS5"] = ""
    rings: Annotated[str, Choice(RINGS), "tolerance class of the rings (ISO 492)"] = "P4"
    taken: Annotated[
        str,
        Choice(TAKEN),
        "interference taken from the tolerances: their `mean`, the `least` or `most` of "
        "parts at their limits, or those within which nearly all pairs of parts lie, "
        "`probable_least` and `probable_most`",
    ] = "mean"
    smoothing: Annotated[
        Depth, "interference lost to the roughness of both surfaces, on the diameter"
    ] = 0.0
    bore_diameter: InnerSize = None
    outside_diameter: OuterSize = None
    width: RingWidth = None
    under_balls: Annotated[
        bool,
        "the centrifugal force of the balls expands the outer ring "
        "([how](theory/rings.md#outer-rings-under-their-balls))",
    ] = False
    housing_diameter: Annotated[
        Diameter | None, "outside of the housing; by default 1.5 times that of the outer ring"
    ] = None
    housing_material: Annotated[Material, Key(default=STEEL), "name, path or mapping"] = STEEL

    def _faults(self) -> Faults:
        yield from self._ring_faults("shaft", "bore_diameter", "a shaft, such as k5")
        yield from self._ring_faults("housing", "outside_diameter", "a bore, such as JS5")
        for key in ("outside_diameter", "width"):
            if self.under_balls and getattr(self, key) is None:
                yield (
                    (key,),
                    "missing key: the expansion of the outer ring by the balls needs it; the model "
                    "of this bearing gives none",
                )
        if self.under_balls and self.shaft and not self.housing:
            yield (
                ("housing",),
                "missing key: the expansion of the outer ring by the balls depends on its fit in "
                "the housing: give a class, such as JS5, or leave under_balls out",
            )
        if not (self.shaft or self.housing):
            yield (), "no class is given: give shaft (such as k5), housing (such as JS5) or both"
            return
        yield from no_housing(self.housing_diameter, self.outside_diameter)

    def _ring_faults(self, key: str, needs: str, kind: str) -> Faults:
        """Check the class at ``key``: of this ``kind``, and tabled for the diameter it needs."""
        word, size, inner = getattr(self, key), getattr(self, needs), key == "shaft"
        if not word or size != size:
            return
        if size is None:
            yield (
                (needs,),
                f"missing key: the fit {word} needs it; the model of this bearing gives none",
            )
        elif word.rstrip("0123456789").islower() != inner:
            yield (key,), f"not a class of {kind}: given {{given}}"
        else:
            try:
                _ = self.inner if inner else self.outer
            except InvalidBearing as refusal:
                yield (key,), f"{refusal}"

    @property
    def inner(self) -> Interference:
        """Interference of the inner ring on the shaft, on the diameter [m]."""
        assert self.bore_diameter is not None
        shaft = limits(self.shaft, self.bore_diameter)
        return interference(shaft, bearing_bore(self.bore_diameter, self.rings))

    @property
    def outer(self) -> Interference:
        """Interference of the outer ring in the housing, on the diameter [m], < 0: clearance."""
        assert self.outside_diameter is not None
        ring = bearing_outside(self.outside_diameter, self.rings)
        return interference(ring, limits(self.housing, self.outside_diameter))

    def depth(self, which: str) -> float:
        """Return the interference used, on the radius, of ``"inner"`` or ``"outer"`` [m]."""
        interference: Interference = getattr(self, which)
        reduced = interference.reduced(self.smoothing)
        depths = reduced._asdict()
        depths["probable_least"], depths["probable_most"] = reduced.probable
        return float(depths[self.taken]) / 2.0

    @property
    def housing_radius(self) -> float:
        """Outer radius of the housing [m]."""
        assert self.outside_diameter is not None
        return (self.housing_diameter or AROUND * self.outside_diameter) / 2.0


def no_housing(around: float | None, ring: float | None) -> Faults:
    """Yield a fault where an outside diameter of the housing leaves no wall around a ring [m]."""
    if around is not None and ring is not None and around <= ring:
        yield (
            ("housing_diameter",),
            "leaves no housing around the ring: given {given}; allowed: above "
            f"{format_quantity(ring, 'mm')}",
        )
