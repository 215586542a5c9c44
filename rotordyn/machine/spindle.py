"""The whole machine: a shaft, what turns with it, what holds it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

from rotordyn.description import Description
from rotordyn.errors import InvalidInput
from rotordyn.machine.damping import RayleighDamping
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.growth import ComputedShortening, PrescribedShortening
from rotordyn.machine.held import held_twice, housing_faults
from rotordyn.machine.housing import Housing
from rotordyn.machine.joint import Joint
from rotordyn.machine.lumped import Disc, PointMass
from rotordyn.machine.naming import name_faults, named_twice
from rotordyn.machine.reference import Reference
from rotordyn.machine.rotor import (
    Place,
    Rotor,
    ends_faults,
    freedoms_held,
    of_one_rotor,
    rotor_faults,
)
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.sleeved import shift_faults, sleeve_faults
from rotordyn.machine.squeeze_film import SqueezeFilmDamper
from rotordyn.machine.station import fit_faults, joint_faults, off_the_shaft
from rotordyn.machine.support import GROUND, SPINDLE, BearingSeat, LinearSupport, Sleeve, acts
from rotordyn.machine.tool import Tool
from rotordyn.quantity import DampingRatio, LossFactor, Name, Share, Station


@dataclass(frozen=True, slots=True)
class Spindle(Description):
    """A rotor on bearings, linear supports or both.

    ``rotor_damping`` [-]: modal damping ratios of the flexible free-free bending modes at rest, in
    order; the last one serves all that follow; empty = none. ``rayleigh`` is added to it.
    ``internal_damping`` [-]: share of both, in bending, which turns with the shaft. ``points``:
    named stations [m]. ``housings``: what bearings and supports stand on; those that none carries
    stand on ground. ``joints``: between parts of the shaft. ``rotors``: further ones on the same
    axis, joined to the shaft, to ground and to one another by supports. ``loss_factor`` [-]:
    hysteretic damping, of the stiffness of shaft and joints; it turns with the shaft. ``dampers``:
    squeeze films between the shaft and ground.
    """

    name: str
    shaft: Shaft
    masses: tuple[PointMass, ...] = ()
    discs: tuple[Disc, ...] = ()
    seats: tuple[BearingSeat, ...] = ()
    sleeves: tuple[Sleeve, ...] = ()
    supports: tuple[LinearSupport, ...] = ()
    drawbar: Drawbar | None = None
    points: Mapping[Name, Station] = field(default_factory=dict)
    shortening: PrescribedShortening | ComputedShortening | None = None
    rotor_damping: tuple[DampingRatio, ...] = ()
    internal_damping: Share = 0.0
    rayleigh: RayleighDamping = field(default_factory=RayleighDamping)
    title: str = ""
    note: str = ""
    references: tuple[Reference, ...] = ()
    housings: tuple[Housing, ...] = ()
    joints: tuple[Joint, ...] = ()
    rotors: tuple[Rotor, ...] = ()
    loss_factor: LossFactor = 0.0
    dampers: tuple[SqueezeFilmDamper, ...] = ()

    @property
    def damped(self) -> bool:
        """The rotor itself is damped, besides its bearings and supports."""
        return any(self.rotor_damping) or bool(self.rayleigh)

    @property
    def ratios(self) -> dict[str, float]:
        """Speed of every rotor over that of the spindle's shaft, which comes first."""
        return {SPINDLE: 1.0} | {rotor.name: rotor.speed_ratio for rotor in self.rotors}

    @property
    def places(self) -> dict[str, Place]:
        """All named points; those of a further rotor as ``rotor.point``."""
        found = {name: Place(SPINDLE, x) for name, x in self.points.items()}
        for rotor in self.rotors:
            found |= {f"{rotor.name}.{n}": Place(rotor.name, x) for n, x in rotor.points.items()}
        return found

    def place(self, at: str | float | Place) -> Place:
        """Where a point's name, a station [m] on the spindle's shaft or a place is."""
        if isinstance(at, Place):
            return at
        if not isinstance(at, str):
            return Place(SPINDLE, at)
        return Place(SPINDLE, self.points[at]) if at in self.points else self.places[at]

    def part(self, name: str) -> Spindle:
        """A rotor by itself, as a spindle; the only one of a machine is that machine.

        Of several it has the supports with an end on it, which join it to ground, whatever their
        other end; housings are left out.
        """
        if not self.rotors:
            return self
        touching = tuple(
            replace(s, holds=SPINDLE, against=GROUND) for s in self.supports if name in s.ends
        )
        if name == SPINDLE:
            return replace(self, supports=touching, housings=(), rotors=())
        rotor = next(each for each in self.rotors if each.name == name)
        return Spindle(
            name=name,
            shaft=rotor.shaft,
            masses=rotor.masses,
            discs=rotor.discs,
            supports=touching,
            points=rotor.points,
            rotor_damping=rotor.rotor_damping,
            internal_damping=rotor.internal_damping,
            rayleigh=rotor.rayleigh,
            joints=rotor.joints,
        )

    @property
    def grounded(self) -> Spindle:
        """The spindle's shaft by itself, with the supports that join it to ground."""
        if not self.rotors:
            return self
        own = tuple(s for s in self.supports if set(s.ends) == {SPINDLE, GROUND})
        return replace(self, supports=own, housings=(), rotors=())

    @property
    def connections(self) -> tuple[BearingSeat | LinearSupport | SqueezeFilmDamper, ...]:
        """Bearings, then supports, then dampers."""
        return (*self.seats, *self.supports, *self.dampers)

    @property
    def connection_losses(self) -> tuple[float, ...]:
        """Loss factors of bearings, which have none, then of supports."""
        return (*(0.0 for _ in self.seats), *(support.loss_factor for support in self.supports))

    @property
    def hysteretic(self) -> bool:
        """Something has a loss factor."""
        return self.loss_factor > 0.0 or any(self.connection_losses)

    def _repr_html_(self) -> str:
        """Its parts in a table, which notebooks show."""
        from rotordyn.machine.parts import HEAD, part_rows
        from rotordyn.markup import table

        return table(self.title or self.name, part_rows(self), HEAD)

    def _faults(self) -> Iterator[str]:
        yield from named_twice("seats", self.seats)
        yield from named_twice("sleeves", self.sleeves)
        yield from named_twice("supports", self.supports)
        yield from named_twice("supports and dampers", self.supports + self.dampers)
        yield from named_twice("masses and discs", self.masses + self.discs)
        yield from self._ends_faults()
        yield from self._station_faults()
        yield from sleeve_faults(self.seats, self.sleeves)
        yield from self._shift_faults()
        yield from fit_faults(self.shaft, self.seats)
        yield from held_twice(self.seats, self.supports)
        yield from joint_faults(self.shaft, self.joints)
        for kind, place, sentence in name_faults(
            self.housings, self.rotors, self.seats, self.supports
        ):
            yield f"{kind} {getattr(self, kind)[place].name}: {sentence}"
        if self.rotors:
            yield from self._loss_faults()
        yield from (
            sentence
            for _, sentence in housing_faults(
                self.housings, self.seats, self.sleeves, self.supports, self.rotors
            )
        )

    def _loss_faults(self) -> Iterator[str]:
        own = [("loss_factor", self.loss_factor)]
        own += [(f"support {s.name}: loss_factor", s.loss_factor) for s in self.supports]
        yield from (f"{key}: {of_one_rotor(f'{eta:g}')}" for key, eta in own if eta)

    def _ends_faults(self) -> Iterator[str]:
        names = [rotor.name for rotor in self.rotors]
        faults = [
            f"support {self.supports[place].name}: {key}: {sentence}"
            for place, key, sentence in ends_faults(self.supports, names)
        ]
        yield from faults
        if faults or not self.rotors:
            return
        held = {n: self._held([s for s in self.supports if n in s.ends]) for n in names}
        yield from (sentence for _, sentence in rotor_faults(self.rotors, held))
        for name in names:
            try:
                self.part(name)
            except InvalidInput as refusal:
                yield f"rotors: {refusal}"

    @staticmethod
    def _held(supports: Sequence[LinearSupport]) -> frozenset[str]:
        stiff = (pair for s in supports for pair, value in s.stiffness.items() if acts(value))
        return freedoms_held(stiff, (freedom for s in supports for freedom in s.rigid))

    def _station_faults(self) -> Iterator[str]:
        placed: tuple[PointMass | Disc | BearingSeat | LinearSupport | SqueezeFilmDamper, ...]
        own = tuple(support for support in self.supports if SPINDLE in support.ends)
        placed = (*self.masses, *self.discs, *self.seats, *own, *self.dampers)
        yield from self.off_the_shaft(
            *((f"{type(item).__name__} {item.name}", item.x) for item in placed),
            *(("drawbar", x) for x in (self.drawbar.stations if self.drawbar else ())),
        )

    def _shift_faults(self) -> Iterator[str]:
        if isinstance(self.shortening, ComputedShortening):
            yield from self.off_the_shaft(("reference of shortening", self.shortening.reference))
        elif self.shortening is not None:
            yield from shift_faults(self.seats, self.shortening.shift)

    def off_the_shaft(self, *placed: tuple[str, float]) -> Iterator[str]:
        """A sentence for each of ``placed``, a name and its station [m], that does not lie on the
        shaft."""
        yield from off_the_shaft(self.shaft, placed)

    @property
    def lumped(self) -> tuple[PointMass, ...]:
        """Point masses and discs, all as point masses."""
        return self.masses + tuple(disc.as_point_mass() for disc in self.discs)

    @property
    def pairings(self) -> tuple[tuple[str, str, str], ...]:
        """Neighbours of opposite thrust from front to rear: (front, rear, "O" or "X").

        Only between bearings that take thrust one way.

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
            joints=self.joints + tool.joints,
        )
