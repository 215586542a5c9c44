"""A joint between two parts of the shaft: a tool holder, a flange, a cone with face contact."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description, Faults
from rotordyn.quantity import Damping, Key, Name, Rigidity, Station, TiltDamping, TiltRigidity

WAYS = ("radial", "tilt", "axial", "torsion")


@dataclass(frozen=True, slots=True)
class Joint(Description):
    """Springs and dampers between the part of the shaft in front of ``x`` and the part behind.

    They turn with the shaft and are isotropic about its axis. [N/m], [N·m/rad]; what is
    not given is rigid. Dampers [N·s/m], [N·m·s/rad] act in directions that have a stiffness.
    """

    name: Annotated[Name, "name of the joint"]
    x: Annotated[Station, "station; what sits there belongs to the part in front"]
    radial: Annotated[Rigidity, "spring across the axis"] = math.inf
    tilt: Annotated[TiltRigidity, "spring against bending"] = math.inf
    axial: Annotated[Rigidity, "spring along the axis"] = math.inf
    torsion: Annotated[TiltRigidity, "spring against twist"] = math.inf
    radial_damping: Annotated[Damping, Key("damping.radial"), "across the axis"] = 0.0
    tilt_damping: Annotated[TiltDamping, Key("damping.tilt"), "against bending"] = 0.0
    axial_damping: Annotated[Damping, Key("damping.axial"), "along the axis"] = 0.0
    torsion_damping: Annotated[TiltDamping, Key("damping.torsion"), "against twist"] = 0.0

    def _faults(self) -> Faults:
        if all(math.isinf(getattr(self, way)) for way in WAYS):
            yield (), f"a joint without flexibility: give at least one of {', '.join(WAYS)}"
        for way in WAYS:
            if math.isinf(getattr(self, way)) and getattr(self, f"{way}_damping") > 0.0:
                yield (), f"{way} is rigid and has a damper: give it a stiffness as well"
