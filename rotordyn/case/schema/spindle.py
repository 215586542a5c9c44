"""A spindle: ``models/spindles/*.yaml``."""

from __future__ import annotations

from typing import Any

from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.drawbar import DrawbarEntry
from rotordyn.case.schema.growth import GrowthEntry, ShorteningEntry
from rotordyn.case.schema.housing import HousingEntry
from rotordyn.case.schema.joint import JointEntry
from rotordyn.case.schema.reference import ReferenceEntry
from rotordyn.case.schema.rotor import RotorDampingEntry, RotorEntry
from rotordyn.case.schema.shaft import DiscEntry, MassEntry, ShaftEntry
from rotordyn.case.schema.squeeze_film import SqueezeFilmDamperEntry
from rotordyn.case.schema.support import (
    BearingDampingEntry,
    SeatEntry,
    SleeveEntry,
    SupportEntry,
)
from rotordyn.case.schema.values import LossFactor, Name, Station, Text


class DampingEntry(RotorDampingEntry):
    """Damping of all bearings that give none of their own, and of the rotor."""

    bearings: BearingDampingEntry = BearingDampingEntry()
    loss_factor: LossFactor = 0.0


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
    dampers: list[SqueezeFilmDamperEntry] = []
    housings: list[HousingEntry] = []
    joints: list[JointEntry] = []
    rotors: list[RotorEntry] = []
    drawbar: DrawbarEntry | None = None
    damping: DampingEntry = DampingEntry()
    points: dict[Name, Station] = {}
    references: list[ReferenceEntry] = []
