"""A joint between two parts of the shaft: a tool holder, a flange, a cone with face contact."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from rotordyn.description import Description
from rotordyn.quantity import Damping, Name, Rigidity, Station, TiltDamping, TiltRigidity

WAYS = ("radial", "tilt", "axial", "torsion")


@dataclass(frozen=True, slots=True)
class Joint(Description):
    """Springs and dampers between the part of the shaft in front of ``x`` [m] and the part behind.

    They turn with the shaft and answer alike in all directions about it. ``radial``, ``axial``
    [N/m], ``tilt``, ``torsion`` [N·m/rad]; infinite = the parts move as one. Dampers likewise
    [N·s/m, N·m·s/rad]. What sits at ``x`` belongs to the part in front.
    """

    name: Name
    x: Station
    radial: Rigidity = math.inf
    tilt: TiltRigidity = math.inf
    axial: Rigidity = math.inf
    torsion: TiltRigidity = math.inf
    radial_damping: Damping = 0.0
    tilt_damping: TiltDamping = 0.0
    axial_damping: Damping = 0.0
    torsion_damping: TiltDamping = 0.0

    def _faults(self) -> Iterator[str]:
        yield from joint_faults(self)


class Springs(Protocol):
    """A joint, as it is given or as it is read."""

    @property
    def radial(self) -> float: ...
    @property
    def tilt(self) -> float: ...
    @property
    def axial(self) -> float: ...
    @property
    def torsion(self) -> float: ...
    @property
    def radial_damping(self) -> float: ...
    @property
    def tilt_damping(self) -> float: ...
    @property
    def axial_damping(self) -> float: ...
    @property
    def torsion_damping(self) -> float: ...


def joint_faults(joint: Springs) -> Iterator[str]:
    """A joint gives way somewhere, and is damped only there."""
    if all(math.isinf(getattr(joint, way)) for way in WAYS):
        yield f"a joint that gives way nowhere: one of {', '.join(WAYS)} must be given"
    for way in WAYS:
        if math.isinf(getattr(joint, way)) and getattr(joint, f"{way}_damping") > 0.0:
            yield f"{way} is rigid and has a damper: give it a stiffness as well"
