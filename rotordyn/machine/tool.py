"""What is clamped into the nose of a spindle."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from rotordyn.description import Description
from rotordyn.machine.joint import Joint
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.naming import named_twice
from rotordyn.machine.reference import Reference
from rotordyn.machine.shaft import Section
from rotordyn.quantity import Name, Station


@dataclass(frozen=True, slots=True)
class Tool(Description):
    """What is clamped into the nose: sections from its tip to the nose face, turning with it.

    ``points`` and ``masses`` are in spindle coordinates: x = 0 at the nose face, the tip negative.
    """

    name: str
    sections: tuple[Section, ...]
    masses: tuple[PointMass, ...] = ()
    points: Mapping[Name, Station] = field(default_factory=dict)
    references: tuple[Reference, ...] = ()
    joints: tuple[Joint, ...] = ()

    def _faults(self) -> Iterator[str]:
        if not self.sections:
            yield "a tool needs at least one section"
        yield from named_twice("sections", self.sections)
        yield from named_twice("masses", self.masses)
