"""How a machine is modelled: what all analyses of a case share (SI)."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Annotated

from bearings.ball.law import DYNAMICS, KINEMATICS, MOMENT_SHARING, Law
from rotordyn.description import Description, Faults, named_twice
from rotordyn.machine.history import HistoryStep, history_faults
from rotordyn.machine.temperatures import Temperatures
from rotordyn.quantity import HIDDEN, Accuracy, Choice, Force, Friction, Length
from rotordyn.scene.formulation import FORMULATIONS, INERTIAL
from rotordyn.scene.heat_flow import SpindleHeatFlow
from rotordyn.scene.loads import PointLoad
from rotordyn.scene.lubrication import Lubrication
from rotordyn.units import STANDARD_GRAVITY

TANGENTS = ("complete", "frozen", "difference")
BEARINGS = ("dynamic", "static")
ROTOR = ("flexible", "rigid")
HYPOTHESES = ("kinematics", "moment_sharing")
GRAVITY = ("none", "+x", "-x", "+y", "-y", "+z", "-z")
Tangent = Annotated[str, Choice(TANGENTS)]


@dataclass(frozen=True, slots=True)
class Conditions(Description):
    """How the machine is modelled; all optional.

    ``law``: hypotheses on the balls. Infinite friction means no limit. ``stated``: those of
    ``HYPOTHESES`` that a file gives, of which some are defaults all the same.
    """

    kinematics: Annotated[
        str, Choice(KINEMATICS), "hypothesis of the ball's rotation axis ([theory](theory/ball.md))"
    ] = "hybrid"
    moment_sharing: Annotated[
        str, Choice(MOMENT_SHARING), "race that carries the gyroscopic moment"
    ] = "equal"
    friction: Annotated[
        Friction,
        "coefficient that limits the gyroscopic moment on a race "
        "([theory](theory/ball.md#friction)); `none`: no limit",
    ] = math.inf
    dynamics: Annotated[
        str,
        Choice(DYNAMICS),
        "inertia of the balls; `frozen`: centrifugal force at the free contact angle, no "
        "gyroscopic moment ([theory](theory/four_point.md#at-speed)); `centrifugal`, `gyroscopic`: "
        "one of the two alone",
    ] = DYNAMICS[0]
    tangent: Annotated[
        Tangent,
        "stiffness of a spindle's bearings where they act as springs "
        "([theory](theory/ball.md#the-tangent))",
    ] = "complete"
    bearings: Annotated[
        str, Choice(BEARINGS), "`static`: the state at rest is used at every speed"
    ] = "dynamic"
    rotor: Annotated[
        str, Choice(ROTOR), "`rigid`: the shaft and its joints do not bend, stretch or twist"
    ] = "flexible"
    axial_force: Annotated[
        Force, "external force on the front end of the shaft (of the tool), towards +x"
    ] = 0.0
    tension: Annotated[
        Force, "force that pulls at both ends of the shaft and needs no support; below 0 it presses"
    ] = 0.0
    gravity: Annotated[
        str, Choice(GRAVITY), "direction of the rotor's weight; sleeves are not weighed"
    ] = "none"
    loads: Annotated[
        tuple[PointLoad, ...],
        "static loads on the shaft: cutting force, pull of a belt or magnet; every analysis takes "
        "the state of the bearings under them ([how](theory/loads.md))",
    ] = ()
    temperatures: Annotated[
        Temperatures | None,
        "temperatures of shaft, housing, rings and balls; by default those of the reference "
        "([effects](theory/rings.md#temperature))",
    ] = None
    heat_flow: Annotated[
        SpindleHeatFlow | None,
        "conductances by which the heat of every bearing leaves, instead of `temperatures`: these "
        "and the preload follow from it ([theory](theory/life.md#temperatures))",
    ] = None
    history: Annotated[
        tuple[HistoryStep, ...],
        "steps from assembly on, on which the dry friction of sleeves depends. By default the "
        "spindle takes its temperatures and runs up to every speed of the case. At each of them "
        "the temperatures and forces of the conditions come last "
        "([how](theory/network.md#friction-in-all-analyses))",
    ] = ()
    films: Annotated[
        Lubrication | None,
        "oil whose films separate the balls of every bearing from the races: films act as larger "
        "balls and as springs in series ([theory](theory/life.md#films)); by default balls touch "
        "their races",
    ] = None
    accuracy: Annotated[
        Accuracy,
        "allowed relative error of every requested frequency, which determines the elements",
    ] = 1e-4
    element_length: Annotated[
        Length | None, "greatest length of standard elements instead, whatever their error"
    ] = None
    formulation: Annotated[
        str,
        Choice(FORMULATIONS),
        "frame in which bending is written ([the three](formulations.md))",
    ] = INERTIAL
    axial_stiffening: Annotated[
        bool, "the axial force in the shaft stiffens or softens its bending"
    ] = True
    stated: Annotated[tuple[str, ...], HIDDEN] = field(default=(), repr=False, compare=False)

    def _faults(self) -> Faults:
        yield from named_twice("loads", self.loads)
        for path, sentence in history_faults(self.history):
            yield ("history", *path), sentence
        if self.temperatures is None and self.heat_flow is None:
            for k, step in enumerate(self.history):
                if step.warm:
                    yield (
                        ("history", k, "warm"),
                        "no temperatures are given for this step: given {given}; allowed: beside "
                        "temperatures or heat_flow in the conditions",
                    )

    @property
    def pull(self) -> tuple[float, float, float]:
        """Acceleration of gravity along x, y and z [m/s²]."""
        return gravity_vector(self.gravity)

    @property
    def total_axial_force(self) -> float:
        """External force along the axis towards +x, that of loads included [N]."""
        return self.axial_force + sum(load.Fx for load in self.loads)

    @property
    def law(self) -> Law:
        """Hypotheses on the balls."""
        friction = None if math.isinf(self.friction) else self.friction
        return Law(self.kinematics, self.moment_sharing, friction, self.dynamics)


def gravity_vector(gravity: str) -> tuple[float, float, float]:
    """Return the acceleration along x, y and z [m/s²] of gravity along "+x", "-y" …; else zero."""
    size = -STANDARD_GRAVITY if gravity.startswith("-") else STANDARD_GRAVITY
    x, y, z = (size if gravity[1:] == axis else 0.0 for axis in "xyz")
    return x, y, z
