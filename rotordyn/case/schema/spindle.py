"""A spindle: ``models/spindles/*.yaml``."""

from __future__ import annotations

from typing import Any

from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.drawbar import DrawbarEntry
from rotordyn.case.schema.growth import GrowthEntry, ShorteningEntry
from rotordyn.case.schema.housing import HousingEntry
from rotordyn.case.schema.joint import JointEntry
from rotordyn.case.schema.reference import ReferenceEntry
from rotordyn.case.schema.shaft import DiscEntry, MassEntry, ShaftEntry
from rotordyn.case.schema.support import (
    BearingDampingEntry,
    SeatEntry,
    SleeveEntry,
    SupportEntry,
)
from rotordyn.case.schema.values import (
    DampingRatio,
    LossFactor,
    MassDamping,
    Name,
    Share,
    Station,
    StiffnessDamping,
    Text,
)


class RayleighEntry(Entry):
    """Damping α M + β K of the rotor."""

    mass: MassDamping = 0.0
    stiffness: StiffnessDamping = 0.0


class DampingEntry(Entry):
    """Damping of all bearings that give none of their own, and of the rotor."""

    bearings: BearingDampingEntry = BearingDampingEntry()
    rotor: list[DampingRatio] = []
    internal: Share = 0.0
    rayleigh: RayleighEntry = RayleighEntry()
    loss_factor: LossFactor = 0.0

    @property
    def of_rotor(self) -> bool:
        """The rotor itself is damped."""
        return any(self.rotor) or bool(self.rayleigh.mass or self.rayleigh.stiffness)


class SpindleEntry(Entry):
    """A rotor and what holds it.

    ``growth``, ``damping`` and ``bearing_override`` serve every bearing; a bearing's own ``growth``
    or ``damping`` replaces them, its ``model_override`` goes on top.
    """

    title: Text = ""
    note: Text = ""
    sources: list[Text] = []
    shaft: ShaftEntry
    masses: list[MassEntry] = []
    discs: list[DiscEntry] = []
    bearings: list[SeatEntry] = []
    bearing_override: dict[str, Any] = {}
    growth: GrowthEntry = GrowthEntry()
    shortening: ShorteningEntry | None = None
    sleeves: list[SleeveEntry] = []
    supports: list[SupportEntry] = []
    housings: list[HousingEntry] = []
    joints: list[JointEntry] = []
    drawbar: DrawbarEntry | None = None
    damping: DampingEntry = DampingEntry()
    points: dict[Name, Station] = {}
    references: list[ReferenceEntry] = []
