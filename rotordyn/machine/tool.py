"""The tool in the nose of a spindle."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Annotated

from rotordyn.description import Description, Faults, named_twice
from rotordyn.machine.joint import Joint
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.reference import Reference
from rotordyn.machine.shaft import Section
from rotordyn.machine.station import all_on_the_shaft, on_the_shaft
from rotordyn.quantity import HIDDEN, Diameter, Items, Name, ToolStation


@dataclass(frozen=True, slots=True)
class Tool(Description):
    """A tool clamped into the nose: sections from its tip to the nose face, turning with it.

    ``points`` and ``masses`` are in spindle coordinates: x = 0 at the nose face, the tip negative;
    a point at infinity is its front end, however long the sections are.
    """

    name: Annotated[str, HIDDEN]
    sections: Annotated[tuple[Section, ...], Items(), "sections from its tip to the nose face"]
    masses: Annotated[tuple[PointMass, ...], "rigid masses on the tool"] = ()
    points: Annotated[
        Mapping[Name, ToolStation],
        "named stations, in coordinates of the spindle (negative); `front` is its front end, which "
        "moves with the lengths of the sections",
    ] = field(default_factory=dict)
    references: Annotated[tuple[Reference, ...], "known values shown beside the computed ones"] = ()
    joints: Annotated[
        tuple[Joint, ...], "joints of the tool, or between tool and spindle; x = 0 is the nose face"
    ] = ()
    cutter_diameter: Annotated[
        Diameter | None,
        "diameter over the teeth of a milling cutter, where the sections describe the flutes as a "
        "thinner cylinder",
    ] = None

    def _faults(self) -> Faults:
        yield from named_twice("sections", self.sections)
        yield from named_twice("masses", self.masses)
        yield from named_twice("joints", self.joints)

    def faults_in(self, nose: float, points: Iterable[str]) -> Faults:
        """Yield faults of what is off the tool in front of the ``nose`` [m], or named as in
        ``points``."""
        reach = self.front(nose), nose
        for name, x in self.placed(nose).items():
            yield from on_the_shaft("point", x, reach, ("points", name), "tool")
        yield from all_on_the_shaft("mass", "masses", self.masses, reach, "tool")
        for name in self.points:
            if name in points:
                yield ("points", name), "name already taken by a point of the spindle"

    def placed(self, nose: float) -> dict[str, float]:
        """Return the stations of its points in front of the ``nose`` [m]."""
        front = self.front(nose)
        return {name: front if math.isinf(x) else x for name, x in self.points.items()}

    def front(self, nose: float) -> float:
        """Return the station of its front end [m]."""
        return nose - sum(section.length for section in self.sections)
