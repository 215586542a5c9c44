"""Specification of the radial stiffness of a point (SI)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Annotated

from rotordyn.description import Faults, repeated, unchecked
from rotordyn.machine.assembly import unknown
from rotordyn.machine.matrix import entry_name
from rotordyn.quantity import Choice, LightLoad, Name, Travel, Whole
from rotordyn.scene.spec import Setting, Spec

VARIANTS = ("nonlinear", "full", "diagonal", "constant_preload")
MOST_STEPS = 1000


@dataclass(frozen=True, slots=True)
class StiffnessSpec(Spec):
    """Quasi-static radial stiffness of a point under forces from 0 to ``max_force`` [N]."""

    point: Annotated[Name, "where the force acts and the deflection is taken"]
    max_force: Annotated[LightLoad, "highest radial force"] = 500.0
    steps: Annotated[int, Whole(1, MOST_STEPS), "number of load steps up to it"] = 10
    variants: Annotated[
        tuple[Annotated[str, Choice(VARIANTS)], ...],
        "ways of modelling the bearings ([theory](theory/radial_stiffness.md))",
    ] = VARIANTS
    second_stop: Annotated[
        Mapping[Name, Travel],
        "other stop travels by sleeve, computed as an additional (nonlinear) variant",
    ] = field(default_factory=dict)

    def _faults(self) -> Faults:
        if not self.variants and not self.second_stop:
            yield ("variants",), "no variants: at least one is needed"
        yield from repeated("variants", self.variants)

    @property
    def unloaded(self) -> StiffnessSpec:
        """Copy without load steps: tangents alone, which headline numbers and curves show."""
        with unchecked():
            return replace(self, steps=0)

    def faults_on(self, setting: Setting) -> Faults:
        spindle = setting.spindle
        for what, present in (("housings", spindle.housings), ("further rotors", spindle.rotors)):
            if present:
                yield (
                    (),
                    f"the radial stiffness does not model {what}: use frf at a low frequency "
                    "instead",
                )
        for sentence in unknown("point", self.point, spindle.points):
            yield ("point",), sentence
        if setting.loaded and (self.second_stop or {*self.variants} != {"nonlinear"}):
            yield (
                ("variants",),
                "under static loads of the case (loads, weight, misaligned seats) the radial "
                "stiffness is solved by the full bearing model alone: given {given}; allowed: "
                "variants: [nonlinear], without second_stop",
            )
        oiled, heated = setting.conditions.films, setting.conditions.heat_flow
        if self.second_stop and (oiled is not None or heated is not None):
            yield (
                ("second_stop",),
                "films and temperatures from the heat of bearings would be those of the first "
                "stop: leave second_stop out and compare with a variant that has the other "
                "stop_travel",
            )
        for name in self.second_stop:
            for sentence in unknown("sleeve", name, [sleeve.name for sleeve in spindle.sleeves]):
                yield ("second_stop", name), sentence
        for support in spindle.supports:
            if support.out_of_plane:
                entries = ", ".join(entry_name(*pair) for pair in support.out_of_plane)
                yield (
                    (),
                    f"support '{support.name}' couples plane y or the axis to other motions "
                    f"({entries}): the radial stiffness is solved in plane y alone; use frf at a "
                    "low frequency instead",
                )
