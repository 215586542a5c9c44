"""How a machine is modelled."""

from __future__ import annotations

import math
from typing import Annotated

from bearings.ball.law import KINEMATICS, MOMENT_SHARING
from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.values import Accuracy, Flag, Force, Friction, Length, choice
from rotordyn.scene.conditions import BEARINGS, GRAVITY, ROTOR, TANGENTS
from rotordyn.scene.formulation import FORMULATIONS, INERTIAL

Kinematics = Annotated[str, choice(*KINEMATICS)]
Tangent = Annotated[str, choice(*TANGENTS)]
MomentSharing = Annotated[str, choice(*MOMENT_SHARING)]


class ConditionsEntry(Entry):
    """How the machine is modelled; all optional."""

    kinematics: Kinematics = "hybrid"
    moment_sharing: MomentSharing = "equal"
    friction: Friction = math.inf
    tangent: Tangent = "complete"
    bearings: Annotated[str, choice(*BEARINGS)] = "dynamic"
    rotor: Annotated[str, choice(*ROTOR)] = "flexible"
    axial_force: Force = 0.0
    tension: Force = 0.0
    gravity: Annotated[str, choice(*GRAVITY)] = "none"
    accuracy: Accuracy = 1e-4
    element_length: Length | None = None
    formulation: Annotated[str, choice(*FORMULATIONS)] = INERTIAL
    axial_stiffening: Flag = True
