"""Specification of a cycle of axial force (SI)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Faults
from rotordyn.quantity import Force, Whole
from rotordyn.scene.spec import Setting, Spec

MOST_STEPS = 1000


@dataclass(frozen=True, slots=True)
class AxialCycleSpec(Spec):
    """A closed cycle of an axial force on the shaft between two forces [N], at every speed."""

    lowest: Annotated[Force, "lowest force towards +x"] = -1000.0
    highest: Annotated[Force, "highest force towards +x"] = 1000.0
    steps: Annotated[int, Whole(1, MOST_STEPS), "number of steps from lowest to highest"] = 50

    def _faults(self) -> Faults:
        if self.highest <= self.lowest:
            yield ("highest",), "no cycle: given {given}; allowed: a force above the lowest"

    def faults_on(self, setting: Setting) -> Faults:
        if setting.spindle.rotors:
            yield (), "a cycle of axial force is solved for one rotor only: leave out the rotors"
        if setting.loaded:
            yield (
                (),
                "a cycle of axial force needs bearings under axial load alone: leave out loads "
                "and weight across the axis and misalignments",
            )
