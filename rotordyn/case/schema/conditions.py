"""How a machine is modelled."""

from __future__ import annotations

from typing import Annotated

from rotordyn.analysis.formulation import FORMULATIONS
from rotordyn.analysis.specs import TANGENTS
from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.values import Flag, Force, Length, choice

Kinematics = Annotated[str, choice("hybrid", "outer", "inner", "geometric")]
Tangent = Annotated[str, choice(*TANGENTS)]
MomentSharing = Annotated[str, choice("equal", "outer", "inner", "hybrid")]


class ConditionsEntry(Entry):
    """How the machine is modelled; all optional."""

    kinematics: Kinematics = "hybrid"
    moment_sharing: MomentSharing = "equal"
    tangent: Tangent = "complete"
    bearings: Annotated[str, choice("dynamic", "static")] = "dynamic"
    rotor: Annotated[str, choice("flexible", "rigid")] = "flexible"
    axial_force: Force = 0.0
    gravity: Annotated[str, choice("none", "+x", "-x")] = "none"
    element_length: Length | None = None
    formulation: Annotated[str, choice(*FORMULATIONS)] = "inertial"
    axial_stiffening: Flag = True
