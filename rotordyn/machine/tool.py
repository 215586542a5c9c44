"""What is clamped into the nose of a spindle."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Annotated

from rotordyn.description import Description, Faults, Path, named_twice
from rotordyn.machine.joint import Joint
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.reference import Reference
from rotordyn.machine.shaft import Section
from rotordyn.machine.station import SLACK
from rotordyn.quantity import HIDDEN, Items, Name, Station
from rotordyn.units import format_quantity


@dataclass(frozen=True, slots=True)
class Tool(Description):
    """What is clamped into the nose: sections from its tip to the nose face, turning with it.

    ``points`` and ``masses`` are in spindle coordinates: x = 0 at the nose face, the tip negative.
    """

    name: Annotated[str, HIDDEN]
    sections: Annotated[tuple[Section, ...], Items(), "from its tip to the nose face"]
    masses: Annotated[tuple[PointMass, ...], "rigid masses on the tool"] = ()
    points: Annotated[
        Mapping[Name, Station], "named stations, in coordinates of the spindle (negative)"
    ] = field(default_factory=dict)
    references: Annotated[tuple[Reference, ...], "known values shown beside the computed ones"] = ()
    joints: Annotated[
        tuple[Joint, ...], "of the tool, or between tool and spindle; x = 0 is the nose face"
    ] = ()

    def _faults(self) -> Faults:
        yield from named_twice("sections", self.sections)
        yield from named_twice("masses", self.masses)
        yield from named_twice("joints", self.joints)

    def faults_in(self, nose: float, points: Iterable[str]) -> Faults:
        """What does not lie on it in front of the ``nose`` [m], or is called as ``points`` are."""
        front = nose - sum(section.length for section in self.sections)
        ends = " to ".join(format_quantity(x, "mm") for x in (front, nose))
        placed: list[tuple[str, Path, float]]
        placed = [("point", ("points", name), x) for name, x in self.points.items()]
        placed += [("mass", ("masses", k, "x"), mass.x) for k, mass in enumerate(self.masses)]
        for what, path, x in placed:
            if x < front - SLACK or x > nose + SLACK:
                yield path, f"{what} off the tool: given {{given}}; allowed: {ends}"
        for name in self.points:
            if name in points:
                yield ("points", name), "name already taken by a point of the spindle"
