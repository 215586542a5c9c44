"""Loads on a shaft, unbalance among them, and limits of its twist: frozen descriptions in SI."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description, Faults
from rotordyn.quantity import (
    Angle,
    BalanceQuality,
    Bore,
    Choice,
    Eccentricity,
    Force,
    Items,
    Key,
    LineForce,
    Moment,
    OptionalName,
    PointName,
    Station,
    TopSpeed,
    TwistAngle,
    UnbalanceSize,
)

PHASES = ("static", "couple")
At = PointName | Station
From = Annotated[PointName | Station, Key("from"), "where it begins"]
To = Annotated[PointName | Station, "where it ends"]
CalledInMessages = Annotated[OptionalName, "for messages"]


@dataclass(frozen=True, slots=True)
class PointLoad(Description):
    """A load on the shaft [N], [N·m]; its forces act at (`y`, `z`) off the axis, as on a gear."""

    at: Annotated[At, "where it acts: a point or station"]
    name: CalledInMessages = ""
    Fx: Annotated[Force, "force towards +x"] = 0.0
    Fy: Annotated[Force, "force towards +y"] = 0.0
    Fz: Annotated[Force, "force towards +z"] = 0.0
    Mx: Annotated[Moment, "moment about x: a torque"] = 0.0
    My: Annotated[Moment, "moment about y"] = 0.0
    Mz: Annotated[Moment, "moment about z"] = 0.0
    y: Annotated[Station, "distance from the axis at which the forces act, along y"] = 0.0
    z: Annotated[Station, "distance from the axis at which the forces act, along z"] = 0.0

    @property
    def on_axis(self) -> tuple[float, ...]:
        """(Fx, Fy, Fz, Mx, My, Mz) of the equivalent load at the axis."""
        y, z = self.y, self.z
        return (
            self.Fx,
            self.Fy,
            self.Fz,
            self.Mx + y * self.Fz - z * self.Fy,
            self.My + z * self.Fx,
            self.Mz - y * self.Fx,
        )


@dataclass(frozen=True, slots=True)
class LineLoad(Description):
    """A uniform force per length [N/m] between two points or stations [m]."""

    start: From
    to: To
    name: CalledInMessages = ""
    qx: Annotated[LineForce, "force per length towards +x"] = 0.0
    qy: Annotated[LineForce, "force per length towards +y"] = 0.0
    qz: Annotated[LineForce, "force per length towards +z"] = 0.0


@dataclass(frozen=True, slots=True)
class Unbalance(Description):
    """A mass off the axis [kg·m]; its force is U Ω².

    It turns with the shaft; in a static analysis it acts at its angle.
    """

    at: Annotated[At, "where it turns: a point or station"]
    unbalance: Annotated[UnbalanceSize, "mass times distance from the axis"]
    angle: Annotated[Angle, "angular position, from y towards z"] = 0.0
    name: CalledInMessages = ""


@dataclass(frozen=True, slots=True)
class EccentricSpan(Description):
    """A length of shaft whose mass lies off the axis, without point masses and discs on it."""

    start: From
    to: To
    eccentricity: Annotated[Eccentricity, "distance of its centre of mass from the axis"]
    angle: Annotated[Angle, "angle of that distance, from y towards z"] = 0.0
    name: Annotated[OptionalName, "name in results and messages"] = ""


@dataclass(frozen=True, slots=True)
class BalanceGrade(Description):
    """Residual unbalance that a grade of ISO 21940-11 permits: U = G m / Ω, m of the rotor."""

    quality: Annotated[BalanceQuality, "G"]
    speed: Annotated[
        TopSpeed,
        "highest speed of service of the spindle; the grade belongs to that of the rotor itself, "
        "which is this times its `speed_ratio`",
    ]
    planes: Annotated[
        tuple[At, ...],
        Items(1, 2),
        "one or two points or stations that carry it; two share it by the lever rule about the "
        "centre of gravity between them, neither below 0.3",
    ]
    phase: Annotated[
        str, Choice(PHASES), "phase of the second plane: `static` like the first, `couple` opposite"
    ] = "static"
    angle: Annotated[Angle, "angular position in the first plane, from y towards z"] = 0.0

    def _faults(self) -> Faults:
        if len(self.planes) == 1 and self.phase == "couple":
            yield ("phase",), "a couple needs two planes: given one"


@dataclass(frozen=True, slots=True)
class TwistLimit(Description):
    """Limit of the twist of the shaft [rad], for which a uniform outer diameter is computed."""

    start: Annotated[At, Key("from"), "one end of the piece"]
    to: Annotated[At, "the other end"]
    limit: Annotated[TwistAngle, "angle between the two sections"]
    bore: Annotated[Bore, "bore of the uniform shaft whose outer diameter is computed"] = 0.0
    name: Annotated[OptionalName, "name in summary and tables; by default its two ends"] = ""

    @property
    def called(self) -> str:
        """Given name, or both ends."""
        return self.name or f"{_place(self.start)} to {_place(self.to)}"


def _place(at: str | float) -> str:
    return at if isinstance(at, str) else f"{at * 1e3:.6g} mm"
