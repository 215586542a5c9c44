"""Specification of sag and runout (SI)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated

from rotordyn.description import Description, Faults, repeated
from rotordyn.errors import InvalidInput
from rotordyn.machine.assembly import unknown
from rotordyn.quantity import Angle, Choice, Eccentricity, Items, Name, Station
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.spec import Setting, Spec, redundant_support_faults

GRAVITY = ("-y", "+y", "-z", "+z", "none")


@dataclass(frozen=True, slots=True)
class RingRunout(Description):
    """Radial runout of an inner ring: full reading of a gauge over a turn, twice the
    eccentricity of its groove."""

    bearing: Annotated[Name, "the bearing, or a support that represents one"]
    runout: Annotated[Eccentricity, "Kia of the ring, full reading of a dial gauge (ISO 492)"]
    angle: Annotated[Angle, "where the ring is thickest, from y towards z"] = 0.0


@dataclass(frozen=True, slots=True)
class StaticSagSpec(Spec):
    """Deflection line of the shaft under its weight, and what a dial gauge at the nose reads.

    Sag does not turn with the shaft; the runout of the rings does.
    """

    point: Annotated[Name, "the nose, or the tool point"]
    gravity: Annotated[
        Annotated[str, Choice(GRAVITY)] | None,
        "direction of the weight, `none` for a vertical spindle; by default that of the "
        "conditions, or `-y` where they have none",
    ] = None
    gauges: Annotated[
        tuple[Station, ...],
        Items(),
        "distances in front of the point (towards −x) at which a gauge reads, on a straight test "
        "bar; below 0 behind it",
    ] = (0.0,)
    ring_runouts: Annotated[tuple[RingRunout, ...], "runouts of inner rings; others run true"] = ()

    def weight_of(self, conditions: Conditions) -> str:
        """Direction of the weight by which the shaft sags; none along its axis."""
        of_conditions = "" if conditions.gravity == "none" else conditions.gravity
        if self.gravity is not None or not of_conditions:
            return self.gravity or "-y"
        return of_conditions if of_conditions in GRAVITY else "none"

    def _faults(self) -> Faults:
        yield from repeated("ring_runouts", (ring.bearing for ring in self.ring_runouts), "bearing")
        yield from repeated("gauges", (f"{gauge * 1e3:g} mm" for gauge in self.gauges))

    def faults_on(self, setting: Setting) -> Faults:
        spindle, conditions = setting.spindle, setting.conditions
        if spindle.rotors:
            yield (), "the static sag is solved for one rotor only: leave out the rotors"
        for sentence in unknown("point", self.point, spindle.points):
            yield ("point",), sentence
        names = [*(s.name for s in spindle.seats), *(s.name for s in spindle.supports)]
        for index, ring in enumerate(self.ring_runouts):
            for sentence in unknown("bearing or support", ring.bearing, names):
                yield ("ring_runouts", index, "bearing"), sentence
        gravity, weighed = self.gravity, conditions.gravity not in ("", "none")
        if (
            gravity is not None
            and weighed
            and gravity != replace(self, gravity=None).weight_of(conditions)
        ):
            yield (
                ("gravity",),
                f"differs from the weight of the conditions: given '{gravity}', in the conditions "
                f"'{conditions.gravity}'; leave it out to use that of the conditions",
            )

    def last_faults_on(self, setting: Setting) -> Faults:
        """Require that the shaft is no free body under its weight, and reactions are determined."""
        from rotordyn.equation.mesh import station_mesh
        from rotordyn.equation.restraint import on_nodes, require_balance
        from rotordyn.scene.at_rest import weight

        spindle = setting.spindle
        if faults := [*redundant_support_faults(setting)]:
            yield from faults
            return
        mesh, down = station_mesh(spindle), self.weight_of(setting.conditions)
        try:
            require_balance(spindle, mesh.x, [on_nodes(*weight(spindle, mesh, down), mesh.x)])
        except InvalidInput as fault:
            yield ("gravity",), str(fault)
