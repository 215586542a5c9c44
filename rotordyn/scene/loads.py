"""Loads on a shaft, unbalance among them, and limits of its twist: frozen descriptions in SI."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description
from rotordyn.machine.spindle import Spindle
from rotordyn.quantity import (
    Angle,
    BalanceQuality,
    Bore,
    Choice,
    Eccentricity,
    Force,
    LineForce,
    Moment,
    Name,
    OptionalName,
    PointName,
    Station,
    TopSpeed,
    TwistAngle,
    UnbalanceSize,
)

PHASES = ("static", "couple")


@dataclass(frozen=True, slots=True)
class PointLoad(Description):
    """Forces [N] and moments [N·m] on the shaft at a point's name or a station ``at`` [m].

    The forces act at (``y``, ``z``) [m] off the axis, as on a gear; there they make moments.
    """

    at: Name | Station
    name: OptionalName = ""
    Fx: Force = 0.0
    Fy: Force = 0.0
    Fz: Force = 0.0
    Mx: Moment = 0.0
    My: Moment = 0.0
    Mz: Moment = 0.0
    y: Station = 0.0
    z: Station = 0.0

    @property
    def on_axis(self) -> tuple[float, ...]:
        """(Fx, Fy, Fz, Mx, My, Mz) of the same load at the axis."""
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
    """Force per length [N/m], uniform from ``start`` to ``to`` (points or stations [m])."""

    start: Name | Station
    to: Name | Station
    name: OptionalName = ""
    qx: LineForce = 0.0
    qy: LineForce = 0.0
    qz: LineForce = 0.0


@dataclass(frozen=True, slots=True)
class Unbalance(Description):
    """Mass times distance from the axis ``unbalance`` [kg·m], at ``angle`` [rad] from y to z.

    Its force is U Ω²: turning with the shaft, or in a static question as it stands at this angle.
    """

    at: PointName | Station
    unbalance: UnbalanceSize
    angle: Angle = 0.0
    name: OptionalName = ""


@dataclass(frozen=True, slots=True)
class EccentricSpan(Description):
    """A length of shaft, ``start`` to ``to``, whose mass lies ``eccentricity`` [m] off the axis.

    At ``angle`` [rad] from y to z. Point masses and discs on it are not meant.
    """

    start: PointName | Station
    to: PointName | Station
    eccentricity: Eccentricity
    angle: Angle = 0.0
    name: OptionalName = ""


@dataclass(frozen=True, slots=True)
class BalanceGrade(Description):
    """Residual unbalance that ISO 21940-11 permits: U = G m / Ω, m the mass of the rotor.

    ``quality`` G [m/s] at the highest ``speed`` of service of the spindle [rad/s]; Ω of a further
    rotor is that times its ratio, without sign. All of it is in one of ``planes``, or in two by the
    levers of the centre of gravity between them, neither share below 0.3; at ``angle`` [rad] both
    (``phase`` ``"static"``), or the second opposite (``"couple"``).
    """

    quality: BalanceQuality
    speed: TopSpeed
    planes: tuple[PointName | Station, ...]
    phase: Annotated[str, Choice(PHASES)] = "static"
    angle: Angle = 0.0

    def _faults(self) -> Iterator[str]:
        if not 1 <= len(self.planes) <= 2:
            yield f"planes: one or two are needed: given {len(self.planes)}"
        elif len(self.planes) == 1 and self.phase == "couple":
            yield "phase: a couple needs two planes: given one"


@dataclass(frozen=True, slots=True)
class TwistLimit(Description):
    """Angle ``limit`` [rad] by which the shaft may twist between two points or stations [m].

    Asks for the outer diameter of a uniform shaft with the given ``bore`` [m] that just keeps it.
    """

    start: Name | Station
    to: Name | Station
    limit: TwistAngle
    bore: Bore = 0.0
    name: OptionalName = ""

    @property
    def called(self) -> str:
        """Its name, or where it goes from and to."""
        return self.name or f"{_place(self.start)} to {_place(self.to)}"


def station(spindle: Spindle, at: str | float) -> float:
    """Where a point's name or a station is [m]."""
    return spindle.points[at] if isinstance(at, str) else at


def _place(at: str | float) -> str:
    return at if isinstance(at, str) else f"{at * 1e3:.6g} mm"
