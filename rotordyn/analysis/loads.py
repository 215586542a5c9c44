"""Static loads on a shaft, and limits of its twist: frozen descriptions in SI."""

from __future__ import annotations

from dataclasses import dataclass

from rotordyn.description import Description
from rotordyn.machine.spindle import Spindle
from rotordyn.quantity import (
    Angle,
    Bore,
    Force,
    LineForce,
    Moment,
    Name,
    OptionalName,
    Station,
    TwistAngle,
    UnbalanceSize,
)


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

    The force U Ω² is taken as it stands at this angle.
    """

    at: Name | Station
    unbalance: UnbalanceSize
    angle: Angle = 0.0
    name: OptionalName = ""


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
