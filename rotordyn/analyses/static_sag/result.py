"""Sag of the shaft under its weight and runout of its nose."""

from __future__ import annotations

from dataclasses import dataclass

from rotordyn.arrays import Array, Words
from rotordyn.results.declaration import coordinate, quantity
from rotordyn.results.display import MILLIMETRE, Shown

MICRORADIAN = Shown("µrad", 1e6)


@dataclass(frozen=True)
class StaticSagResult:
    """Deflection under weight, at stations of the shaft and at gauges in front of ``point``.

    ``weight``: its direction, 0 along the axis. ``follows_speed``: bearings and supports whose
    stiffness depends on speed.
    ``deflection``: at a joint that of the part in front. ``slope``: inclination of the shaft at the
    point, dy/dx and dz/dx of a test bar in it.
    ``ring``: inner rings with a runout. ``runout``: full reading of a gauge over a slow turn, the
    rings at their angles; ``ring_share``: by each ring alone; ``highest_runout``: their sum, which
    the rings reach at the worst angles. The sag does not rotate and is no part of the runout.
    """

    point: str = quantity(unit="", label="point")
    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    station: Array = coordinate("station", unit="m", label="station", printed=MILLIMETRE)
    gauge: Array = coordinate(
        "gauge", unit="m", label="distance of the gauge in front", printed=MILLIMETRE
    )
    direction: Words = coordinate("direction", unit="", label="direction")
    ring: Words = coordinate("ring", unit="", label="ring")
    true_ring: Words = coordinate("true_ring", unit="", label="bearing without a given runout")
    follows_speed: Words = coordinate(
        "follows_speed", unit="", label="bearing or support that depends on the speed"
    )
    weight: Array = quantity("direction", unit="1", label="direction of the weight")
    outcome: Words = quantity("speed", unit="", label="outcome")
    deflection: Array = quantity("speed", "station", "direction", unit="m", label="deflection")
    slope: Array = quantity(
        "speed", "direction", unit="rad", label="slope of the nose", printed=MICRORADIAN
    )
    sag: Array = quantity("speed", "gauge", "direction", unit="m", label="sag")
    runout: Array = quantity("speed", "gauge", "direction", unit="m", label="runout")
    highest_runout: Array = quantity(
        "speed", "gauge", "direction", unit="m", label="highest runout"
    )
    ring_share: Array = quantity(
        "speed", "gauge", "ring", "direction", unit="m", label="runout by this ring alone"
    )
