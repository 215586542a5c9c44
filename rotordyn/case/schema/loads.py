"""Static loads and limits of twist of ``section_forces``; the question ``unbalance``."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import Field, PlainValidator, WithJsonSchema

from rotordyn.analyses.section_forces.spec import WEIGHT
from rotordyn.case.node import UNKNOWN
from rotordyn.case.schema import shapes
from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.values import (
    Angle,
    BalanceQuality,
    Bore,
    Eccentricity,
    Force,
    LineForce,
    Moment,
    Name,
    PointName,
    QuantityReader,
    Station,
    TopSpeed,
    TwistAngle,
    UnbalanceSize,
    choice,
    given,
    wrong,
)
from rotordyn.quantity import STATION, Named
from rotordyn.scene.loads import PHASES

_station = QuantityReader(STATION)


def _at(value: Any) -> str | float:
    if value is UNKNOWN:
        return ""
    if isinstance(value, str) and not Named(dotted=True).refusal(value):
        return value
    if not isinstance(value, str) or not value.strip():
        raise wrong(
            f"not a point or station: given {given(value)}; allowed: the name of a point, or a "
            "length such as 120 mm"
        )
    return _station(value)


_SHAPE = {"anyOf": [shapes.POINT, shapes.quantity(STATION)], "description": "a point, or a station"}
At = Annotated[
    Any, PlainValidator(_at, json_schema_input_type=Annotated[Any, WithJsonSchema(_SHAPE)])
]


class PointLoadEntry(Entry):
    """A load on the shaft; its forces act at (`y`, `z`) off the axis."""

    name: Name = ""
    at: At
    Fx: Force = 0.0
    Fy: Force = 0.0
    Fz: Force = 0.0
    Mx: Moment = 0.0
    My: Moment = 0.0
    Mz: Moment = 0.0
    y: Station = 0.0
    z: Station = 0.0


class LineLoadEntry(Entry):
    """A uniform force per length."""

    name: Name = ""
    start: At = Field(alias="from")
    to: At
    qx: LineForce = 0.0
    qy: LineForce = 0.0
    qz: LineForce = 0.0


class UnbalanceEntry(Entry):
    """A mass off the axis; its force is U Ω²."""

    name: Name = ""
    at: At
    unbalance: UnbalanceSize
    angle: Angle = 0.0


class TwistLimitEntry(Entry):
    """How far the shaft may twist, and which uniform outer diameter just keeps to it."""

    name: Name = ""
    start: At = Field(alias="from")
    to: At
    limit: TwistAngle
    bore: Bore = 0.0


class SectionForcesEntry(Entry):
    """N, Ty, Tz, Mt, My, Mz, deflection and stress along the shaft under static loads."""

    loads: list[PointLoadEntry] = []
    line_loads: list[LineLoadEntry] = []
    unbalances: list[UnbalanceEntry] = []
    gravity: Annotated[str, choice(*WEIGHT)] = "none"
    twist_limits: list[TwistLimitEntry] = []


class EccentricSpanEntry(Entry):
    """A length of shaft whose mass lies off the axis."""

    name: Name = ""
    start: At = Field(alias="from")
    to: At
    eccentricity: Eccentricity
    angle: Angle = 0.0


class BalanceGradeEntry(Entry):
    """Residual unbalance that a grade of ISO 21940-11 permits: U = G m / Ω."""

    quality: BalanceQuality
    speed: TopSpeed
    planes: Annotated[list[At], Field(min_length=1, max_length=2)]
    phase: Annotated[str, choice(*PHASES)] = "static"
    angle: Angle = 0.0


class UnbalanceResponseEntry(Entry):
    """Steady response to unbalance at every speed: amplitudes are zero to peak."""

    points: Annotated[list[PointName], Field(min_length=1)]
    unbalances: list[UnbalanceEntry] = []
    spans: list[EccentricSpanEntry] = []
    grade: BalanceGradeEntry | None = None
