"""Specification of the matrices of the equation of motion, for other programs (SI)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from rotordyn.analyses.measured_response import Port
from rotordyn.description import Faults, repeated
from rotordyn.machine.assembly import misnamed, unknown
from rotordyn.quantity import Frequency, Items
from rotordyn.scene.formulation import ROTATING
from rotordyn.scene.spec import Setting, Spec


@dataclass(frozen=True, slots=True)
class MatricesSpec(Spec):
    """The equation of motion at every speed by its matrices, for programs of control, of
    simulation, of substructures."""

    max_frequency: Annotated[Frequency, "highest frequency of the model"]
    ports: Annotated[
        tuple[Port, ...],
        Items(),
        "points and directions of forces and motion: `nose.y`",
    ]

    def _faults(self) -> Faults:
        yield from repeated("ports", (str(port) for port in self.ports))

    def faults_on(self, setting: Setting) -> Faults:
        spindle = setting.spindle
        if setting.conditions.formulation == ROTATING:
            yield (), "the matrices are those of the fixed frame: take formulation: inertial"
        if spindle.hysteretic:
            yield (
                (),
                "a loss factor is defined for steady vibration and has no damping matrix: give "
                "damping.rotor, or damping of bearings and supports, instead",
            )
        if misnamed(spindle):
            return
        for index, port in enumerate(self.ports):
            for sentence in unknown("point", port.point, spindle.places):
                yield ("ports", index), sentence
