"""Motion over time under forces."""

from __future__ import annotations

from dataclasses import dataclass

from rotordyn.results.declaration import Absence, coordinate, quantity
from rotordyn.results.display import Shown
from rotordyn.results.kinds import Array, Words

MILLISECOND = Shown("ms", 1e3)
ENDED = Absence("from the time on at which a bearing has no state", by=("speed", "time"))
POINT, BEARING = ("speed", "point"), ("speed", "bearing")


@dataclass(frozen=True)
class TimeResponseResult:
    """Motion from the preload state on, bearings by their load–displacement law.

    ``displacement`` is counted from that state; ``linear_displacement``: what it would be if
    bearings had the tangents of that state, on which frequencies and receptances rest.
    ``bearing_load``: of the shaft on the bearing, preload included, in the directions of the
    spindle. ``largest``: farthest way from the state in any direction. ``peak_…``: when the load
    of a bearing is largest. ``stop_gap``: least gap of an end stop on the way; the motion knows no
    stops, and where it is below zero a sleeve would strike its own. ``ended``: time up to which
    there is an answer.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    time: Array = coordinate("time", unit="s", label="time", printed=MILLISECOND)
    point: Words = coordinate("point", unit="", label="point")
    axis: Words = coordinate("axis", unit="", label="axis")
    bearing: Words = coordinate("bearing", unit="", label="bearing")
    sleeve: Words = coordinate("sleeve", unit="", label="sleeve")
    force: Words = coordinate("force", unit="", label="force")
    outcome: Words = quantity("speed", unit="", label="outcome")
    ended: Array = quantity("speed", unit="s", label="end of the answer", printed=MILLISECOND)
    applied: Array = quantity("time", "force", unit="N", label="applied force")
    displacement: Array = quantity(
        "speed", "time", "point", "axis", unit="m", label="displacement", absent=(ENDED,)
    )
    linear_displacement: Array = quantity(
        "speed", "time", "point", "axis", unit="m", label="displacement of a linear machine"
    )
    bearing_load: Array = quantity(
        "speed", "time", "bearing", "axis", unit="N", label="load on the bearing", absent=(ENDED,)
    )
    largest: Array = quantity(*POINT, unit="m", label="largest displacement")
    largest_time: Array = quantity(*POINT, unit="s", label="time of that", printed=MILLISECOND)
    linear_largest: Array = quantity(
        *POINT, unit="m", label="largest displacement of a linear machine"
    )
    peak_load: Array = quantity(*BEARING, unit="N", label="largest load on the bearing")
    peak_time: Array = quantity(*BEARING, unit="s", label="time of that", printed=MILLISECOND)
    peak_pressure: Array = quantity(*BEARING, unit="Pa", label="contact pressure at that time")
    peak_idle: Array = quantity(*BEARING, unit="", label="balls without inner load at that time")
    stop_gap: Array = quantity(
        "speed",
        "sleeve",
        unit="m",
        label="least gap of the end stop",
        absent=(
            Absence("of a sleeve without a stop, or that stands at it", by=("speed", "sleeve")),
        ),
    )
    error: Array = quantity("point", unit="1", label="estimated error over the largest value")
    error_asked: float = quantity(
        unit="1",
        label="largest error asked for, over that value",
        infinite=(Absence("where none is asked for"),),
    )
