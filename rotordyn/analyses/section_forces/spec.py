"""Specification of section forces of the shaft at rest under static loads (SI)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Faults, Path, repeated
from rotordyn.errors import InvalidInput
from rotordyn.machine.spindle import Spindle
from rotordyn.quantity import Choice
from rotordyn.scene.loads import LineLoad, PointLoad, TwistLimit, Unbalance
from rotordyn.scene.spec import Setting, Spec, placed, redundant_support_faults, span_faults

WEIGHT = ("none", "+x", "-x", "+y", "-y", "+z", "-z")


@dataclass(frozen=True, slots=True)
class SectionForcesSpec(Spec):
    """N, Ty, Tz, Mt, My, Mz, deflection and stress along the shaft under static loads.

    Loads add to what the preload state puts on the shaft along its axis.
    """

    loads: Annotated[tuple[PointLoad, ...], "forces and moments at points or stations"] = ()
    line_loads: Annotated[tuple[LineLoad, ...], "forces per length"] = ()
    unbalances: Annotated[tuple[Unbalance, ...], "rotating forces at one angular position"] = ()
    gravity: Annotated[
        str, Choice(WEIGHT), "direction of the rotor's weight, in any of the axes"
    ] = "none"
    twist_limits: Annotated[
        tuple[TwistLimit, ...], "limits of the twist of the shaft, for which diameters are computed"
    ] = ()

    def _faults(self) -> Faults:
        yield from repeated("twist_limits", (limit.called for limit in self.twist_limits))

    def faults_on(self, setting: Setting) -> Faults:
        spindle, conditions = setting.spindle, setting.conditions
        if spindle.rotors:
            yield (), "section forces are solved for one rotor only: leave out the rotors"
        if setting.loaded:
            yield (
                (),
                "section forces have their own loads, and bearings under axial load alone: "
                "move loads and weight of the conditions to the analysis, and leave out misaligned "
                "seats",
            )
        weighed = any(word not in ("", "none") for word in (self.gravity, conditions.gravity))
        acting = spindle.seats or spindle.drawbar or conditions.axial_force or conditions.tension
        if not (self.loads or self.line_loads or self.unbalances or weighed or acting):
            yield (
                (),
                "no load acts: allowed: at least one of loads, line_loads, unbalances, gravity",
            )
        for index, load in enumerate(self.loads):
            yield from placed(load.at, spindle, ("loads", index, "at"))
        for index, unbalance in enumerate(self.unbalances):
            yield from placed(unbalance.at, spindle, ("unbalances", index, "at"))
        for index, line in enumerate(self.line_loads):
            yield from span_faults(line.start, line.to, spindle, ("line_loads", index))
        for index, limit in enumerate(self.twist_limits):
            path = "twist_limits", index
            faults = [*span_faults(limit.start, limit.to, spindle, path)]
            yield from faults or _of_one_part(limit, spindle, path)
        if not {self.gravity, conditions.gravity} & {"", "none"}:
            yield (
                ("gravity",),
                f"the weight is given twice: given '{self.gravity}' and '{conditions.gravity}' "
                "in the conditions; allowed: one of the two",
            )

    def last_faults_on(self, setting: Setting) -> Faults:
        """Require that the shaft is no free body under its loads, and reactions are determined."""
        from rotordyn.analyses.section_forces.static_loads import require_held

        if faults := [*redundant_support_faults(setting)]:
            yield from faults
            return
        try:
            require_held(setting.spindle, self, setting.conditions)
        except InvalidInput as fault:
            yield ("loads",), str(fault)

    @property
    def places(self) -> tuple[str | float, ...]:
        """Points and stations at which loads act or twist is evaluated."""
        places = [load.at for load in self.loads] + [load.at for load in self.unbalances]
        places += [at for span in self.line_loads for at in (span.start, span.to)]
        places += [at for span in self.twist_limits for at in (span.start, span.to)]
        return tuple(places)


def _of_one_part(limit: TwistLimit, spindle: Spindle, path: Path) -> Faults:
    """A fault where a joint that twists is between the ends: no diameter makes it twist less."""
    if "" in (limit.start, limit.to):
        return
    first, last = (spindle.place(at).x for at in (limit.start, limit.to))
    for joint in spindle.joints:
        if first < joint.x < last and math.isfinite(joint.torsion):
            yield (
                path,
                f"joint '{joint.name}' twists between both ends: allowed: from and to on one of "
                f"the parts that it joins at {joint.x * 1e3:.6g} mm",
            )
