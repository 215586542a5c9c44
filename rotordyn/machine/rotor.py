"""A further rotor on the axis of the spindle: inside its shaft, around it, or beside it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, NamedTuple

from rotordyn.description import Description, Faults
from rotordyn.machine.joint import Joint
from rotordyn.machine.lumped import Disc, PointMass
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.station import on_the_shaft, turning_faults
from rotordyn.quantity import (
    DampingRatio,
    Key,
    MassDamping,
    Name,
    Share,
    SpeedRatio,
    Station,
    StiffnessDamping,
)


@dataclass(frozen=True, slots=True)
class RayleighDamping(Description):
    """Damping α M + β K of the rotor alone."""

    mass: Annotated[MassDamping, "α, by which the mass matrix of the rotor is multiplied"] = 0.0
    stiffness: Annotated[StiffnessDamping, "β, by which its stiffness matrix is multiplied"] = 0.0

    def __bool__(self) -> bool:
        return bool(self.mass or self.stiffness)


ModalDamping = Annotated[
    tuple[DampingRatio, ...],
    Key("damping.rotor"),
    "modal damping ratios of the flexible free-free bending modes at rest, the last repeated",
]
TurningShare = Annotated[
    Share,
    Key("damping.internal"),
    "share of `rotor` and `rayleigh` that turns with it ([why](theory/damping.md))",
]
Rayleigh = Annotated[
    RayleighDamping,
    Key("damping.rayleigh"),
    "damping by mass and stiffness, added to `rotor`",
]


class Place(NamedTuple):
    """A station ``x`` [m] on a rotor, the spindle's shaft being ``"spindle"``."""

    rotor: str
    x: float


@dataclass(frozen=True, slots=True)
class Rotor(Description):
    """A further rotor inside, around or beside the shaft, at stations of the same axis.

    Supports hold it, by its name.
    """

    name: Annotated[
        Name, "name in supports, points and results, different from those of supports and bearings"
    ]
    speed_ratio: Annotated[
        SpeedRatio,
        "its speed over that of the spindle: 1 turns with it, 0 does not turn, below 0 turns in "
        "the opposite direction",
    ]
    shaft: Annotated[Shaft, "shaft of the rotor, at stations of the same axis"]
    masses: Annotated[tuple[PointMass, ...], "rigid masses on it"] = ()
    discs: Annotated[tuple[Disc, ...], "rigid discs on it"] = ()
    points: Annotated[
        Mapping[Name, Station], "named stations; elsewhere they are called ROTOR.POINT"
    ] = field(default_factory=dict)
    rotor_damping: ModalDamping = ()
    internal_damping: TurningShare = 0.0
    rayleigh: Rayleigh = field(default_factory=RayleighDamping)
    joints: Annotated[tuple[Joint, ...], "between parts of its shaft"] = ()

    def _faults(self) -> Faults:
        yield from turning_faults(self.shaft, self.masses, self.discs, self.joints)
        reach = self.shaft.reach
        for name, x in self.points.items():
            yield from on_the_shaft("point", x, reach, ("points", name))
