"""What is answered of bearings: at work in a machine, over load and speed, who controls."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.result import coordinate, quantity
from rotordyn.analysis.results.kinds import Array, Flags, Words


@dataclass(frozen=True)
class PreloadResult:
    """The dynamic preload state; bearings in their own frames (x loads the balls)."""

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    bearing: Words = coordinate("bearing", unit="", label="bearing")
    sleeve: Words = coordinate("sleeve", unit="", label="sleeve")
    body: Words = coordinate("body", unit="", label="body")
    dof: Words = coordinate("dof", unit="", label="freedom")
    dof_other: Words = coordinate("dof_other", unit="", label="freedom")
    outcome: Words = quantity("speed", unit="", label="outcome")
    axial_load: Array = quantity("speed", "bearing", unit="N", label="axial load")
    deflection: Array = quantity("speed", "bearing", unit="m", label="axial deflection")
    stiffness: Array = quantity(
        "speed", "bearing", "dof", "dof_other", unit="N/m, N/rad, N·m/rad", label="stiffness"
    )
    inner_angle: Array = quantity("speed", "bearing", unit="rad", label="inner contact angle")
    outer_angle: Array = quantity("speed", "bearing", unit="rad", label="outer contact angle")
    inner_load: Array = quantity("speed", "bearing", unit="N", label="inner ball load")
    outer_load: Array = quantity("speed", "bearing", unit="N", label="outer ball load")
    inner_pressure: Array = quantity("speed", "bearing", unit="Pa", label="inner peak pressure")
    outer_pressure: Array = quantity("speed", "bearing", unit="Pa", label="outer peak pressure")
    centrifugal_force: Array = quantity("speed", "bearing", unit="N", label="centrifugal force")
    gyroscopic_moment: Array = quantity("speed", "bearing", unit="N·m", label="gyroscopic moment")
    inner_grip: Array = quantity("speed", "bearing", unit="1", label="grip needed, inner race")
    outer_grip: Array = quantity("speed", "bearing", unit="1", label="grip needed, outer race")
    slipping: NDArray[np.str_] = quantity("speed", "bearing", unit="", label="race that slips")
    growth: Array = quantity("speed", "bearing", unit="m", label="ring growth")
    speed_factor: Array = quantity("speed", "bearing", unit="mm/min", label="speed factor n·dm")
    position: Array = quantity("speed", "body", unit="m", label="axial shift from rest")
    spring_force: Array = quantity("speed", "sleeve", unit="N", label="spring force")
    stop_force: Array = quantity("speed", "sleeve", unit="N", label="stop force")
    stop_reached: Flags = quantity("speed", "sleeve", unit="", label="stop reached")
    stop_speed: Array = quantity("sleeve", unit="rad/s", label="speed at which the stop is reached")


@dataclass(frozen=True)
class ControlResult:
    """Which race controls the balls of a single bearing over axial load and speed, tilts blocked.

    ``boundary``: of the inner race, the load above which it controls; of the outer race, the load
    up to which it does. ``fit``: of F = a ω² + b ω + c. A load or fit that does not exist is NaN
    beside its ``absence``, a margin beside its ``state``.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    load: Array = coordinate("load", unit="N", label="axial load")
    boundary: Words = coordinate("boundary", unit="", label="boundary of control by race")
    term: Words = coordinate("term", unit="", label="term of the fit")
    outcome: Words = quantity("speed", unit="", label="outcome")
    radial: float = quantity(unit="1", label="radial over axial load")
    resting_weight: float = quantity(
        unit="1", label="friction moment, inner over outer race, at equal ball loads"
    )
    boundary_load: Array = quantity("boundary", "speed", unit="N", label="load at the boundary")
    boundary_absence: NDArray[np.str_] = quantity(
        "boundary", "speed", unit="", label="why there is no boundary"
    )
    boundary_pressure: Array = quantity(
        "boundary", "speed", unit="Pa", label="peak pressure at the boundary"
    )
    changes: NDArray[np.int_] = quantity(
        "boundary", "speed", unit="1", label="changes of control over the loads"
    )
    fit: Array = quantity(
        "boundary", "term", unit="N/(rad/s)², N/(rad/s), N", label="quadratic fit over speed"
    )
    fit_misfit: Array = quantity("boundary", unit="N", label="largest misfit of the fit")
    fit_absence: Words = quantity("boundary", unit="", label="why there is no fit")
    state: NDArray[np.str_] = quantity("speed", "load", unit="", label="state")
    inner_margin: Array = quantity(
        "speed", "load", unit="1", label="margin of control by the inner race"
    )
    outer_margin: Array = quantity(
        "speed", "load", unit="1", label="margin of control by the outer race"
    )
