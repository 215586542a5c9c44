"""How a machine is modelled: what all analyses of a case share (SI)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from bearings.ball.law import KINEMATICS, MOMENT_SHARING, Law
from rotordyn.description import Description
from rotordyn.quantity import Accuracy, Choice, Force, Friction, Length
from rotordyn.scene.formulation import FORMULATIONS, INERTIAL

TANGENTS = ("complete", "frozen", "difference")
BEARINGS = ("dynamic", "static")
ROTOR = ("flexible", "rigid")
GRAVITY = ("none", "+x", "-x")
Tangent = Annotated[str, Choice(TANGENTS)]


@dataclass(frozen=True, slots=True)
class Conditions(Description):
    """How the machine is modelled.

    ``kinematics``, ``moment_sharing``, ``friction`` (infinite: no limit): as in
    ``bearings.ball.law``, together ``law``. ``tangent``: of ``TANGENTS``, the
    stiffness of the bearings of a spindle wherever they act as linear springs. ``bearings``:
    ``"dynamic"`` (speed acts on the bearings) or ``"static"`` (their state at rest serves every
    speed). ``rotor``: ``"flexible"`` or ``"rigid"``. ``axial_force`` [N] on the front end of the
    shaft (of the tool) towards +x; ``tension`` [N] pulls at both of its ends; ``gravity``: of
    ``GRAVITY``, the way the weight of a vertical spindle points. ``accuracy``: relative error
    allowed of every frequency up to the highest asked for; the elements follow.
    ``element_length`` [m]: standard elements no longer than that instead, whatever their error.
    ``formulation``: of ``formulation.FORMULATIONS``, how bending is written.
    ``axial_stiffening``: the axial force in the shaft acts on its bending.
    """

    kinematics: Annotated[str, Choice(KINEMATICS)] = "hybrid"
    moment_sharing: Annotated[str, Choice(MOMENT_SHARING)] = "equal"
    friction: Friction = math.inf
    tangent: Tangent = "complete"
    bearings: Annotated[str, Choice(BEARINGS)] = "dynamic"
    rotor: Annotated[str, Choice(ROTOR)] = "flexible"
    axial_force: Force = 0.0
    tension: Force = 0.0
    gravity: Annotated[str, Choice(GRAVITY)] = "none"
    accuracy: Accuracy = 1e-4
    element_length: Length | None = None
    formulation: Annotated[str, Choice(FORMULATIONS)] = INERTIAL
    axial_stiffening: bool = True

    @property
    def law(self) -> Law:
        """What is assumed of the balls."""
        friction = None if math.isinf(self.friction) else self.friction
        return Law(self.kinematics, self.moment_sharing, friction)
