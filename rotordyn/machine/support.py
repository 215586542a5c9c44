"""What holds the shaft: bearing seats, sliding sleeves, linear supports."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Annotated

from bearings.angular_contact import AngularContactBallBearing
from rotordyn.description import Description, doubled
from rotordyn.machine.growth import InterferenceFit, RingGrowth
from rotordyn.quantity import (
    Choice,
    Damping,
    Mass,
    Name,
    Preload,
    Rigidity,
    Station,
    StopTravel,
)

FREEDOMS = ("x", "y", "z", "thx", "thy", "thz")
Freedom = Annotated[str, Choice(FREEDOMS)]

# The motions that a straight rotor keeps apart, by the freedoms of its nodes.
MOTIONS = {
    "x": "axial",
    "y": "bending",
    "z": "bending",
    "thx": "torsion",
    "thy": "bending",
    "thz": "bending",
}
Entries = Mapping[tuple[Freedom, Freedom], float]


def entry_name(row: str, column: str) -> str:
    """An entry of a 6×6 matrix as files write it: ``yy``, ``y_thz``."""
    return row + column if len(row) == len(column) == 1 else f"{row}_{column}"


@dataclass(frozen=True, slots=True)
class BearingSeat(Description):
    """An angular-contact bearing at station ``x`` [m].

    ``thrust`` is +1 where pushing the shaft towards +x loads the balls, −1 where −x does.
    ``radial_damping`` and ``axial_damping`` [N·s/m] act between its rings; tilt is not damped.
    """

    name: Name
    bearing: AngularContactBallBearing
    x: Station
    thrust: Annotated[int, Choice((1, -1))]
    growth: RingGrowth = field(default_factory=RingGrowth)
    radial_damping: Damping = 0.0
    axial_damping: Damping = 0.0
    model: str = ""

    def _faults(self) -> Iterator[str]:
        bearing, fit = self.bearing, self.growth.centrifugal
        chord = bearing.ball_diameter * math.cos(bearing.contact_angle)
        centres = bearing.inner_conformity + bearing.outer_conformity - 1.0
        room = centres * (bearing.ball_diameter - chord)
        if self.growth.static > room:
            yield (
                f"growth.static takes the whole contact angle: given {self.growth.static:.6g} m; "
                f"allowed: up to {room:.6g} m"
            )
        race = bearing.pitch_diameter - chord
        if isinstance(fit, InterferenceFit) and fit.bore_diameter >= race:
            yield (
                f"no ring left beside the balls: bore_diameter {fit.bore_diameter:.6g} m; "
                f"allowed: below {race:.6g} m"
            )


@dataclass(frozen=True, slots=True)
class Spring(Description):
    """Preload spring: ``preload`` [N] at rest, ``stiffness`` [N/m]; infinite = rigid preload."""

    preload: Preload
    stiffness: Rigidity = math.inf


@dataclass(frozen=True, slots=True)
class Sleeve(Description):
    """A sliding sleeve that carries the outer rings of ``bearings`` and is pushed by ``spring``.

    The spring pushes the way that loads the bearings. ``stop_travel`` [m]: how far the sleeve can
    move against its spring from its place at rest before it meets the end stop; infinite = no stop.
    ``mass`` [kg] and ``radial_stiffness`` [N/m] (infinite = held rigidly by the housing bore).
    """

    name: Name
    bearings: tuple[Name, ...]
    spring: Spring
    stop_travel: StopTravel = math.inf
    mass: Mass = 0.0
    radial_stiffness: Rigidity = math.inf

    def _faults(self) -> Iterator[str]:
        if not self.bearings:
            yield "a sleeve carries at least one bearing"
        for name in doubled(self.bearings):
            yield f"bearing '{name}' is named twice"


@dataclass(frozen=True, slots=True)
class LinearSupport(Description):
    """Constant stiffness and damping to ground at station ``x``, or freedoms held ``rigid``.

    ``stiffness`` [N/m, N/rad …] and ``damping`` map a pair of node freedoms (load, displacement),
    such as ``("y", "y")`` or ``("y", "thz")``, to the entry of the 6×6 matrix; freedoms are
    x, y, z, thx, thy, thz. Entries not named are zero; nothing is symmetrised. Freedoms in
    ``rigid`` do not move at all and have no stiffness; only section forces take them.
    """

    name: Name
    x: Station
    stiffness: Entries = field(default_factory=dict)
    damping: Entries = field(default_factory=dict)
    rigid: tuple[Freedom, ...] = ()

    def _faults(self) -> Iterator[str]:
        for freedom in doubled(self.rigid):
            yield f"rigid: repeated: given '{freedom}'"
        yield from rigid_and_elastic(self.rigid, (*self.stiffness, *self.damping))

    @property
    def sideways(self) -> tuple[tuple[str, str], ...]:
        """Entries of ``stiffness`` that turn a displacement along x into other loads."""
        return tuple(pair for pair in self._stiff if pair[1] == "x" and pair[0] != "x")

    @property
    def out_of_plane(self) -> tuple[tuple[str, str], ...]:
        """Entries of ``stiffness`` that couple plane y, the axis and all else to one another."""
        part = {"y": "plane", "thz": "plane", "x": "axis"}
        return tuple(pair for pair in self._stiff if part.get(pair[0]) != part.get(pair[1]))

    @property
    def _stiff(self) -> tuple[tuple[str, str], ...]:
        return tuple(pair for pair, value in self.stiffness.items() if abs(value) > 0.0)


def rigid_and_elastic(rigid: Iterable[str], entries: Iterable[tuple[str, str]]) -> Iterator[str]:
    """A sentence for every freedom that is held rigidly and has ``entries`` of a matrix as well."""
    named = {freedom for pair in entries for freedom in pair}
    for freedom in dict.fromkeys(rigid):
        if freedom in named:
            yield f"{freedom} is held rigidly and has entries of stiffness or damping: one of both"


def coupled_motions(supports: Iterable[LinearSupport]) -> frozenset[str]:
    """Those of ``"bending"``, ``"axial"`` and ``"torsion"`` that supports couple to another one."""
    pairs = (
        (MOTIONS[row], MOTIONS[column])
        for support in supports
        for entries in (support.stiffness, support.damping)
        for (row, column), value in entries.items()
        if value != 0.0
    )
    return frozenset(motion for pair in pairs if pair[0] != pair[1] for motion in pair)
