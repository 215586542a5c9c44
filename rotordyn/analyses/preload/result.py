"""Result: the dynamic preload state of bearings, springs and stops."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Flags, Words
from rotordyn.results.declaration import Absence, coordinate, quantity


@dataclass(frozen=True)
class PreloadResult:
    """The dynamic preload state; bearings in their own frames (x loads the balls)."""

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    bearing: Words = coordinate("bearing", unit="", label="bearing")
    sleeve: Words = coordinate("sleeve", unit="", label="sleeve")
    body: Words = coordinate("body", unit="", label="body")
    dof: Words = coordinate("dof", unit="", label="DOF")
    dof_other: Words = coordinate("dof_other", unit="", label="DOF")
    outcome: Words = quantity("speed", unit="", label="outcome")
    axial_load: Array = quantity("speed", "bearing", unit="N", label="axial load")
    mounted_load: Array = quantity("bearing", unit="N", label="axial load as mounted")
    mounted_preload: Array = quantity("sleeve", unit="N", label="preload as mounted")
    ring_offset: Array = quantity(
        "sleeve",
        unit="m",
        label="axial offset of the free rings",
        absent=(
            Absence(
                "of a sleeve on a spring, and where no bearing in the housing opposes its bearings",
                by=("sleeve",),
            ),
        ),
    )
    deflection: Array = quantity("speed", "bearing", unit="m", label="axial deflection")
    stiffness: Array = quantity(
        *("speed", "bearing", "dof", "dof_other"),
        unit="N/m, N/rad, N·m/rad",
        label="stiffness",
        comment="in the frame of each bearing: x in the direction of its thrust; where that is "
        "-x, x and z "
        "are opposite to those of the spindle",
    )
    inner_angle: Array = quantity(
        "speed",
        "bearing",
        unit="rad",
        label="inner contact angle",
        absent=(Absence("without load", beside="inner_load"),),
    )
    outer_angle: Array = quantity(
        "speed",
        "bearing",
        unit="rad",
        label="outer contact angle",
        absent=(Absence("without load", beside="outer_load"),),
    )
    inner_load: Array = quantity("speed", "bearing", unit="N", label="inner ball load")
    outer_load: Array = quantity("speed", "bearing", unit="N", label="outer ball load")
    inner_pressure: Array = quantity("speed", "bearing", unit="Pa", label="inner peak pressure")
    outer_pressure: Array = quantity("speed", "bearing", unit="Pa", label="outer peak pressure")
    centrifugal_force: Array = quantity("speed", "bearing", unit="N", label="centrifugal force")
    gyroscopic_moment: Array = quantity("speed", "bearing", unit="N·m", label="gyroscopic moment")
    inner_required_friction: Array = quantity(
        "speed", "bearing", unit="1", label="required friction, inner race"
    )
    outer_required_friction: Array = quantity(
        "speed", "bearing", unit="1", label="required friction, outer race"
    )
    slipping: NDArray[np.str_] = quantity("speed", "bearing", unit="", label="race that slips")
    growth: Array = quantity("speed", "bearing", unit="m", label="ring growth")
    film_growth: Array = quantity(
        "speed", "bearing", unit="m", label="ring growth equivalent to the oil films"
    )
    speed_factor: Array = quantity("speed", "bearing", unit="mm/min", label="speed factor n·dm")
    position: Array = quantity("speed", "body", unit="m", label="axial shift from rest")
    spring_force: Array = quantity("speed", "sleeve", unit="N", label="spring force")
    stop_force: Array = quantity("speed", "sleeve", unit="N", label="stop force")
    friction_force: Array = quantity("speed", "sleeve", unit="N", label="friction force")
    friction_limit: Array = quantity("sleeve", unit="N", label="limit of friction")
    stop_reached: Flags = quantity("speed", "sleeve", unit="", label="stop reached")
    stop_speed: Array = quantity(
        "sleeve",
        unit="rad/s",
        label="speed at which the stop is reached",
        absent=(Absence("where the stop is not reached", by=("sleeve",)),),
    )
