"""Result of the response over time to forces."""

from __future__ import annotations

from dataclasses import dataclass

from rotordyn.arrays import Array, Words
from rotordyn.results.declaration import Absence, coordinate, quantity
from rotordyn.results.display import Shown

MILLISECOND = Shown("ms", 1e3)
OPEN = Absence("of a sleeve without a stop, or whose stop stays closed", by=("speed", "sleeve"))
ENDED = Absence("after the end of the response", by=("speed", "time"))
POINT, BEARING, SLEEVE = ("speed", "point"), ("speed", "bearing"), ("speed", "sleeve")


@dataclass(frozen=True)
class TimeResponseResult:
    """Motion over time, with the nonlinear load–displacement law of the bearings.

    ``displacement`` is relative to the preload state; ``linear_displacement``: the same if bearings
    had the tangents of that state, on which frequencies and receptances are based.
    ``bearing_load``: of the shaft on the inner ring, with preload and without damping, in the
    directions of the spindle. ``largest``: greatest magnitude of the displacement,
    ``late_largest`` of the last quarter of the time, after initial transients.
    ``unloaded_time``: total time in which the inner race loads no ball of a bearing.
    ``gap``: of end stops, below zero where one is compressed, or, if stops stay as they are in the
    preload state, where an open one would close; ``stop_gap``: its least value; ``stop_force``:
    the largest force of a stop that closes. ``holding``: largest force over that which presses a
    sleeve on a closed stop, or over the limit of the dry friction that holds it; above 1 it would
    move. ``ended``: time up to which the motion is solved, and ``ending`` why it ends.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    time: Array = coordinate("time", unit="s", label="time", printed=MILLISECOND)
    point: Words = coordinate("point", unit="", label="point")
    axis: Words = coordinate("axis", unit="", label="axis")
    bearing: Words = coordinate("bearing", unit="", label="bearing")
    sleeve: Words = coordinate("sleeve", unit="", label="sleeve")
    force: Words = coordinate("force", unit="", label="force")
    outcome: Words = quantity("speed", unit="", label="outcome")
    ended: Array = quantity("speed", unit="s", label="end of the response", printed=MILLISECOND)
    ending: Words = quantity("speed", unit="", label="reason for an early end")
    applied: Array = quantity("time", "force", unit="N", label="applied force")
    displacement: Array = quantity(
        "speed", "time", "point", "axis", unit="m", label="displacement", absent=(ENDED,)
    )
    linear_displacement: Array = quantity(
        "speed",
        "time",
        "point",
        "axis",
        unit="m",
        label="displacement with linear bearings",
        absent=(ENDED,),
    )
    bearing_load: Array = quantity(
        "speed", "time", "bearing", "axis", unit="N", label="load on the bearing", absent=(ENDED,)
    )
    largest: Array = quantity(*POINT, unit="m", label="largest displacement")
    late_largest: Array = quantity(
        *POINT,
        unit="m",
        label="largest displacement in the last quarter of the time",
        absent=(Absence("where the response ends earlier", by=("speed",)),),
    )
    largest_time: Array = quantity(
        *POINT, unit="s", label="time of the largest displacement", printed=MILLISECOND
    )
    linear_largest: Array = quantity(
        *POINT, unit="m", label="largest displacement with linear bearings"
    )
    peak_load: Array = quantity(*BEARING, unit="N", label="largest load on the bearing")
    peak_time: Array = quantity(
        *BEARING, unit="s", label="time of the largest load", printed=MILLISECOND
    )
    peak_pressure: Array = quantity(
        *BEARING,
        unit="Pa",
        label="largest contact pressure",
        infinite=(Absence("where contacts are overloaded", by=BEARING),),
    )
    pressure_time: Array = quantity(
        *BEARING, unit="s", label="time of the largest pressure", printed=MILLISECOND
    )
    peak_idle: Array = quantity(
        *BEARING, unit="", label="largest number of balls unloaded at the inner race"
    )
    unloaded_time: Array = quantity(
        *BEARING, unit="s", label="time with no ball loaded", printed=MILLISECOND
    )
    gap: Array = quantity(
        "speed", "time", "sleeve", unit="m", label="gap of the end stop", absent=(OPEN, ENDED)
    )
    stop_gap: Array = quantity(*SLEEVE, unit="m", label="least gap of the end stop", absent=(OPEN,))
    stop_force: Array = quantity(
        *SLEEVE,
        unit="N",
        label="largest force of the end stop",
        absent=(Absence("of a sleeve without a stop that closes", by=("speed", "sleeve")),),
    )
    stop_error: Array = quantity(
        *SLEEVE,
        unit="1",
        label="relative change of the stop force by the last halving of the steps",
        absent=(Absence("of a sleeve without a stop that closes", by=("speed", "sleeve")),),
    )
    holding: Array = quantity(
        *SLEEVE,
        unit="1",
        label="largest force over the force that holds the sleeve",
        absent=(Absence("of a sleeve without a force that holds it", by=("speed", "sleeve")),),
    )
    unbalances: int = quantity(unit="", label="number of unbalances")
    friction_limit: Array = quantity("sleeve", unit="N", label="limit of dry friction")
    error: Array = quantity("point", unit="1", label="estimated error over the largest value")
    error_asked: float = quantity(
        unit="1",
        label="largest error asked for, over the largest value",
        infinite=(Absence("where none is asked for"),),
    )
