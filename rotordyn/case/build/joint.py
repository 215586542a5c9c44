"""Joints of the shaft."""

from __future__ import annotations

from dataclasses import dataclass

from rotordyn.case.schema.joint import JointEntry
from rotordyn.machine.joint import WAYS, Joint


@dataclass(frozen=True, slots=True)
class Springs:
    """The springs and dampers of a joint as read, before anything of them is checked."""

    radial: float
    tilt: float
    axial: float
    torsion: float
    radial_damping: float
    tilt_damping: float
    axial_damping: float
    torsion_damping: float


def springs(entry: JointEntry) -> Springs:
    """The numbers of a joint."""
    own = {way: getattr(entry, way) for way in WAYS}
    return Springs(**own, **{f"{way}_damping": getattr(entry.damping, way) for way in WAYS})


def joint(entry: JointEntry) -> Joint:
    """A joint of a checked file."""
    found = springs(entry)
    own = {way: getattr(found, way) for way in WAYS}
    dampers = {f"{way}_damping": getattr(found, f"{way}_damping") for way in WAYS}
    return Joint(entry.name, entry.x, **own, **dampers)
