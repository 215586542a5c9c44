"""What holds the shaft: bearings, sleeves with their springs, linear supports."""

from __future__ import annotations

import math
from typing import Annotated, Any

from pydantic import BeforeValidator, Field

from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.bearing import AnyBearing
from rotordyn.case.schema.conditions import Kinematics, MomentSharing
from rotordyn.case.schema.growth import GrowthEntry
from rotordyn.case.schema.matrix import (
    DampingMatrix,
    DampingMatrixEntry,
    Freedoms,
    StiffnessMatrix,
    StiffnessMatrixEntry,
)
from rotordyn.case.schema.values import (
    Damping,
    Friction,
    LossFactor,
    Mass,
    Name,
    Preload,
    Rigidity,
    Speed,
    Station,
    StopTravel,
    Text,
    choice,
    none_if_unknown,
)
from rotordyn.machine.support import BEYOND, GROUND, SPINDLE


class BearingDampingEntry(Entry):
    """Viscous damping between the rings of a bearing."""

    radial: Damping = 0.0
    axial: Damping = 0.0


class SeatEntry(Entry):
    """A bearing on the shaft; ``model_override`` is merged into the model before it is read.

    ``thrust`` must be given where the bearing takes thrust one way, or sits on a sleeve. What is
    assumed of its balls is that of the conditions of the case unless given here.
    """

    name: Name
    model: Annotated[AnyBearing | None, BeforeValidator(none_if_unknown)]
    model_override: dict[str, Any] = {}
    x: Station
    thrust: Annotated[str, choice("+x", "-x")] | None = None
    kinematics: Kinematics | None = None
    moment_sharing: MomentSharing | None = None
    friction: Friction | None = None
    growth: GrowthEntry | None = None
    damping: BearingDampingEntry | None = None


class SpringEntry(Entry):
    """Force at rest and stiffness of a preload spring."""

    preload: Preload
    stiffness: Rigidity


class SleeveEntry(Entry):
    """A sliding sleeve, its spring and its end stop."""

    name: Name
    bearings: Annotated[list[Name], Field(min_length=1)]
    spring: SpringEntry
    stop_travel: StopTravel = math.inf
    mass: Mass = 0.0
    radial_stiffness: Rigidity = math.inf


class SupportEntry(Entry):
    """A linear support to ground or to another rotor, by its matrices; nothing is made symmetric.

    An entry by name may be a list, one value at each of `speeds`, straight lines in between. Or
    freedoms held rigidly, which do not move.
    """

    name: Name
    x: Station
    stiffness: StiffnessMatrix = StiffnessMatrixEntry()
    damping: DampingMatrix = DampingMatrixEntry()
    rigid: Freedoms = []
    speeds: list[Speed] = []
    table: Text = ""
    loss_factor: LossFactor = 0.0
    holds: Name = SPINDLE
    against: Name = GROUND
    beyond: Annotated[str, choice(*BEYOND)] = "refuse"

    @property
    def ends(self) -> tuple[str, str]:
        """What it joins: a rotor, and a rotor or ground."""
        return self.holds, self.against
