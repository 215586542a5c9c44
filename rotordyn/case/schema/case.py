"""A case file: which machine, how modelled, at which speeds, which questions."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import Field

from rotordyn.analysis.formulation import FORMULATIONS
from rotordyn.case.schema.analyses import AnalysesEntry
from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.reference import ReferenceEntry
from rotordyn.case.schema.sweep import Speeds
from rotordyn.case.schema.values import Flag, Force, Length, Text, choice

Kinematics = Annotated[str, choice("hybrid", "outer", "inner", "geometric")]
MomentSharing = Annotated[str, choice("equal", "outer", "inner", "hybrid")]


class ConditionsEntry(Entry):
    """How the machine is modelled; all optional."""

    kinematics: Kinematics = "hybrid"
    moment_sharing: MomentSharing = "equal"
    bearings: Annotated[str, choice("dynamic", "static")] = "dynamic"
    rotor: Annotated[str, choice("flexible", "rigid")] = "flexible"
    axial_force: Force = 0.0
    gravity: Annotated[str, choice("none", "+x", "-x")] = "none"
    element_length: Length | None = None
    formulation: Annotated[str, choice(*FORMULATIONS)] = "inertial"
    axial_stiffening: Flag = True


class CaseEntry(Entry):
    """The case itself; the machine it names is read apart (``spindle``, ``tool``, ``bearing``)."""

    title: Text = ""
    note: Text = ""
    spindle: Any = None
    tool: Any = None
    bearing: Any = None
    override: dict[str, Any] = Field(default_factory=dict)
    conditions: ConditionsEntry = ConditionsEntry()
    speeds: Speeds
    analyses: AnalysesEntry
    references: list[ReferenceEntry] = []
