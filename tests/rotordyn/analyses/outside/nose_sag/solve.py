"""Mass of the rotor, and how far it would sag."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rotordyn.arrays import Array, Words
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.results.declaration import coordinate, quantity


@dataclass(frozen=True)
class NoseSag:
    """Weight on the bearings over speed."""

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    outcome: Words = quantity("speed", unit="", label="outcome")
    weight: Array = quantity("speed", unit="N", label="weight")
    rotor_mass: float = quantity(unit="kg", label="mass of the rotor")


def solve(scene, spec):
    """The result."""
    mass = rotor_inertia(scene.spindle.part("spindle")).mass
    return NoseSag(scene.speed, scene.outcome, np.full(len(scene.speed), 9.81 * mass), mass)


def summary(result):
    """A line."""
    return [f"nose sag   a rotor of {result.rotor_mass:.1f} kg"]
