"""What a case asks of sag and runout (SI)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description, Faults, repeated
from rotordyn.errors import InvalidInput
from rotordyn.machine.assembly import unknown
from rotordyn.quantity import Angle, Choice, Eccentricity, Items, Name, Station
from rotordyn.scene.spec import Setting, Spec, held_twice

GRAVITY = ("-y", "+y", "-z", "+z", "none")


@dataclass(frozen=True, slots=True)
class RingRunout(Description):
    """Radial runout of an inner ring: full reading of a gauge over a turn, twice the
    eccentricity of its groove."""

    bearing: Annotated[Name, "the bearing, or a support that stands for one"]
    runout: Annotated[Eccentricity, "Kia of the ring, as a gauge reads it (ISO 492)"]
    angle: Annotated[Angle, "where the ring is thickest, from y towards z"] = 0.0


@dataclass(frozen=True, slots=True)
class StaticSagSpec(Spec):
    """Deflection line of the shaft under its weight, and what a dial gauge at the nose reads.

    Sag does not turn with the shaft; the runout of the rings does.
    """

    point: Annotated[Name, "the nose, or the tool point"]
    gravity: Annotated[
        str, Choice(GRAVITY), "direction of the weight; `none` of a vertical spindle"
    ] = "-y"
    gauges: Annotated[
        tuple[Station, ...],
        Items(),
        "distances in front of the point (towards −x) at which a gauge reads, on a straight test "
        "bar; below 0 behind it",
    ] = (0.0,)
    ring_runouts: Annotated[tuple[RingRunout, ...], "of inner rings; those not named run true"] = ()

    def _faults(self) -> Faults:
        yield from repeated("ring_runouts", (each.bearing for each in self.ring_runouts), "bearing")
        yield from repeated("gauges", (f"{gauge * 1e3:g} mm" for gauge in self.gauges))

    def faults_on(self, setting: Setting) -> Faults:
        spindle, conditions = setting.spindle, setting.conditions
        if spindle.rotors:
            yield (), "the static sag takes no further rotors: leave them out"
        for sentence in unknown("point", self.point, spindle.points):
            yield ("point",), sentence
        names = [*(s.name for s in spindle.seats), *(s.name for s in spindle.supports)]
        for index, ring in enumerate(self.ring_runouts):
            for sentence in unknown("bearing or support", ring.bearing, names):
                yield ("ring_runouts", index, "bearing"), sentence
        if not {self.gravity, conditions.gravity} & {"", "none"}:
            yield (
                ("gravity",),
                f"the weight is given twice: given '{self.gravity}' beside '{conditions.gravity}' "
                "of the conditions; allowed: one of both, the other none; the sag is that by the "
                "weight given here, by default '-y'",
            )

    def last_faults_on(self, setting: Setting) -> Faults:
        """The shaft is no free body under its weight, and held no more often than it can."""
        from rotordyn.equation.mesh import station_mesh
        from rotordyn.scene.at_rest import on_nodes, require_balance, weight

        spindle = setting.spindle
        if faults := [*held_twice(setting)]:
            yield from faults
            return
        mesh = station_mesh(spindle)
        try:
            require_balance(
                spindle, mesh.x, [on_nodes(*weight(spindle, mesh, self.gravity), mesh.x)]
            )
        except InvalidInput as fault:
            yield ("gravity",), str(fault)
