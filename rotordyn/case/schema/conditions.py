"""How a machine is modelled."""

from __future__ import annotations

from typing import Annotated

from rotordyn.analysis.formulation import FORMULATIONS
from rotordyn.analysis.shaft import SHAFT
from rotordyn.analysis.specs import (
    BEARINGS,
    GRAVITY,
    KINEMATICS,
    MOMENT_SHARING,
    ROTOR,
    TANGENTS,
)
from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.values import Flag, Force, Length, choice

Kinematics = Annotated[str, choice(*KINEMATICS)]
Tangent = Annotated[str, choice(*TANGENTS)]
MomentSharing = Annotated[str, choice(*MOMENT_SHARING)]


class ConditionsEntry(Entry):
    """How the machine is modelled; all optional."""

    kinematics: Kinematics = "hybrid"
    moment_sharing: MomentSharing = "equal"
    tangent: Tangent = "complete"
    bearings: Annotated[str, choice(*BEARINGS)] = "dynamic"
    rotor: Annotated[str, choice(*ROTOR)] = "flexible"
    axial_force: Force = 0.0
    gravity: Annotated[str, choice(*(way or "none" for way in GRAVITY))] = "none"
    element_length: Length | None = None
    formulation: Annotated[str, choice(*FORMULATIONS)] = "inertial"
    axial_stiffening: Flag = True
    shaft: Annotated[str, choice(*SHAFT)] = "elements"
