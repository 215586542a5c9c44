"""What a case asks of the stability of milling (SI)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Faults, ascending
from rotordyn.machine.assembly import misnamed, unknown
from rotordyn.quantity import (
    Angle,
    Choice,
    Diameter,
    Frequency,
    Length,
    PointName,
    Quantity,
    Sweep,
    TopSpeed,
    Whole,
)
from rotordyn.scene.formulation import ROTATING
from rotordyn.scene.spec import Setting, Spec

METHODS = ("multi-frequency", "zero-order")
MILLING = ("up", "down", "slot")
HOPF, FLIP, NONE = "hopf", "flip", ""
Immersion = Annotated[float, Quantity("ratio", above="0 %", at_most="100 %")]
Helix = Annotated[float, Quantity("angle", at_least="0 deg", below="90 deg")]
CuttingCoefficient = Annotated[float, Quantity("pressure", above="0 Pa", at_most="100 GPa")]
RadialCoefficient = Annotated[float, Quantity("pressure", at_least="0 Pa", at_most="100 GPa")]


@dataclass(frozen=True, slots=True)
class StabilityLobesSpec(Spec):
    """Depth of cut up to which milling is stable, over speed, at every speed's own receptance."""

    point: Annotated[PointName, "tip of the tool"]
    teeth: Annotated[int, Whole(1, 100), "teeth of the cutter, evenly spaced"]
    diameter: Annotated[Diameter, "of the cutter"]
    tangential: Annotated[CuttingCoefficient, "tangential cutting coefficient Ktc"]
    radial: Annotated[RadialCoefficient, "radial cutting coefficient Krc"]
    immersion: Annotated[Immersion, "radial depth over diameter"] = 1.0
    milling: Annotated[str, Choice(MILLING), "in a slot the immersion is 1"] = "slot"
    helix: Annotated[Helix, "angle of the edges; multi-frequency alone takes it"] = 0.0
    feed: Annotated[
        Angle, "direction of the feed, from z in the sense of rotation of the spindle"
    ] = 0.0
    feed_per_tooth: Annotated[Length, "for the removal rate; it does not change the limits"] = 1e-4
    method: Annotated[str, Choice(METHODS), "multi-frequency is complete, zero-order quick"] = (
        METHODS[0]
    )
    max_frequency: Annotated[Frequency, "up to which the machine is modelled"] = 4000.0
    speeds: Annotated[
        tuple[TopSpeed, ...],
        Sweep(),
        "of the limits; the machine is solved anew at each. By default those of the case above 0",
    ] = ()

    @property
    def ends(self) -> tuple[float, float]:
        """Entry and exit of a tooth [rad], from the normal towards the feed."""
        if self.milling == "up":
            return 0.0, math.acos(1.0 - 2.0 * self.immersion)
        if self.milling == "down":
            return math.acos(2.0 * self.immersion - 1.0), math.pi
        return 0.0, math.pi

    def _faults(self) -> Faults:
        yield from ascending("speeds", self.speeds)
        if self.milling == "slot" and self.immersion != 1.0:
            yield (
                ("immersion",),
                "a slot has the immersion 1: given {given}; allowed: 1, or milling: up or down",
            )
        if self.helix > 0.0 and self.method == METHODS[1]:
            yield (
                ("helix",),
                "zero-order limits do not depend on it: given {given}; leave it out, or take "
                "method: multi-frequency",
            )

    def faults_on(self, setting: Setting) -> Faults:
        if not misnamed(setting.spindle):
            for sentence in unknown("point", self.point, [*setting.spindle.places]):
                yield ("point",), sentence
        if setting.conditions.formulation == ROTATING:
            yield (), "the cut stands still: given beside rotating; allowed: formulation inertial"
        known = [speed for speed in setting.speeds if speed == speed]
        for index, speed in enumerate(self.speeds):
            if known and speed > max(known) * (1.0 + 1e-9):
                yield (
                    ("speeds", index),
                    "above the highest speed of the case, to which the machine is modelled",
                )
        if known and not self.speeds and not max(known) > 0.0:
            yield ("speeds",), "no speed above 0: give speeds of the limits here"
