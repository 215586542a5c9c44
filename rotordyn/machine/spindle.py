"""The whole machine: a shaft, what turns with it, what holds it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from itertools import pairwise

from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.growth import ComputedShortening, PrescribedShortening
from rotordyn.machine.lumped import Disc, PointMass
from rotordyn.machine.reference import Reference
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.support import BearingSeat, LinearSupport, Sleeve


@dataclass(frozen=True, slots=True)
class Tool:
    """What is clamped into the nose: sections from its tip to the nose face, turning with it.

    ``points`` and ``masses`` are in spindle coordinates: x = 0 at the nose face, the tip negative.
    """

    name: str
    sections: tuple[Section, ...]
    masses: tuple[PointMass, ...] = ()
    points: Mapping[str, float] = field(default_factory=dict)
    references: tuple[Reference, ...] = ()


@dataclass(frozen=True, slots=True)
class Spindle:
    """A rotor on bearings, linear supports or both.

    ``rotor_damping`` [-]: modal damping ratios of the flexible free-free bending modes at rest, in
    order; the last one serves all that follow; empty = none. ``points``: named stations [m].
    """

    name: str
    shaft: Shaft
    masses: tuple[PointMass, ...] = ()
    discs: tuple[Disc, ...] = ()
    seats: tuple[BearingSeat, ...] = ()
    sleeves: tuple[Sleeve, ...] = ()
    supports: tuple[LinearSupport, ...] = ()
    drawbar: Drawbar | None = None
    points: Mapping[str, float] = field(default_factory=dict)
    shortening: PrescribedShortening | ComputedShortening | None = None
    rotor_damping: tuple[float, ...] = ()
    title: str = ""
    note: str = ""
    references: tuple[Reference, ...] = ()

    @property
    def lumped(self) -> tuple[PointMass, ...]:
        """Point masses and discs, all as point masses."""
        return self.masses + tuple(disc.as_point_mass() for disc in self.discs)

    @property
    def pairings(self) -> tuple[tuple[str, str, str], ...]:
        """Neighbours of opposite thrust from front to rear: (front, rear, "O" or "X").

        "O" (back to back): the contact lines meet the axis outside the pair, so that tilt is held
        with a long base; "X" (face to face): inside.
        """
        row = sorted(self.seats, key=lambda seat: seat.x)
        return tuple(
            (front.name, rear.name, "O" if front.thrust > 0 else "X")
            for front, rear in pairwise(row)
            if front.thrust != rear.thrust
        )

    def sleeve_of(self, seat_name: str) -> Sleeve | None:
        """The sleeve that carries a bearing's outer ring, or None where the housing does."""
        return next((s for s in self.sleeves if seat_name in s.bearings), None)

    def with_tool(self, tool: Tool) -> Spindle:
        """This spindle with ``tool`` put in front of its shaft."""
        return replace(
            self,
            shaft=self.shaft.preceded_by(tool.sections),
            masses=self.masses + tool.masses,
            points={**self.points, **tool.points},
            references=self.references + tool.references,
        )
