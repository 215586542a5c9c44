"""A further rotor on the axis of a spindle, as written in spindle files."""

from __future__ import annotations

from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.joint import JointEntry
from rotordyn.case.schema.shaft import DiscEntry, MassEntry, ShaftEntry
from rotordyn.case.schema.values import (
    DampingRatio,
    MassDamping,
    Name,
    Share,
    SpeedRatio,
    Station,
    StiffnessDamping,
)


class RayleighEntry(Entry):
    """Damping α M + β K of the rotor."""

    mass: MassDamping = 0.0
    stiffness: StiffnessDamping = 0.0


class RotorDampingEntry(Entry):
    """Damping of the rotor itself."""

    rotor: list[DampingRatio] = []
    internal: Share = 0.0
    rayleigh: RayleighEntry = RayleighEntry()


class RotorEntry(Entry):
    """A further rotor inside, around or beside the shaft, at stations of the same axis.

    Supports hold it, by its name.
    """

    name: Name
    speed_ratio: SpeedRatio
    shaft: ShaftEntry
    masses: list[MassEntry] = []
    discs: list[DiscEntry] = []
    joints: list[JointEntry] = []
    damping: RotorDampingEntry = RotorDampingEntry()
    points: dict[Name, Station] = {}
