"""The whole machine: a shaft, what turns with it, what holds it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields, replace
from itertools import pairwise
from typing import Annotated

from bearings.bearing import BallBearing
from bearings.flexible_rings.describe import FlexibleRings, Neighbour
from rotordyn.description import Description, Faults, require
from rotordyn.errors import InvalidInput
from rotordyn.machine.assembly import spindle_faults
from rotordyn.machine.bearing_set import BearingSet
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.flexible_rings import Beside, RingBodies, together
from rotordyn.machine.growth import ComputedShortening, PrescribedShortening
from rotordyn.machine.housing import Housing
from rotordyn.machine.joint import Joint
from rotordyn.machine.lumped import Disc, PointMass
from rotordyn.machine.motor import Motor
from rotordyn.machine.reference import Reference
from rotordyn.machine.rotor import (
    ModalDamping,
    Place,
    Rayleigh,
    RayleighDamping,
    Rotor,
    TurningShare,
)
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.sleeve import Sleeve
from rotordyn.machine.squeeze_film import SqueezeFilmDamper
from rotordyn.machine.support import GROUND, SPINDLE, LinearSupport
from rotordyn.machine.tool import Tool
from rotordyn.quantity import HIDDEN, Key, LossFactor, Name, Station

OF_TOOL = ("masses", "references", "joints")  # lists to whose end a tool adds its items


@dataclass(frozen=True, slots=True)
class Spindle(Description):
    """A rotor and what holds it: bearings, linear supports or both.

    Stations [m]. Bearings and supports that no housing carries stand on ground.
    """

    name: Annotated[str, HIDDEN]
    shaft: Annotated[Shaft, "the turning shaft"]
    masses: Annotated[tuple[PointMass, ...], "rigid masses on the shaft"] = ()
    discs: Annotated[tuple[Disc, ...], "rigid discs on the shaft"] = ()
    seats: Annotated[tuple[BearingSeat, ...], Key("bearings"), "its bearings, of any kind"] = ()
    sleeves: Annotated[tuple[Sleeve, ...], "sliding sleeves with their springs"] = ()
    arrangement: Annotated[
        BearingSet | None,
        "a set of bearings by its name, DB or TBT, instead of thrusts and a sleeve "
        "([how](howto/preload.md))",
    ] = None
    supports: Annotated[
        tuple[LinearSupport, ...],
        "linear supports to ground, to the housing that carries them, to another rotor",
    ] = ()
    drawbar: Annotated[Drawbar | None, "bar in the bore that pulls the tool into the nose"] = None
    points: Annotated[Mapping[Name, Station], "named stations"] = field(default_factory=dict)
    shortening: Annotated[
        PrescribedShortening | ComputedShortening | None, "axial shift of the seats with speed"
    ] = None
    rotor_damping: ModalDamping = ()
    internal_damping: TurningShare = 0.0
    rayleigh: Rayleigh = field(default_factory=RayleighDamping)
    title: Annotated[str, "one line"] = ""
    note: Annotated[str, "remark: what is known, assumed, estimated"] = ""
    references: Annotated[tuple[Reference, ...], "known values shown beside the computed ones"] = ()
    housings: Annotated[
        tuple[Housing, ...], "flexible bodies that carry supports and bearings"
    ] = ()
    joints: Annotated[tuple[Joint, ...], "between parts of the shaft, as of a tool holder"] = ()
    rotors: Annotated[
        tuple[Rotor, ...], "further rotors on the same axis, each with its speed"
    ] = ()
    loss_factor: Annotated[
        LossFactor,
        Key("damping.loss_factor"),
        "η of the stiffness of shaft and joints: hysteretic damping, which turns with the shaft, "
        "without further rotors ([how](theory/damping.md#hysteretic-damping))",
    ] = 0.0
    dampers: Annotated[
        tuple[SqueezeFilmDamper, ...], "squeeze films between the shaft and ground"
    ] = ()
    cutter_diameter: Annotated[float | None, HIDDEN] = None
    motor: Annotated[Motor | None, "motor that drives it; limits a cut in addition to chatter"] = (
        None
    )

    def __post_init__(self) -> None:
        bearing_set: object = self.arrangement
        if isinstance(bearing_set, BearingSet):
            sleeve = bearing_set.sleeve(self.seats)
            others = tuple(each for each in self.sleeves if each.name != bearing_set.name)
            sleeves = (*others, sleeve) if sleeve is not None else others
            object.__setattr__(self, "sleeves", sleeves)
        Description.__post_init__(self)

    def _faults(self) -> Faults:
        return spindle_faults(self)

    def mounted(self, seat: BearingSeat) -> BallBearing:
        """Return the bearing of a seat, its rings flexible on this shaft and in the housing.

        Raises
        ------
        InvalidBearing : rings that are impossible
        """
        bodies = seat.flexible_rings
        if bodies is None:
            return seat.bearing
        rings = self._rings(seat, bodies)
        if bodies.joins:
            rings = together(rings, self._beside(seat))
        return replace(seat.bearing, rings=rings)

    def joined(self, one: BearingSeat, other: BearingSeat, which: str) -> bool:
        """Return whether ``inner`` or ``outer`` rings of two bearings deform one wall together."""
        ring = getattr(self.mounted(one).rings, which, None)
        return ring is not None and _distance(one, other) in [
            each.distance for each in ring.neighbours
        ]

    def _rings(self, seat: BearingSeat, bodies: RingBodies) -> FlexibleRings:
        hole, material = self.shaft.diameters_at(seat.x)[1], self.shaft.section_at(seat.x).material
        return bodies.bodies(seat.bearing, hole, material, seat.fits)

    def _beside(self, seat: BearingSeat) -> Iterator[Beside]:
        """Yield the other bearings with flexible rings equal to that of a seat."""
        low, high = self.shaft.reach
        for other in self.seats:
            bodies = other.flexible_rings
            if other.name == seat.name or bodies is None or not bodies.joins:
                continue
            if other.known_bearing == seat.bearing and low <= other.x <= high:
                yield Beside(
                    self._rings(other, bodies),
                    Neighbour(_distance(seat, other), mirrored=other.thrust != seat.thrust),
                    self.sleeve_of(other.name) == self.sleeve_of(seat.name),
                )

    @property
    def damped(self) -> bool:
        """Whether the rotor itself is damped, apart from its bearings and supports."""
        return any(self.rotor_damping) or bool(self.rayleigh)

    @property
    def rubs(self) -> bool:
        """Whether dry friction holds a sleeve, so that its state depends on the load history."""
        return any(sleeve.friction > 0.0 for sleeve in self.sleeves)

    @property
    def ratios(self) -> dict[str, float]:
        """Speed of every rotor over that of the spindle's shaft, which comes first."""
        return {SPINDLE: 1.0} | {rotor.name: rotor.speed_ratio for rotor in self.rotors}

    @property
    def places(self) -> dict[str, Place]:
        """All named points; those of a further rotor as ``rotor.point``."""
        named = {name: Place(SPINDLE, x) for name, x in self.points.items()}
        for rotor in self.rotors:
            named |= {f"{rotor.name}.{n}": Place(rotor.name, x) for n, x in rotor.points.items()}
        return named

    def place(self, at: str | float | Place) -> Place:
        """Return the place of a point's name, a station [m] on the spindle's shaft or a place."""
        if isinstance(at, Place):
            return at
        return self.places[at] if isinstance(at, str) else Place(SPINDLE, at)

    @property
    def parts(self) -> dict[str, Spindle]:
        """Every rotor as a separate spindle, by its name."""
        return {name: self.part(name) for name in self.ratios}

    def part(self, name: str) -> Spindle:
        """Return a rotor alone, as a spindle; a machine of one rotor itself.

        One of several keeps the supports with an end on it, whose other end becomes ground;
        housings are omitted.
        """
        if not self.rotors:
            return self
        touching = tuple(
            replace(s, holds=SPINDLE, against=GROUND) for s in self.supports if name in s.ends
        )
        if name == SPINDLE:
            return replace(self, supports=touching, housings=(), rotors=())
        rotor = next(each for each in self.rotors if each.name == name)
        kept = {f.name: getattr(rotor, f.name) for f in fields(rotor) if f.name != "speed_ratio"}
        return Spindle(**kept, supports=touching)

    @property
    def grounded(self) -> Spindle:
        """The spindle's shaft alone, with the supports that join it to ground."""
        if not self.rotors:
            return self
        supports = tuple(s for s in self.supports if set(s.ends) == {SPINDLE, GROUND})
        return replace(self, supports=supports, housings=(), rotors=())

    @property
    def connections(self) -> tuple[BearingSeat | LinearSupport | SqueezeFilmDamper, ...]:
        """Bearings, then supports, then dampers."""
        return (*self.seats, *self.supports, *self.dampers)

    @property
    def hysteretic(self) -> bool:
        """Whether the rotor or a support has a loss factor."""
        return self.loss_factor > 0.0 or any(s.loss_factor for s in self.supports)

    def _repr_html_(self) -> str:
        """Return a table of the parts, which notebooks show."""
        from rotordyn.machine.parts import HEAD, part_rows
        from rotordyn.markup import table

        return table(self.title or self.name, part_rows(self), HEAD)

    @property
    def lumped(self) -> tuple[PointMass, ...]:
        """Point masses, with discs as point masses."""
        return self.masses + tuple(disc.as_point_mass() for disc in self.discs)

    @property
    def pairings(self) -> tuple[tuple[str, str, str], ...]:
        """Adjacent bearings of opposite thrust from front to rear: (front, rear, "O" or "X").

        Bearings that take thrust in both directions form no pair.

        "O" (back to back): the contact lines meet the axis outside the pair, so that tilt is held
        with a long base; "X" (face to face): inside.
        """
        row = sorted(self.seats, key=lambda seat: seat.x)
        return tuple(
            (front.name, rear.name, "O" if front.thrust > 0 else "X")
            for front, rear in pairwise(row)
            if front.thrust != rear.thrust
            and not (front.bearing.both_ways or rear.bearing.both_ways)
        )

    def sleeve_of(self, seat_name: str) -> Sleeve | None:
        """Return the sleeve that carries a bearing's outer ring, or None where the housing does."""
        return next((s for s in self.sleeves if seat_name in s.bearings), None)

    def with_tool(self, tool: Tool) -> Spindle:
        """Return this spindle with ``tool`` in front of its shaft.

        Raises
        ------
        InvalidInput : something of the tool is not on it, or its names are taken
        """
        require(tool, tool.faults_in(self.shaft.start, self.points))
        return replace(
            self,
            shaft=self.shaft.preceded_by(tool.sections),
            points={**self.points, **tool.placed(self.shaft.start)},
            cutter_diameter=tool.cutter_diameter,
            **{name: getattr(self, name) + getattr(tool, name) for name in OF_TOOL},
        )

    def without_tool(self, tool: Tool) -> Spindle:
        """Return this spindle without the ``tool`` in front of its shaft.

        Raises
        ------
        InvalidInput : another tool is in front of its shaft
        """
        first = len(tool.sections)
        last = {name: len(getattr(self, name)) - len(getattr(tool, name)) for name in OF_TOOL}
        same = self.shaft.sections[:first] == tool.sections
        shaft = self.shaft.without_first(first)
        same &= tool.placed(shaft.start).items() <= self.points.items()
        same &= all(getattr(self, name)[k:] == getattr(tool, name) for name, k in last.items())
        if not same:
            raise InvalidInput(
                "the tool in the nose was changed as part of the spindle: change the tool instead"
            )
        return replace(
            self,
            shaft=shaft,
            points={name: x for name, x in self.points.items() if name not in tool.points},
            cutter_diameter=None,
            **{name: getattr(self, name)[:k] for name, k in last.items()},
        )


def _distance(one: BearingSeat, other: BearingSeat) -> float:
    """Return the distance from one bearing to another, along the thrust of the first [m]."""
    return one.thrust * round(other.x - one.x, 9)  # stations add up from the tool tip with rounding
